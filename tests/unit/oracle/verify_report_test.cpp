#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/oracle/verify.hpp"
#include "tests/unit/oracle/verify_scene.hpp"

/// What a run tells besides its verdict: options, progress, errors, doubts, the JSON report.
namespace ridgeline::oracle {
namespace {

using scenes::changed;
using scenes::mountain_scene;
using scenes::mountain_shot;
using scenes::report;
using scenes::shifted;

TEST(VerifyReport, all_pixels_are_every_pixel_without_points_between) {
  scenes::Shot shot = mountain_shot();
  shot.width = 40;
  shot.height = 30;
  const Frame frame = mountain_scene().drawn(shot);
  VerifyOptions options;
  options.all_pixels = true;
  const VerifySummary all = mountain_scene().verified({frame}, options);
  EXPECT_EQ(all.pixels, 1200U);
  EXPECT_EQ(all.points_between_centres, 0U);
  EXPECT_EQ(all.errors.count(), 1200U);
  EXPECT_EQ(all.errors_without_slack.count(), 75U);
  options.between = true;
  options.without_slack_one_in = 0;
  const VerifySummary more = mountain_scene().verified({frame}, options);
  EXPECT_EQ(more.points_between_centres, 1200U);
  EXPECT_GT(more.missed_between_centres, 0U);
  EXPECT_EQ(more.errors_without_slack.count(), 0U);
}

TEST(VerifyReport, walking_every_cell_gives_the_same_summary) {
  const Frame frame = shifted(mountain_scene().drawn(mountain_shot()), 0, 1);
  VerifyOptions options;
  options.pixels_per_frame = 60;
  const std::string fast = report(mountain_scene().verified({frame}, options));
  options.walk = Walk::every_cell;
  EXPECT_EQ(report(mountain_scene().verified({frame}, options)), fast);
}

TEST(VerifyReport, progress_tells_the_frames_with_violations_and_the_last_one) {
  Frame good = mountain_scene().drawn(mountain_shot());
  good.bound_px = 2;
  std::vector<Frame> frames(4, good);
  for (std::size_t i = 0; i < frames.size(); ++i) frames[i].name[5] = static_cast<char>('0' + i);
  frames[2] = changed(frames[2], [](float z) { return z * 1.5F; });
  VerifyOptions options;
  options.pixels_per_frame = 20;
  std::ostringstream told;
  const VerifySummary summary = mountain_scene().verified(frames, options, &told);
  EXPECT_NE(told.str().find("frame 000002 (3 of 4): 20 pixels, "), std::string::npos);
  EXPECT_NE(told.str().find("frame 000003 (4 of 4): 20 pixels, 0 violations; so far 80 pixels, " +
                            std::to_string(summary.violations()) + " violations, "),
            std::string::npos)
      << told.str();
}

TEST(VerifyReport, a_frame_may_say_what_its_terms_add_up_to) {
  Frame frame = shifted(mountain_scene().drawn(mountain_shot()), 0, 1);
  frame.bound_px = 2;
  frame.proven_px = 1.25;
  frame.geometry_px = 0.25;
  VerifyOptions options;
  options.pixels_per_frame = 300;
  const VerifySummary summary = mountain_scene().verified({frame}, options);
  EXPECT_EQ(summary.violations(), 0U) << report(summary);
  ASSERT_TRUE(summary.errors.has_proven());
  EXPECT_NEAR(summary.errors.max_of_proven(), summary.error_max_px / 1.25, 1e-12);
  EXPECT_EQ(summary.each_frame.at(0).geometry_px.value_or(0), 0.25);
  EXPECT_NE(report(summary).find("mean proven / mean error"), std::string::npos);
  frame.proven_px = 2.5;
  EXPECT_EQ(mountain_scene().verified(frame).frame_faults, 1U);
}

TEST(VerifyReport, the_json_report_holds_what_the_summary_holds) {
  Frame frame = mountain_scene().drawn(mountain_shot());
  frame.proven_px = 0.25;
  Frame removed = frame;
  removed.name = "000001";
  removed.mode = Mode::removed;
  removed.reasons = {"attitude"};
  removed.bound_px.reset();
  removed.proven_px.reset();
  removed.has_range_file = false;
  Frame wrong = changed(frame, [](float z) { return z * 1.02F; });
  wrong.name = "000002";
  VerifyOptions options;
  options.pixels_per_frame = 200;
  options.seed = 7;
  const VerifySummary summary = mountain_scene().verified({frame, removed, wrong}, options);
  const auto json = nlohmann::json::parse(json_report(options, summary));
  EXPECT_EQ(json.at("options").at("seed"), 7);
  EXPECT_EQ(json.at("options").at("pixels"), 200);
  EXPECT_EQ(json.at("frames"), 3);
  EXPECT_EQ(json.at("removed_frames"), 1);
  EXPECT_EQ(json.at("pixels"), 400);
  EXPECT_EQ(json.at("violations"), summary.violations());
  EXPECT_EQ(json.at("details").size(), summary.details.size());
  ASSERT_GT(summary.violations(), 0U);
  EXPECT_EQ(json.at("error").at("max_px"), summary.error_max_px);
  std::size_t binned = 0;
  for (const auto& bin : json.at("error").at("error_of_bound_histogram")) {
    binned += bin.at("pixels").get<std::size_t>();
  }
  EXPECT_EQ(binned, 400U);
  EXPECT_EQ(json.at("error_without_slack").at("pixels"), summary.errors_without_slack.count());
  ASSERT_EQ(json.at("each_frame").size(), 3U);
  EXPECT_EQ(json["each_frame"][0]["violations"], 0);
  EXPECT_EQ(json["each_frame"][0]["proven_px"], 0.25);
  EXPECT_EQ(json["each_frame"][0]["error_max_px"], 0);
  EXPECT_EQ(json["each_frame"][1]["mode"], "removed");
  EXPECT_TRUE(json["each_frame"][1]["bound_px"].is_null());
  EXPECT_EQ(json["each_frame"][2]["violations"], summary.violations());
  EXPECT_GT(json["each_frame"][2]["error_mean_px"], 0.2);
}

TEST(VerifyReport, undecided_pixels_are_told_by_reason) {
  VerifySummary summary;
  summary.undecided = 3;
  summary.doubts[static_cast<std::size_t>(Doubt::grazing)] = {3, "frame 000000 pixel (1, 2)"};
  EXPECT_NE(report(summary).find("grazing 3, the first: frame 000000 pixel (1, 2)"),
            std::string::npos);
  const auto json = nlohmann::json::parse(json_report(VerifyOptions(), summary));
  EXPECT_EQ(json.at("undecided_reasons").at("grazing").at("pixels"), 3);
  EXPECT_EQ(json.at("undecided_reasons").size(), 1U);
  EXPECT_TRUE(json.at("error").at("mean_proven_px").is_null());
}

TEST(VerifyReport, known_ground_beside_unknown_may_lean_on_it_and_is_counted) {
  const scenes::VerifiedScene scene(scenes::plain_with_void);
  scenes::Shot shot;
  shot.eye = {46.3, 8.5, 1500};
  shot.pitch_deg = -6;
  shot.range_m = 60000;
  const Frame exact = scene.drawn(shot);
  EXPECT_EQ(scene.verified(exact).leaning_on_unknown, 0U);
  // Ground behind the void, shown too far: the unknown pixels around may hide the true one.
  Frame frame = changed(exact, [](float z) { return z > 33000 && z < 45000 ? 1.1F * z : z; });
  frame.bound_px = 3;
  VerifyOptions options;
  options.all_pixels = true;
  const VerifySummary summary = scene.verified({frame}, options);
  EXPECT_GT(summary.leaning_on_unknown, 0U) << report(summary);
}

}  // namespace
}  // namespace ridgeline::oracle
