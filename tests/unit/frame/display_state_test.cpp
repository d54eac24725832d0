#include "core/frame/display_state.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "config/limits_display.hpp"
#include "core/frame/font.hpp"
#include "core/frame/picture.hpp"

namespace ridgeline {
namespace {

TEST(DisplayState, by_day_every_factor_is_exactly_one) {
  for (const bool attitude_valid : {true, false}) {
    const Dimming day = dimming_of({}, attitude_valid);
    EXPECT_EQ(day.picture, 1.0F);
    EXPECT_EQ(day.words, 1.0F);
    EXPECT_EQ(dimming_of({1.0, true}, attitude_valid).picture, 1.0F) << "decluttered";
  }
}

TEST(DisplayState, factors_of_encoded_colours_give_the_share_in_linear_light) {
  for (const double share : {0.05, 0.10, 0.15, 0.5, 0.99}) {
    const Dimming night = dimming_of({share, false}, true);
    EXPECT_NEAR(std::pow(static_cast<double>(night.picture), limits::display_gamma), share, 1e-6);
  }
}

TEST(DisplayState, words_and_the_red_cross_keep_their_least_light) {
  const DisplayState dark{limits::least_night_luminance, false};
  ASSERT_LT(dark.luminance, limits::least_words_luminance);
  EXPECT_EQ(words_luminance(dark), limits::least_words_luminance);
  EXPECT_EQ(picture_luminance(dark, true), dark.luminance);
  EXPECT_EQ(picture_luminance(dark, false), limits::least_words_luminance) << "a red cross";
  EXPECT_EQ(dimming_of(dark, false).picture, dimming_of(dark, false).words);
}

TEST(DisplayState, above_that_words_are_dimmed_like_the_picture) {
  const DisplayState night{0.4, false};
  EXPECT_EQ(words_luminance(night), 0.4);
  EXPECT_EQ(dimming_of(night, true).words, dimming_of(night, true).picture);
}

/// What no configuration should say still never makes a picture brighter, nor words dark.
TEST(DisplayState, shares_that_are_none_stay_between_black_and_day) {
  EXPECT_EQ(dimming_of({2.0, false}, true).picture, 1.0F);
  EXPECT_EQ(dimming_of({-1.0, false}, true).picture, 0.0F);
  EXPECT_GT(dimming_of({-1.0, false}, true).words, 0.3F);
}

/// The words of a frame, 320 x 240.
class Words : public testing::Test {
 protected:
  Words() {
    report_.camera.width_px = width;
    report_.camera.height_px = height;
    report_.bound_px = 1.25;
  }
  std::vector<std::uint8_t> layer(bool declutter) {
    report_.display.declutter = declutter;
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(width) * height);
    text_layer(report_, bytes);
    return bytes;
  }
  static int inked(const std::vector<std::uint8_t>& bytes, int ink) {
    return static_cast<int>(std::count(bytes.begin(), bytes.end(), ink));
  }

  static constexpr int width = 640, height = 240;
  FrameReport report_;
};

TEST_F(Words, decluttered_lose_half_of_the_notice_and_nothing_else) {
  add_reason(report_.availability, Reason::bound_exceeded);
  add_reason(report_.availability, Reason::detail_shed);
  const auto all = layer(false), fewer = layer(true);
  // The notice begins in the corner: "NOT CERTIFIED" stands, what followed it is gone.
  constexpr int scale = 2, letter = (glyph_columns + 1) * scale;
  constexpr int kept_px = 4 * scale + 13 * letter + 2 * scale;
  constexpr int notice_px = 4 * scale + 33 * letter + 2 * scale;
  int gone = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto at = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
      if (all[at] == fewer[at]) continue;
      ++gone;
      EXPECT_TRUE(x >= kept_px - 2 * scale && x < notice_px && y > height - 40) << x << " " << y;
      EXPECT_EQ(fewer[at], 0);
    }
  }
  EXPECT_GT(gone, 1000);
  EXPECT_EQ(inked(all, shader::text_caution), inked(fewer, shader::text_caution));
}

TEST_F(Words, of_a_removed_picture_keep_svs_off_and_its_reason_when_decluttered) {
  add_reason(report_.availability, Reason::position_stale);
  const auto all = layer(false), fewer = layer(true);
  EXPECT_GT(inked(fewer, shader::text_warning), 100);
  EXPECT_EQ(inked(all, shader::text_warning), inked(fewer, shader::text_warning));
}

}  // namespace
}  // namespace ridgeline
