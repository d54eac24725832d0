#include "sim/import_igc/igc_track.hpp"

#include <gtest/gtest.h>

#include "tests/unit/igc/igc_text.hpp"
#include "tests/unit/log/temporary_folder.hpp"

namespace ridgeline {
namespace {

using testing::fix_text;
using testing::TemporaryFolder;

constexpr std::int64_t day_ns = 86'400'000'000'000;

TEST(IgcTrack, fix_columns_and_extension_digits) {
  const TemporaryFolder folder;
  // LAD and LOD add a fourth decimal of the minute.
  const auto path = folder.file("a.igc",
                                "AXXX\r\nHFDTEDATE:250819,01\r\nI023636LAD3737LOD\r\n"
                                "B0802114624974N00806431EA003780228280\r\n"
                                "B0802124624974S00806431WA00378-022857\r\n");
  const Result<IgcTrack> track = igc_track(path);
  ASSERT_TRUE(track.ok());
  ASSERT_EQ(track.value().fixes.size(), 1U);  // the second one jumps to the other hemisphere
  EXPECT_EQ(track.value().counters.spikes, 1U);
  const IgcFix& fix = track.value().fixes[0];
  EXPECT_EQ(fix.time_s, 8 * 3600 + 2 * 60 + 11);
  EXPECT_NEAR(fix.latitude_deg, 46.0 + 24.9748 / 60.0, 1e-12);
  EXPECT_NEAR(fix.longitude_deg, 8.0 + 6.4310 / 60.0, 1e-12);
  EXPECT_EQ(fix.altitude_m, 2282.0);
  EXPECT_EQ(track.value().day_ns, 18133 * day_ns);
}

TEST(IgcTrack, both_forms_of_the_date_and_both_altitude_datums) {
  const TemporaryFolder folder;
  const std::string fix = fix_text(100, 46.0, 8.0, 500);
  const auto of = [&](const std::string& header) {
    return igc_track(folder.file("d.igc", header + fix)).value();
  };
  EXPECT_EQ(of("HFDTE120687\r\n").day_ns, 6371 * day_ns);
  EXPECT_EQ(of("HFDTEDATE: 120687\r\n").day_ns, 6371 * day_ns);
  EXPECT_FALSE(of("HFDTE310299\r\n").has_date);
  EXPECT_EQ(of("HFALG:GEO\r\n").altitude_is_msl, true);
  EXPECT_EQ(of("HFALGALTGPS:ELL\r\n").altitude_is_msl, false);
  EXPECT_EQ(of("HFALPALTPRESSURE:ISA\r\n").altitude_is_msl, std::nullopt);
}

TEST(IgcTrack, southern_and_western_hemispheres) {
  const TemporaryFolder folder;
  const IgcTrack track = igc_track(folder.file("s.igc", fix_text(0, -44.5, -170.25, 300))).value();
  EXPECT_NEAR(track.fixes[0].latitude_deg, -44.5, 1e-9);
  EXPECT_NEAR(track.fixes[0].longitude_deg, -170.25, 1e-9);
}

TEST(IgcTrack, midnight_goes_on_and_smaller_steps_back_are_refused) {
  const TemporaryFolder folder;
  const IgcTrack track =
      igc_track(folder.file("m.igc", fix_text(86398, 46.0, 8.0, 500) +
                                         fix_text(86399, 46.0, 8.0, 500) +
                                         fix_text(0, 46.0, 8.0, 500) + fix_text(0, 46.0, 8.0, 500) +
                                         fix_text(2, 46.0, 8.0, 500) + fix_text(1, 46.0, 8.0, 500)))
          .value();
  ASSERT_EQ(track.fixes.size(), 4U);
  EXPECT_EQ(track.fixes[2].time_s, 86400.0);
  EXPECT_EQ(track.fixes[3].time_s, 86402.0);
  EXPECT_EQ(track.counters.time_refused, 2U);
}

TEST(IgcTrack, validity_v_is_no_fix) {
  const TemporaryFolder folder;
  const IgcTrack track = igc_track(folder.file("v.igc", fix_text(1, 46.0, 8.0, 500) +
                                                            fix_text(2, 46.0, 8.0, 0, "", 'V')))
                             .value();
  EXPECT_EQ(track.fixes.size(), 1U);
  EXPECT_EQ(track.counters.flat_fixes, 1U);
}

TEST(IgcTrack, recorded_angles_are_signed_columns) {
  const TemporaryFolder folder;
  const IgcTrack track =
      igc_track(folder.file("r.igc", "I033638HDT3942AOR4345AOP\r\n" +
                                         fix_text(1, 46.0, 8.0, 500, "123-045+07") +
                                         fix_text(2, 46.0, 8.0, 500, "---0030-1x")))
          .value();
  ASSERT_EQ(track.fixes.size(), 2U);
  EXPECT_EQ(track.fixes[0].heading_deg, 123.0);
  EXPECT_EQ(track.fixes[0].roll_deg, -45.0);
  EXPECT_EQ(track.fixes[0].pitch_deg, 7.0);
  EXPECT_EQ(track.fixes[1].heading_deg, std::nullopt);
  EXPECT_EQ(track.fixes[1].roll_deg, 30.0);
  EXPECT_EQ(track.fixes[1].pitch_deg, std::nullopt);
}

TEST(IgcTrack, bad_lines_are_counted_and_named) {
  const TemporaryFolder folder;
  const auto path = folder.file("bad.igc", fix_text(1, 46.0, 8.0, 500) +
                                               "B12\r\n"
                                               "B2561014624974N00806431EA0000002282\r\n"
                                               "B0802114664974N00806431EA0000002282\r\n"
                                               "B0802119124974N00806431EA0000002282\r\n"
                                               "B0802114624974X00806431EA0000002282\r\n"
                                               "B0802114624974N00806431EQ0000002282\r\n"
                                               "B0802114624974N00806431EA000000x282\r\n"
                                               "I02\r\n" +
                                               "B0802114624974N18106431EA0000002282\r\n");
  const IgcTrack track = igc_track(path).value();
  EXPECT_EQ(track.counters.bad_lines, 9U - 0U);
  EXPECT_EQ(track.counters.fixes, 1U);
  EXPECT_EQ(track.problems[0], path.string() + ":2: fix is shorter than 35 characters");
  EXPECT_EQ(track.problems.size(), 9U);
}

TEST(IgcTrack, a_spike_is_dropped_and_a_lasting_jump_starts_a_segment) {
  const TemporaryFolder folder;
  std::string text;
  for (int t = 1; t <= 5; ++t) text += fix_text(t, 46.0, 8.0, 500);
  text += fix_text(6, 46.2, 8.0, 500);
  for (int t = 7; t <= 9; ++t) text += fix_text(t, 46.0, 8.0, 500);
  for (int t = 10; t <= 20; ++t) text += fix_text(t, 47.0, 8.0, 500);
  const IgcTrack track = igc_track(folder.file("j.igc", text)).value();
  EXPECT_EQ(track.counters.spikes, 5U);
  EXPECT_EQ(track.fixes.size(), 8U + 7U);
  EXPECT_TRUE(track.fixes[8].starts_segment);
  EXPECT_NEAR(track.fixes[8].latitude_deg, 47.0, 1e-9);
}

TEST(IgcTrack, unusable_files_are_faults) {
  const TemporaryFolder folder;
  EXPECT_EQ(igc_track(folder.path() / "none.igc").fault(), Fault::file_unreadable);
  EXPECT_EQ(igc_track(folder.path()).fault(), Fault::file_unreadable);
  EXPECT_EQ(igc_track(folder.file("e.igc", "")).fault(), Fault::track_without_fixes);
  EXPECT_EQ(igc_track(folder.file("h.igc", "AXXX\r\nHFDTE010120\r\n")).fault(),
            Fault::track_without_fixes);
  EXPECT_EQ(igc_track(folder.file("z.igc", fix_text(1, 46.0, 8.0, 0))).fault(),
            Fault::track_without_height);
}

}  // namespace
}  // namespace ridgeline
