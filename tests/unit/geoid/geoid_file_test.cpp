#include "platform/geoid_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <GeographicLib/Geoid.hpp>
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/support/temporary_folder.hpp"
#include "tests/unit/geoid/geoid_writer.hpp"

namespace ridgeline {
namespace {

using test::geoid_gtx_bytes;
using test::geoid_pgm_bytes;
using test::GtxPlace;
using test::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

using Bytes = std::vector<std::byte>;

unsigned bumpy(int row, int column) {
  return static_cast<unsigned>((row * 7919 + column * 104729) % 65536);
}

Bytes small_pgm() {
  return geoid_pgm_bytes(24, 13, "-108", "0.003", bumpy);
}

constexpr GtxPlace world{-90, -180, 15, 15, 13, 24};

Bytes small_gtx() {
  return geoid_gtx_bytes(world, [](int row, int column) {
    return static_cast<float>(row) - 2.5F * static_cast<float>(column);
  });
}

class GeoidFiles : public testing::Test {
 protected:
  FileResult<GeoidFile> loaded(const std::string& name, const Bytes& bytes) {
    test::write_bytes(folder_.file(name), bytes);
    return load_geoid(folder_.file(name));
  }

  void expect_refused(const std::string& name, const Bytes& bytes, Fault fault,
                      const std::string& detail) {
    const FileResult<GeoidFile> result = loaded(name, bytes);
    ASSERT_FALSE(result.ok()) << detail;
    EXPECT_EQ(fault_id(result.problem().fault), fault_id(fault)) << detail;
    EXPECT_THAT(result.problem().message,
                AllOf(StartsWith(folder_.file(name) + ": "), HasSubstr(detail)));
  }

  TemporaryFolder folder_;
};

Bytes replaced(Bytes bytes, std::string_view from, std::string_view to) {
  std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::size_t at = text.find(from);
  RL_ASSERT(at != std::string::npos);
  text.replace(at, from.size(), to);
  const std::span<const std::byte> changed = std::as_bytes(std::span(text));
  return {changed.begin(), changed.end()};
}

TEST_F(GeoidFiles, none_is_zero_everywhere) {
  const FileResult<GeoidFile> geoid = load_geoid("none");
  ASSERT_TRUE(geoid.ok());
  EXPECT_EQ(geoid.value().name(), "none");
  EXPECT_EQ(undulation_m(geoid.value().grid(), 46, 8), 0.0);
}

TEST_F(GeoidFiles, pgm_agrees_with_geographiclib) {
  const FileResult<GeoidFile> geoid = loaded("small.pgm", small_pgm());
  ASSERT_TRUE(geoid.ok());
  EXPECT_EQ(geoid.value().name(), "small.pgm");
  const GeographicLib::Geoid reference("small", folder_.path(), /*cubic=*/false);
  double worst_m = 0;
  int places = 0;
  for (double latitude_deg = -90; latitude_deg <= 90; latitude_deg += 1.25) {
    for (double longitude_deg = -360; longitude_deg <= 360; longitude_deg += 2.75) {
      const double ours_m = undulation_m(geoid.value().grid(), latitude_deg, longitude_deg);
      const double error_m = std::abs(ours_m - reference(latitude_deg, longitude_deg));
      ASSERT_FALSE(std::isnan(error_m));
      worst_m = std::max(worst_m, error_m);
      ++places;
    }
  }
  EXPECT_GT(places, 30000);
  EXPECT_LE(worst_m, 8e-6);
}

TEST_F(GeoidFiles, gtx_runs_from_the_south_west) {
  const FileResult<GeoidFile> geoid = loaded("small.gtx", small_gtx());
  ASSERT_TRUE(geoid.ok());
  EXPECT_EQ(geoid.value().name(), "small.gtx");
  const GeoidGrid grid = geoid.value().grid();
  EXPECT_DOUBLE_EQ(undulation_m(grid, -90, -180), 0.0);
  EXPECT_DOUBLE_EQ(undulation_m(grid, -75, -180), 1.0);
  EXPECT_DOUBLE_EQ(undulation_m(grid, -90, -165), -2.5);
  EXPECT_DOUBLE_EQ(undulation_m(grid, -82.5, -172.5), 0.5 - 1.25);
  EXPECT_DOUBLE_EQ(undulation_m(grid, 90, 165), 12 - 2.5 * 23);
}

TEST_F(GeoidFiles, gtx_post_without_data_is_unknown) {
  const Bytes bytes = geoid_gtx_bytes(
      world, [](int row, int column) { return row == 6 && column == 12 ? -88.8888F : -88.9F; });
  const FileResult<GeoidFile> geoid = loaded("holes.gtx", bytes);
  ASSERT_TRUE(geoid.ok());
  EXPECT_TRUE(std::isnan(undulation_m(geoid.value().grid(), 1, 1)));
  EXPECT_NEAR(undulation_m(geoid.value().grid(), 31, 31), -88.9, 1e-5);
}

TEST_F(GeoidFiles, copies_and_moves_keep_their_posts) {
  FileResult<GeoidFile> geoid = loaded("small.gtx", small_gtx());
  ASSERT_TRUE(geoid.ok());
  const GeoidFile copy = geoid.value();
  const GeoidFile moved = std::move(geoid).value();
  EXPECT_DOUBLE_EQ(undulation_m(copy.grid(), -75, -180), 1.0);
  EXPECT_DOUBLE_EQ(undulation_m(moved.grid(), -75, -180), 1.0);
}

TEST_F(GeoidFiles, missing_file_and_folder_are_named) {
  const std::string missing = folder_.file("missing.pgm");
  const FileResult<GeoidFile> geoid = load_geoid(missing);
  ASSERT_FALSE(geoid.ok());
  EXPECT_EQ(geoid.problem().fault, Fault::geoid_unreadable);
  EXPECT_EQ(geoid.problem().message,
            missing + ": geoid file cannot be read (No such file or directory)");
  EXPECT_EQ(load_geoid(folder_.path()).problem().fault, Fault::geoid_unreadable);
}

TEST_F(GeoidFiles, other_formats_are_refused) {
  expect_refused("a.png", Bytes(100), Fault::geoid_unreadable, "neither");
  expect_refused("empty.pgm", {}, Fault::geoid_unreadable, "neither");
}

TEST_F(GeoidFiles, every_cut_of_a_pgm_is_found) {
  const Bytes bytes = small_pgm();
  for (std::size_t size = 2; size < bytes.size(); size += 13) {
    const Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    expect_refused("cut.pgm", cut, Fault::geoid_corrupt, "");
  }
  Bytes longer = bytes;
  longer.push_back(std::byte{0});
  expect_refused("long.pgm", longer, Fault::geoid_corrupt, "its header asks for");
}

TEST_F(GeoidFiles, every_cut_of_a_gtx_is_found) {
  const Bytes bytes = small_gtx();
  for (std::size_t size = 0; size < bytes.size(); size += 13) {
    const Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    expect_refused("cut.gtx", cut, Fault::geoid_corrupt, "");
  }
  Bytes longer = bytes;
  longer.push_back(std::byte{0});
  expect_refused("long.gtx", longer, Fault::geoid_corrupt, "its header asks for");
}

TEST_F(GeoidFiles, damaged_pgm_header_is_refused) {
  const auto refused = [&](std::string_view from, std::string_view to, const char* detail) {
    expect_refused("bad.pgm", replaced(small_pgm(), from, to), Fault::geoid_corrupt, detail);
  };
  refused("# Offset -108", "# Comment", "no Offset");
  refused("# Offset -108", "# Offset -10x", "no Offset");
  refused("# Scale 0.003", "# Scale", "no Scale");
  refused("# Scale 0.003", "# Scale -1", "Scale");
  refused("# Scale 0.003", "# Scale nan", "Scale");
  refused("# Offset -108", "# Offset inf", "Offset");
  refused("# Origin 90N 0E", "# Origin 90S 0E", "Origin");
  refused("65535", "255", "header");
  // Found by fuzzing: the display took these for what the oracle does not.
  refused("65535", "65535\t", "header");
  refused("# Scale 0.003", "# Scale\r-0.003", "Scale");
  refused("24 13", "24 x3", "header");
  refused("24 13", "-24 13", "header");
  refused("24 13", "1 13", "header");
  refused("24 13", "2400000000 13", "header");
  refused("24 13", "24 14", "its header asks for");
  refused("# Offset -108", "# Offset -300", "an undulation of");
}

TEST_F(GeoidFiles, damaged_gtx_header_is_refused) {
  const auto refused = [&](const GtxPlace& place, const char* detail) {
    Bytes bytes = small_gtx();
    const Bytes header = geoid_gtx_bytes(place, [](int, int) { return 0.0F; });
    std::copy_n(header.begin(), 40, bytes.begin());
    expect_refused("bad.gtx", bytes, Fault::geoid_corrupt, detail);
  };
  refused({-91, -180, 15, 15, 13, 24}, "GTX");
  refused({-90, -180, 15, 15, 14, 24}, "GTX");
  refused({-90, -180, 15, 15, 12, 24}, "its header asks for");
  refused({-90, -180, 0, 15, 13, 24}, "GTX");
  refused({-90, -180, 1e-300, 15, 13, 24}, "GTX");
  refused({-90, -180, 15, 1e-5, 13, 24}, "GTX");
  refused({-90, -180, 15, -15, 13, 24}, "GTX");
  refused({-90, -180, 15, 15, 1, 24}, "GTX");
  refused({-90, 1e9, 15, 15, 13, 24}, "GTX");
  refused({std::nan(""), -180, 15, 15, 13, 24}, "GTX");
  refused({-90, -180, std::nan(""), 15, 13, 24}, "GTX");
}

TEST_F(GeoidFiles, impossible_gtx_undulation_is_refused) {
  for (const float bad_m : {201.0F, -201.0F, std::nanf("")}) {
    const Bytes bytes = geoid_gtx_bytes(
        world, [&](int row, int column) { return row == 12 && column == 23 ? bad_m : 0.0F; });
    expect_refused("bad.gtx", bytes, Fault::geoid_corrupt, "an undulation of");
  }
}

}  // namespace
}  // namespace ridgeline
