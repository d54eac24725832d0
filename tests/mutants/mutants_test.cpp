// Checks that can fail: the oracle finds nothing wrong with the renderer in any designed scene, and
// something wrong with every mutant of it in the scene made for that.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <glm/vec2.hpp>
#include <numbers>
#include <set>
#include <sstream>

#include "config/limits.hpp"
#include "core/frame/ray_witness.hpp"
#include "core/geo/ground_map.hpp"
#include "shaders/count_comp.hpp"
#include "shaders/ray_cast_frag.hpp"
#include "shaders/sweep_comp.hpp"
#include "tests/mutants/active.hpp"
#include "tests/mutants/judged_scene.hpp"
#include "tests/mutants/mutant.hpp"

namespace ridgeline::test {
namespace {

std::string text_of(std::string_view file) {
  std::ifstream source(std::string(RL_TREE "/") + std::string(file));
  std::ostringstream text;
  text << source.rdbuf();
  return text.str();
}

std::string name_of(const testing::TestParamInfo<int>& info) {
  return std::string(mutants()[static_cast<std::size_t>(info.param)].name);
}

std::string scene_name_of(const testing::TestParamInfo<int>& info) {
  return std::string(designed_scenes()[static_cast<std::size_t>(info.param)].name);
}

std::vector<int> range_of(std::size_t from, std::size_t count) {
  std::vector<int> indices;
  for (std::size_t k = from; k < from + count; ++k) indices.push_back(static_cast<int>(k));
  return indices;
}

/// Every text of a mutant stands exactly once in its source, and once at most in every program.
void expect_applies(const Mutant& mutant) {
  EXPECT_EQ(count_of(text_of(mutant.file), mutant.find), 1) << mutant.name << ": " << mutant.find;
  EXPECT_NE(mutant.find, mutant.put) << mutant.name;
  if (mutant.file.starts_with("shaders/")) {
    int programs = 0;
    for (const std::string_view program :
         {shader::sweep_comp, shader::ray_cast_frag, shader::count_comp}) {
      EXPECT_LE(count_of(program, mutant.find), 1) << mutant.name;
      programs += count_of(program, mutant.find);
    }
    EXPECT_GE(programs, 1) << mutant.name << " is in no program";
    return;
  }
  EXPECT_NE(std::string_view(RL_MUTATED).find(':' + std::string(mutant.file) + ':'),
            std::string_view::npos)
      << mutant.name << ": " << mutant.file << " is not among the copies";
}

TEST(MutantTable, every_text_stands_in_its_source_exactly_once) {
  std::set<std::string_view> names;
  for (const Mutant& mutant : mutants()) {
    expect_applies(mutant);
    EXPECT_TRUE(names.insert(mutant.name).second) << mutant.name;
    EXPECT_NE(find_scene(mutant.scene), nullptr) << mutant.name << ": " << mutant.scene;
  }
}

class Unmutated : public testing::TestWithParam<int> {};

TEST_P(Unmutated, scene_is_drawn_and_sound) {
  const DesignedScene& scene = designed_scenes()[static_cast<std::size_t>(GetParam())];
  set_active_mutant(no_mutant);
  const SceneVerdict verdict = judged(scene, Thoroughness::every_pixel);
  EXPECT_EQ(verdict.violations, 0U) << verdict.first;
  EXPECT_EQ(verdict.frames + scene.removed, scene.poses.size());
  EXPECT_LE(verdict.undecided, verdict.pixels / 1000);
  std::printf(
      "[ oracle ] %zu pixels, %zu undecided, bound at most %.3g px, error at most %.3f of it\n",
      verdict.pixels, verdict.undecided, verdict.largest_bound_px, verdict.largest_of_bound);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Unmutated,
                         testing::ValuesIn(range_of(0, designed_scenes().size())), scene_name_of);

/// What a mutant breaks in all of its scene, for docs/evidence/mutants.md.
void append_row(const char* file, const Mutant& mutant, const SceneVerdict& verdict) {
  std::ofstream table(file, std::ios::app);
  table << "| " << mutant.name << " | " << mutant.scene << " | " << verdict.violations << " of "
        << verdict.pixels << " |\n";
  table.flush();
  ASSERT_TRUE(table) << file << ": cannot be written";
}

class Mutated : public testing::TestWithParam<int> {};

TEST_P(Mutated, is_caught) {
  const Mutant& mutant = mutants()[static_cast<std::size_t>(GetParam())];
  const DesignedScene* scene = find_scene(mutant.scene);
  ASSERT_NE(scene, nullptr);
  set_active_mutant(GetParam());
  const char* table = std::getenv("RL_MUTANT_TABLE");
  const SceneVerdict verdict =
      judged(*scene, table == nullptr ? Thoroughness::first_violation : Thoroughness::every_pixel);
  set_active_mutant(no_mutant);
  if (table != nullptr) append_row(table, mutant, verdict);
  EXPECT_GT(verdict.violations, 0U)
      << mutant.breaks << ": not seen in " << verdict.pixels << " pixels of '" << mutant.scene
      << "', " << verdict.removed << " frames refused, bound at most " << verdict.largest_bound_px
      << " px, error at most " << verdict.largest_of_bound << " of it";
}

INSTANTIATE_TEST_SUITE_P(Shaders, Mutated, testing::ValuesIn(range_of(0, shader_mutants().size())),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Terrain, Mutated,
                         testing::ValuesIn(range_of(shader_mutants().size(),
                                                    terrain_mutants().size())),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Frame, Mutated,
                         testing::ValuesIn(range_of(shader_mutants().size() +
                                                        terrain_mutants().size(),
                                                    frame_mutants().size())),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Shared, Mutated,
                         testing::ValuesIn(range_of(shader_mutants().size() +
                                                        terrain_mutants().size() +
                                                        frame_mutants().size(),
                                                    shared_mutants().size())),
                         name_of);

class Harmless : public testing::TestWithParam<int> {};

TEST_P(Harmless, is_sound_where_it_should_show) {
  const Mutant& mutant = mutants()[static_cast<std::size_t>(GetParam())];
  set_active_mutant(GetParam());
  const SceneVerdict verdict = judged(*find_scene(mutant.scene), Thoroughness::every_pixel);
  set_active_mutant(no_mutant);
  EXPECT_GT(verdict.pixels, 0U);
  EXPECT_EQ(verdict.violations, 0U) << verdict.first;
}

INSTANTIATE_TEST_SUITE_P(Frame, Harmless,
                         testing::ValuesIn(range_of(mutants().size() - harmless_mutants().size(),
                                                    harmless_mutants().size())),
                         name_of);

/// What harmless_mutants.cpp says of the swell. Cubic in the range, so the longest counts.
TEST(HarmlessReasons, swell_is_less_than_1_7e_6_rad) {
  double largest_m = 0;
  for (double latitude_deg = -80; latitude_deg <= 80; latitude_deg += 0.5) {
    const auto local = local_frame({latitude_deg, 0, 0});
    ASSERT_TRUE(local);
    const auto map = ground_map(local.value(), limits::max_range_m);
    if (!map) continue;  // too near a pole for this chart
    for (const double swell_m : map.value().swell_m) {
      largest_m = std::max(largest_m, std::abs(swell_m));
    }
  }
  EXPECT_LT(largest_m, 1.67e-6 * limits::max_range_m);
  EXPECT_GT(largest_m, 1.6e-6 * limits::max_range_m);
}

/// What harmless_mutants.cpp says of way_turned. Of the pairs the one along the vertical is used,
/// so its turns go to 45 degrees on either side; the other one is its mirror image.
TEST(HarmlessReasons, a_block_turned_by_a_right_angle_bears_no_more) {
  double most = 0;
  for (const BlockShape shape : {BlockShape{8, 8}, BlockShape{6, 6}, BlockShape{4, 4},
                                 BlockShape{3, 3}, BlockShape{2, 2}, BlockShape{1, 2}}) {
    for (const double reach_px : {1.46, 1.71, 2.31, 2.71, 3.71, 4.71, 6.71, 8.71}) {
      if (shape.radius_px() > reach_px - 0.7) continue;
      for (int k = -45; k <= 45; ++k) {
        const double angle = k * std::numbers::pi / 180;
        const glm::dvec2 way(std::sin(angle), std::cos(angle)), across(way.y, -way.x);
        const BlockPair pair{shape, shape, shape.width == shape.height && 32 % shape.width == 0};
        const double upright = steepest_for_block(pair, way, {reach_px});
        const double turned = steepest_for_block(pair, across, {reach_px});
        if (turned > 0) most = std::max(most, turned / std::max(upright, 1e-9));
      }
    }
  }
  EXPECT_LT(most, 1.001);
  EXPECT_GT(most, 0.99);
}

}  // namespace
}  // namespace ridgeline::test
