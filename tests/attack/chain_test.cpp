// The whole chain: a case drawn by the renderer and judged by the oracle, with pictures broken on
// purpose, and a case that ends its process.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <limits>
#include <sstream>

#include "sim/attack/attack.hpp"
#include "sim/attack/shrink.hpp"

namespace ridgeline::sim {
namespace {

AttackCase spires() {
  AttackCase c;
  const std::string wrong = parse_case(
      "at=46,8 land=flat:200 land=spires:900,40,5 land=rough:3,1 "
      "tile=tif16:45.97,7.97,1200,1200,85,85 size=48,36 range=4000 "
      "pose=46,8,700,0,-6,30,0 pose=46,8,800,10,-8,120,1 pose=46.01,8.01,900,0,-5,200,2",
      c);
  EXPECT_EQ(wrong, "");
  return c;
}

/// Shows sky instead of one high piece of ground before sky or farther ground.
void lose_a_silhouette(Picture& picture) {
  const int width = picture.report.camera.width_px, height = picture.report.camera.height_px;
  for (int v = 2; v < height - 2; ++v) {
    for (int u = 2; u < width - 2; ++u) {
      const auto at = [&](int x, int y) -> float& {
        return picture.range_m[static_cast<std::size_t>(y * width + x)];
      };
      if (!std::isfinite(at(u, v)) || !std::isinf(at(u, v - 1)) || at(u, v) > 2'000) continue;
      for (int y = v; y < std::min(v + 6, height); ++y) {
        for (int x = u - 2; x <= u + 2; ++x) at(x, y) = std::numeric_limits<float>::infinity();
      }
      return;
    }
  }
}

TEST(Chain, finds_nothing_in_pictures_as_they_are_drawn) {
  const CaseResult result = judge_case(spires(), {});
  EXPECT_EQ(result.fault, "");
  EXPECT_EQ(result.unusable, "");
  EXPECT_EQ(result.frames, 3U);
  EXPECT_EQ(result.removed, 0U);
  EXPECT_EQ(result.pixels, 3U * 48 * 36);
  EXPECT_EQ(result.violations, 0U) << result.details.front();
  EXPECT_EQ(result.levels, 1);
}

TEST(Chain, finds_a_lost_silhouette_and_the_smaller_case_still_has_it) {
  JudgeOptions options;
  options.spoil = lose_a_silhouette;
  const CaseResult result = judge_case(spires(), options);
  ASSERT_GT(result.violations, 0U);
  ASSERT_FALSE(result.details.empty());
  EXPECT_NE(result.details.front().find("violates"), std::string::npos);
  const auto fails = [&](const AttackCase& c) { return judge_case(c, options).violations > 0; };
  const AttackCase smallest = shrunk(spires(), fails, 10);
  EXPECT_TRUE(fails(smallest)) << text_of(smallest);
  EXPECT_EQ(smallest.poses.size(), 1U);
  EXPECT_LT(text_of(smallest).size(), text_of(spires()).size());
  EXPECT_EQ(judge_case(smallest, {}).violations, 0U);
}

TEST(Chain, distances_a_fiftieth_too_far_are_found) {
  JudgeOptions options;
  options.spoil = [](Picture& picture) {
    for (float& z : picture.range_m) z *= 1.02F;
  };
  EXPECT_GT(judge_case(spires(), options).violations, 0U);
}

TEST(Chain, a_crash_or_a_hang_is_a_fault_of_the_case) {
  JudgeOptions crashing;
  crashing.spoil = [](Picture&) { static_cast<void>(std::raise(SIGKILL)); };
  EXPECT_EQ(judge_case(spires(), crashing).fault, "ended by signal 9");
  JudgeOptions hanging;
  hanging.longest_s = 0.5;
  hanging.spoil = [](Picture&) {
    for (;;) static_cast<void>(::raise(SIGSTOP));
  };
  EXPECT_EQ(judge_case(spires(), hanging).fault, "did not end in time");
}

TEST(Chain, a_case_without_terrain_near_is_told_and_not_judged) {
  AttackCase c = spires();
  for (AttackPose& pose : c.poses) pose.latitude_deg = 10;
  const CaseResult result = judge_case(c, {});
  EXPECT_EQ(result.removed, 3U);
  EXPECT_EQ(result.reasons.count("terrain_missing"), 1U);
  EXPECT_EQ(result.pixels, 0U);
  EXPECT_FALSE(result.failed());
}

TEST(Chain, keeps_its_files_where_it_is_told_to) {
  const auto kept =
      std::filesystem::temp_directory_path() / ("ridgeline_kept_" + std::to_string(::getpid()));
  JudgeOptions options;
  options.keep_folder = kept.string();
  static_cast<void>(judge_case(spires(), options));
  EXPECT_TRUE(std::filesystem::exists(kept / "dumps" / "000002_range.npy"));
  EXPECT_TRUE(std::filesystem::exists(kept / "tiles" / "tile0.tif"));
  std::filesystem::remove_all(kept);
}

}  // namespace
}  // namespace ridgeline::sim
