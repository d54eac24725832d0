// What the pilot's switches make of the picture, pixel by pixel: light taken away by night, lines
// and words by decluttering, nothing else by either.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <nlohmann/json.hpp>

#include "config/limits_display.hpp"
#include "sim/session/display_json.hpp"
#include "tests/gl/scene.hpp"

namespace ridgeline::test {
namespace {

constexpr ImageGeometry image{320, 240, 60};

double factor_of(double luminance) {
  return std::pow(luminance, 1.0 / limits::display_gamma);
}

class Display : public testing::Test {
 protected:
  sim::Picture draw(const DisplayState& display) {
    FrameInput input;
    input.eye = {46.5, 8.5, 2600};
    input.attitude = {6, -4, 40};
    if (lost_) {
      add_reason(input.availability, *lost_);
      input.attitude_valid = *lost_ != Reason::attitude_stale;
    }
    input.display = display;
    sim::Picture picture = scene_.session().draw(input, true);
    EXPECT_TRUE(picture.problem.ok());
    return picture;
  }
  /// Channels of all pixels, one after the other.
  static void for_each_channel(const sim::Picture& a, const sim::Picture& b,
                               const std::function<void(int, int, int)>& visit) {
    ASSERT_EQ(a.rgb.size(), b.rgb.size());
    for (std::size_t k = 0; k < a.rgb.size(); ++k) {
      visit(static_cast<int>(k / 3), a.rgb[k], b.rgb[k]);
    }
  }
  static bool same_ranges(const sim::Picture& a, const sim::Picture& b) {
    return std::equal(a.range_m.begin(), a.range_m.end(), b.range_m.begin(), b.range_m.end(),
                      [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); });
  }

  RoughTile land_;
  Scene scene_{land_, image, 1.0, 30'000, {46.5, 8.5, 2600}};
  std::optional<Reason> lost_;
};

TEST_F(Display, by_night_every_channel_keeps_its_share_of_the_light) {
  const sim::Picture day = draw({});
  ASSERT_EQ(day.report.availability.mode, Mode::svs);
  for (const double share : {0.6, 0.15, 0.10}) {
    const sim::Picture night = draw({share, false});
    double largest = 0, sum = 0;
    for_each_channel(day, night, [&](int, int before, int after) {
      const double off = after - factor_of(share) * before;
      largest = std::max(largest, std::abs(off));
      sum += off;
    });
    EXPECT_LE(largest, 1.5) << share << ": a level of 256, and rounding";
    EXPECT_LE(std::abs(sum) / static_cast<double>(day.rgb.size()), 0.5) << share;
    EXPECT_TRUE(same_ranges(day, night));
    EXPECT_EQ(day.report.bound_px, night.report.bound_px);
  }
}

/// Also that of the levels of one channel, and at the darkest level there is.
TEST_F(Display, by_night_colours_keep_their_order) {
  const sim::Picture day = draw({});
  const sim::Picture night = draw({limits::least_night_luminance, false});
  std::array<int, 256> lowest{}, highest{};
  lowest.fill(255);
  highest.fill(0);
  const int words_from = image.width_px * (image.height_px - 24);  // these keep more
  for_each_channel(day, night, [&](int pixel, int before, int after) {
    if (pixel >= words_from) return;
    auto& low = lowest[static_cast<std::size_t>(before)];
    auto& high = highest[static_cast<std::size_t>(before)];
    low = std::min(low, after);
    high = std::max(high, after);
  });
  int below = 0, levels = 0;
  for (std::size_t level = 0; level < 256; ++level) {
    if (lowest[level] > highest[level]) continue;  // not in the picture
    EXPECT_GE(lowest[level], below) << level;
    below = highest[level];
    ++levels;
  }
  EXPECT_GT(levels, 150) << "the picture has colours enough to judge";
  EXPECT_GT(below, 40) << "and is not black";
}

TEST_F(Display, svs_off_and_the_red_cross_stay_legible_at_the_darkest_level) {
  lost_ = Reason::attitude_stale;
  const sim::Picture night = draw({limits::least_night_luminance, false});
  ASSERT_EQ(night.report.availability.mode, Mode::removed);
  const double least = factor_of(limits::least_words_luminance);
  // On the diagonal, off the words: the cross of shaders/shade.frag.
  const auto corner = static_cast<std::size_t>(3 * (12 * image.width_px + 16));
  EXPECT_NEAR(night.rgb[corner], least * 0.85 * 255, 1.5);
  EXPECT_LE(night.rgb[corner + 1], least * 0.05 * 255 + 1.5);
  const auto beside = static_cast<std::size_t>(3 * (12 * image.width_px + 60));
  EXPECT_LE(night.rgb[beside], least * 0.05 * 255 + 1.5) << "dark around it";
  int red = 0, brightest = 0;
  for (std::size_t k = 0; k < night.rgb.size(); k += 3) {
    const bool word = std::abs(night.rgb[k] - least * 255) < 1.5 &&
                      std::abs(night.rgb[k + 1] - least * 0.25 * 255) < 1.5;
    red += word ? 1 : 0;
    brightest = std::max<int>(brightest, night.rgb[k + 1]);
  }
  EXPECT_GT(red, 300) << "SVS OFF in red";
  EXPECT_NEAR(brightest, least * 255, 1.5) << "its reason in white";
}

TEST_F(Display, without_a_position_the_horizon_is_dimmed_and_svs_off_is_not_below_its_least) {
  lost_ = Reason::position_stale;
  const sim::Picture day = draw({});
  const sim::Picture night = draw({limits::least_night_luminance, false});
  const auto sky = static_cast<std::size_t>(3 * (4 * image.width_px + 4));
  EXPECT_NEAR(night.rgb[sky + 2], factor_of(limits::least_night_luminance) * day.rgb[sky + 2], 1.5);
  const auto largest = [](const sim::Picture& picture) {
    return static_cast<int>(*std::max_element(picture.rgb.begin(), picture.rgb.end()));
  };
  EXPECT_EQ(largest(day), 255);
  EXPECT_NEAR(largest(night), factor_of(limits::least_words_luminance) * 255, 1.5);
}

TEST_F(Display, decluttered_has_no_lines_on_the_ground_and_everything_else) {
  const sim::Picture all = draw({});
  const sim::Picture fewer = draw({1.0, true});
  EXPECT_TRUE(same_ranges(all, fewer));
  EXPECT_EQ(all.report.bound_px, fewer.report.bound_px);
  EXPECT_EQ(all.report.detail, fewer.report.detail) << "the monitor has shed nothing";
  EXPECT_TRUE(fewer.report.availability.reasons.empty());
  const int words_from = image.width_px * (image.height_px - 24);
  int lines = 0;
  for_each_channel(all, fewer, [&](int pixel, int with, int without) {
    if (pixel >= words_from) return;
    const float range_m = all.range_m[static_cast<std::size_t>(pixel)];
    if (std::isinf(range_m)) {
      EXPECT_EQ(with, without) << "sky and line of zero pitch at pixel " << pixel;
    }
    EXPECT_LE(with, without + 1) << "a line is darker than its ground, pixel " << pixel;
    lines += without - with > 8 ? 1 : 0;
  });
  EXPECT_GT(lines, 1500) << "of contours and grid";
  // BOUND 1.00 PX stands in the right half of the last rows, over the same ground.
  int ink = 0;
  for (int y = image.height_px - 12; y < image.height_px; ++y) {
    for (int x = image.width_px - 80; x < image.width_px; ++x) {
      const auto at = static_cast<std::size_t>(3 * (y * image.width_px + x));
      EXPECT_EQ(all.rgb[at] == 255, fewer.rgb[at] == 255);
      ink += fewer.rgb[at] == 255 && fewer.rgb[at + 2] == 255 ? 1 : 0;
    }
  }
  EXPECT_GT(ink, 100);
}

TEST_F(Display, both_switches_at_once_dim_the_decluttered_picture) {
  const sim::Picture fewer = draw({1.0, true});
  const sim::Picture both = draw({0.3, true});
  double largest = 0;
  for_each_channel(fewer, both, [&](int, int before, int after) {
    largest = std::max(largest, std::abs(after - factor_of(0.3) * before));
  });
  EXPECT_LE(largest, 1.5);
}

TEST_F(Display, a_switch_leaves_nothing_behind_for_the_next_frame) {
  const sim::Picture before = draw({});
  draw({0.1, true});
  const sim::Picture after = draw({});
  EXPECT_EQ(before.rgb, after.rgb);
  EXPECT_EQ(draw({1.0, false}).rgb, before.rgb) << "night at full light is day";
}

TEST_F(Display, a_report_says_what_was_switched_and_nothing_of_a_plain_day) {
  EXPECT_TRUE(sim::display_json(draw({}).report.display).is_null());
  const auto said = sim::display_json(draw({limits::least_night_luminance, true}).report.display);
  EXPECT_EQ(said["luminance"], limits::least_night_luminance);
  EXPECT_EQ(said["words_luminance"], limits::least_words_luminance);
  EXPECT_EQ(said["declutter"], true);
}

}  // namespace
}  // namespace ridgeline::test
