// A case is one line of text: read and written alike, and refused where it is no case.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sim/attack/random_case.hpp"

namespace ridgeline::sim {
namespace {

const std::string plain =
    "at=46,8 land=flat:100 tile=dt0:46,8 window=96 arrival=settled size=64,48 hfov=60 error=1 "
    "range=10000 pose=46.5,8.5,2000,0,-5,90,0";

AttackCase parsed(const std::string& text) {
  AttackCase c;
  EXPECT_EQ(parse_case(text, c), "") << text;
  return c;
}

TEST(CaseText, says_everything_that_a_case_holds) {
  const std::string text =
      "at=46,8 land=fractal:1200.5,8000,17 land=box:-3,4,5,6 tile=hgt:46,8 "
      "tile=tif32:46.1,-8.25,1200,600,60,80 sea=45,-180 "
      "edit=2,46.25,8.5,120,120,2,3,void edit=3,46,8,120,120,1,1,-5.5 geoid=20,5,7 window=0.5 "
      "arrival=in_step size=120,33 hfov=47.5 error=0.3 range=12345 "
      "pose=46.5,8.333333333333334,2000.125,180,-89.999,-90,0 pose=-0.1,0,2,0,90,1e-06,4";
  const AttackCase c = parsed(text);
  EXPECT_EQ(text_of(c), text);
  ASSERT_EQ(c.land.size(), 2U);
  EXPECT_EQ(c.land[0].kind, LayerKind::fractal);
  EXPECT_EQ(c.land[0].numbers[0], 1200.5);
  ASSERT_EQ(c.tiles.size(), 2U);
  EXPECT_EQ(c.tiles[1].lon_per_deg, 600);
  EXPECT_EQ(c.tiles[1].columns, 80);
  EXPECT_EQ(c.sea[0].west_deg, -180);
  EXPECT_TRUE(std::isnan(c.edits[0].height_m));
  EXPECT_EQ(c.edits[1].height_m, -5.5);
  EXPECT_EQ(c.geoid.step_deg, 5);
  EXPECT_EQ(c.arrival, SceneOptions::Arrival::in_step);
  EXPECT_EQ(c.image.height_px, 33);
  EXPECT_EQ(c.poses[1].heading_deg, 1e-6);
  EXPECT_EQ(c.poses[1].time_s, 4);
}

TEST(CaseText, of_every_random_case_is_read_back_to_the_same_bits) {
  for (std::uint64_t number = 0; number < 300; ++number) {
    const AttackCase c = random_case(5, number);
    const std::string text = text_of(c);
    const AttackCase again = parsed(text);
    EXPECT_EQ(text_of(again), text);
    EXPECT_EQ(again.land, c.land);
    EXPECT_EQ(again.tiles, c.tiles);
    EXPECT_EQ(again.sea, c.sea);
    EXPECT_EQ(again.edits, c.edits);
    EXPECT_EQ(again.geoid, c.geoid);
    EXPECT_EQ(again.poses, c.poses);
    EXPECT_EQ(again.window_mib, c.window_mib);
    EXPECT_EQ(again.range_m, c.range_m);
    EXPECT_EQ(again.error_px, c.error_px);
    EXPECT_EQ(again.arrival, c.arrival);
  }
}

TEST(CaseText, knows_every_kind_of_layer_by_its_name) {
  for (int kind = 0; kind < layer_kinds; ++kind) {
    const LayerForm& form = layer_form(static_cast<LayerKind>(kind));
    std::string word = std::string("land=") + form.name;
    for (std::size_t n = 0; n < form.count; ++n) word += (n == 0 ? ":" : ",") + std::string("1");
    AttackCase c;
    ASSERT_EQ(parse_case(plain + " " + word, c), "") << word;
    EXPECT_EQ(c.land.back().kind, static_cast<LayerKind>(kind)) << word;
    EXPECT_NE(parse_case(plain + " " + word + ",1", c), "") << word;
  }
}

class Refused : public testing::TestWithParam<const char*> {};

TEST_P(Refused, word_is_named_in_the_message) {
  const std::string word = GetParam();
  AttackCase c = parsed(plain);
  const AttackCase before = c;
  const std::string message = parse_case(plain + " " + word, c);
  EXPECT_NE(message.find("\"" + word + "\""), std::string::npos) << message;
  EXPECT_TRUE(c == before);  // a refused text changes nothing
}

INSTANTIATE_TEST_SUITE_P(
    Words, Refused,
    testing::Values("nonsense", "=", "size=1", "size=10,10", "size=4096,4096", "hfov=60",
                    "land=flat:", "land=flat:x", "land=flat:1,2", "land=flat:nan", "land=flat:inf",
                    "land=flat:1e9", "land=hills:1", "land=walls:1,0,1,0,0", "land=walls:1,2,1,4,0",
                    "land=spires:1,2.5,3", "land=stairs:0", "land=flat:1,", "land=flat:,1",
                    "land=flat:void", "tile=hgt:46.5,8", "tile=hgt:90,8", "tile=bil:46,8",
                    "tile=tif16:46,8,1200,1200,1,60", "tile=tif16:89.9,8,120,120,60,60",
                    "tile=tif16:46,8,1,1,2,400", "tile=tif16:46,8,1200,1200,20000,20000",
                    "tile=tif16:46,8,1200", "sea=90,0", "sea=1", "pose=91,0,0,0,0,0,0",
                    "pose=0,0,30000,0,0,0,0", "pose=0,0,0,0,0,0", "pose=0,0,0,0,91,0,0",
                    "edit=0,46,8,120,120,1,1,9001", "edit=0,46,8,120,120,0,1,5",
                    "edit=0,46,8,120,120,1,1", "geoid=20,7,1", "geoid=500,10,1", "geoid=20,10",
                    "arrival=late", "error=0", "range=10", "window=0", "at=1,2"));

TEST(CaseText, without_a_tile_or_a_pose_is_no_case) {
  AttackCase c;
  EXPECT_NE(parse_case("", c), "");
  EXPECT_NE(parse_case("pose=0,0,100,0,0,0,0", c), "");
  EXPECT_NE(parse_case("tile=dt0:0,0", c), "");
  EXPECT_EQ(parse_case("tile=dt0:0,0 pose=0,0,100,0,0,0,0", c), "");
}

}  // namespace
}  // namespace ridgeline::sim
