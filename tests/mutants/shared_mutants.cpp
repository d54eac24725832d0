// Breaks of what lets one ray stand for several pixels, or for a tile of plain sky.
#include "tests/mutants/mutant.hpp"

namespace ridgeline::test {
namespace {

constexpr std::string_view plan = "core/frame/ray_tiles.cpp";
constexpr std::string_view witness = "core/frame/ray_witness.cpp";
constexpr std::string_view look = "core/frame/tile_look.cpp";
constexpr std::string_view ground = "core/frame/steep_ground.cpp";
constexpr std::string_view list = "core/render/tile_list.cpp";
constexpr std::string_view ray_of_block = "shaders/tile_frag.glsl";

constexpr Mutant table[] = {
    // --- how large a block may be ---
    {"rays_in_larger_blocks", look, "across * look.stretch + look.skew",
     "0.05 * across * look.stretch", "blocks are good for ground twenty times as steep",
     "shared_blades"},
    {"slack_tripled", plan, "shapes[largest_].radius_px() > sharing_.slack_px",
     "shapes[largest_].radius_px() > 3 * sharing_.slack_px",
     "a ray may be three times as far from its pixels as the bound allows", "shared_diagonal"},
    {"reach_and_4_px", plan, "std::min(sharing.bound_px + neighbour_px, farthest_witness_px)",
     "std::min(sharing.bound_px + neighbour_px + 4, farthest_witness_px)",
     "witnesses farther than completeness allows", "shared_combs"},
    {"way_of_a_level_picture", look, "std::atan2(upright.way.y, upright.way.x)",
     "0.5 * std::numbers::pi", "blocks bear what they would bear without roll",
     "shared_combs_rolled"},
    {"grip_ignored", look, "std::max(look.down_rad, 0.0)", "0.0",
     "ground seen from above is as good as ground seen along it", "shared_from_above"},
    {"ground_not_nearer_below", look, "std::sin(down_rad)", "0.0",
     "ground under the lower of two points of rays is not nearer", "shared_from_above"},
    {"blocks_in_step_across_tiles", witness, "if (blocks.one_lattice) return same;", "return same;",
     "blocks of the tile beside stand where those of this tile would", "shared_combs_across"},
    {"one_lattice_of_any_shape", plan, "square && ray_tile_px % block.width == 0", "true",
     "blocks go on in step in the next tile though they do not divide it", "shared_combs_across"},
    {"ray_at_the_corner_of_its_block", ray_of_block, "+ 0.5) * block - 0.5", ") * block",
     "a block shows what its first pixel sees", "shared_diagonal"},

    // --- what ground a tile has ---
    {"rays_shared_on_any_slope", ground, "of_tile = std::max(of_tile, steepness);",
     "of_tile = std::max(of_tile, std::min(steepness, 0.05F));",
     "ground counts as gentle whatever it is", "shared_blades"},
    {"rays_shared_beside_voids", ground, "facts.void_posts > 0 || facts.mixed", "facts.mixed",
     "unknown ground is as good as known ground of its slope", "shared_roads"},
    {"residual_shared", ground, "facts.part_residual_m[static_cast<std::size_t>(part)] > 0",
     "false", "ground drawn with a residual is as good as exact ground", "shared_levels"},
    {"heights_of_parts_ignored", ground, "0.5 * (heights.low_m + heights.high_m) - place.middle_m",
     "0.0", "every part stands in the middle of its block's heights", "sky_towers"},
    {"northern_parts_forgotten", ground, "row < ground_parts", "row < ground_parts - joined",
     "the northernmost parts of a block are not looked at", "sky_towers"},
    {"gentle_blocks_not_marked", ground,
     "mark(tiles_of(box_of(place, 0, 0, 1, 0.0, heights_of(facts))), 0.0F);", "",
     "flat ground is no ground", "shared_diagonal"},
    {"unknown_blocks_not_marked", ground, "if (uncertain) mark_uncertain(block, place, unknown);",
     "", "unknown ground is no ground", "shared_roads"},
    {"ground_behind_not_cut", ground, "behind = behind || corners[k].z < least_depth_m;", "",
     "of ground that is partly behind the eye only the corners before it count", "shared_diagonal"},
    {"small_tile_is_sky", plan, "(steepness[k] == no_ground)",
     "(steepness[k] == no_ground || tiles[k].block == tiles[k].size)",
     "ground in a tile as small as its block is sky", "sky_small_tile"},
    {"records_a_row_short", list, "first / shader::tile_list_width", "0",
     "records of tiles beyond the first row of the list replace those of the first",
     "sky_many_tiles"},
};

}  // namespace

std::span<const Mutant> shared_mutants() {
  return table;
}

}  // namespace ridgeline::test
