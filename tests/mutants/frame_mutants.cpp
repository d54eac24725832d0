// Breaks of what a frame is made of: bound, budget, range, window, uniforms.
#include "tests/mutants/mutant.hpp"

namespace ridgeline::test {
namespace {

constexpr std::string_view blocks = "core/render/frame_blocks.cpp";
constexpr std::string_view renderer = "core/render/renderer.cpp";
constexpr std::string_view levels = "core/frame/level_error.cpp";
constexpr std::string_view pipeline = "core/frame/frame_pipeline.cpp";
constexpr std::string_view keeper = "core/frame/terrain_keeper.cpp";
constexpr std::string_view ground = "core/frame/ground_below.cpp";
constexpr std::string_view tiles = "core/frame/ray_tiles.cpp";
constexpr std::string_view witness = "core/frame/ray_witness.cpp";
constexpr std::string_view grid = "core/geo/polar_grid.cpp";

constexpr Mutant table[] = {
    // --- the bound ---
    {"scale_of_the_image_centre", blocks, "budget.geometry_px = px_per_rad * budget.geometry_rad;",
     "budget.geometry_px = edge * edge * px_per_rad * budget.geometry_rad;",
     "pixels per radian at the centre of the picture stand for all of it", "crest_corner"},
    {"float_height_zero", blocks, "rounding_unit * largest_m / std::max(distance_m, 1e-3)",
     "0.0 * largest_m", "rounding of stored heights is not counted", "crest_corner"},
    {"rests_forgotten", ground, "rest_unit_m * finest_.rests[k]", "0.0",
     "ground under a low eye is drawn from rounded heights", "low_over_geoid"},
    {"near_ground_not_used", pipeline, "view.near = terrain.near_ground()",
     "view.near = NearGround{}", "ground under a low eye is drawn as any other", "low_over_geoid"},
    {"near_cells_exchanged", ground, "near_cell(column - 1 + k % 3, row - 1 + k / 3)",
     "near_cell(column - 1 + k / 3, row - 1 + k % 3)", "rows and columns round a low eye exchanged",
     "low_over_rough"},
    {"geometry_not_counted", pipeline, "std::max(settings.error_px, budget.smallest_px())",
     "settings.error_px", "the wanted bound is promised whatever the frame needs", "levels_crest"},
    {"never_incomplete", pipeline,
     "if (!stays_complete(report.camera, bound_px, levels, budget.geometry_rad)) continue;", "",
     "completeness is taken for granted", "levels_notched"},
    {"scale_of_levels_at_the_centre", levels, "part.turn_rad(limits, 0.0) * px_per_rad",
     "part.turn_rad(limits, 0.0) * camera.fx",
     "what levels cost is taken at the scale of the image centre", "levels_corner"},
    {"levels_cost_nothing", pipeline,
     "error_budget(report.camera, map.value(), levels.angle_px, levels.steepest, rounding)",
     "error_budget(report.camera, map.value(), 0.0, levels.steepest, rounding)",
     "coarse levels are drawn for nothing", "levels_crest"},
    {"distance_to_the_far_side", levels, "std::max(over_ground_m, least_m)",
     "std::max(over_ground_m, least_m) + 12'000.0",
     "coarse ground counts as 12 km farther away than it is", "levels"},
    {"parts_partly_drawn_ignored", levels, "if (level > 0 && place.inside(finer)) continue;",
     "if (level > 0 && place.rect.west < finer.east && place.rect.east > finer.west && "
     "place.rect.south < finer.north && place.rect.north > finer.south) continue;",
     "blocks that a finer level covers in part cost nothing", "levels_border"},
    {"nothing_out_of_sight", levels, "return at.seen && !block.facts.mixed;", "return false;",
     "no block is ever in view", "levels"},
    {"turn_without_slant", levels,
     "turn.angle_rad[k] = std::max(level_rad, (level_rad - let_go) / grip);",
     "turn.angle_rad[k] = level_rad + 0.0 * let_go;",
     "coarse ground seen from above costs no more than ground seen along it", "levels_slanted"},
    {"grip_without_slope", levels, "cosine - ground.steepness * sine", "cosine",
     "a turn of the ray wins as much on steep ground as on level", "levels_steep"},
    {"range_not_cut", levels,
     "error.clear_range_m = std::min(error.clear_range_m, chord_share * reach.away_m);", "",
     "the range does not end before blocks that must not be drawn", "levels_voids"},

    // --- shared rays ---
    {"rays_shared_on_any_slope", tiles, "of_tile = std::max(of_tile, steepness);",
     "of_tile = std::max(of_tile, std::min(steepness, 0.05F));",
     "ground counts as gentle whatever it is", "shared_blades"},
    {"rays_in_larger_blocks", tiles, "steepness / grip * look.stretch + look.skew",
     "0.05 * steepness / grip * look.stretch", "blocks are good for ground twenty times as steep",
     "shared_blades"},
    {"rays_shared_beside_voids", tiles, "unknown || facts.part_residual_m[k] > 0",
     "facts.part_residual_m[k] > 0", "unknown ground is as good as known ground of its slope",
     "shared_roads"},
    {"slack_tripled", tiles, "shapes[largest_].radius_px() > sharing_.slack_px",
     "shapes[largest_].radius_px() > 3 * sharing_.slack_px",
     "a ray may be three times as far from its pixels as the bound allows", "shared_diagonal"},
    {"reach_and_4_px", tiles, "std::min(sharing_.bound_px + neighbour_px, farthest_witness_px)",
     "std::min(sharing_.bound_px + neighbour_px + 4, farthest_witness_px)",
     "witnesses farther than completeness allows", "shared_combs"},
    {"way_of_a_level_picture", tiles, "std::atan2(upright.way.y, upright.way.x)",
     "0.5 * std::numbers::pi", "blocks bear what they would bear without roll",
     "shared_combs_rolled"},
    {"grip_ignored", tiles, "std::cos(look.down_rad) - steepness * std::sin(look.down_rad)", "1.0",
     "ground seen from above is as good as ground seen along it", "shared_from_above"},
    {"blocks_in_step_across_tiles", witness,
     "value(sign * glm::dot(step, way) - other_up, off_axis(step) + other_beside)", "any",
     "blocks of the tile beside stand where those of this tile would", "shared_combs_across"},
    {"residual_shared", tiles, "facts.part_residual_m[k] > 0", "false",
     "ground drawn with a residual is as good as exact ground", "shared_levels"},

    // --- uniforms ---
    {"radii_exchanged", blocks,
     "b.earth = {f(map.inverse_meridian_radius), f(map.inverse_prime_vertical_radius), 0.0f, "
     "high};",
     "b.earth = {f(map.inverse_prime_vertical_radius), f(map.inverse_meridian_radius), 0.0f, "
     "high};",
     "meridian and prime vertical exchanged", "mesa"},
    {"rays_of_pixel_corners", blocks, "camera.ray(0.5, 0.5)", "camera.ray(0.0, 0.0)",
     "rays through the corners of pixels", "near"},
    {"ceiling_too_low", blocks, "f(highest_m)", "f(0.7 * highest_m)",
     "the highest post of the window is not the highest", "near"},
    {"steps_without_limit", blocks, "return std::sqrt(2.0 * slip_posts / std::max(bend, 1e-12));",
     "return 1e9;", "steps longer than the straight exit allows", "bent"},
    {"wedges_too_wide", blocks, "std::min(east_m, 0.99 * north_m) / (0.5 * widest_rad)",
     "std::min(east_m, 0.99 * north_m) / (0.1 * widest_rad)",
     "wedges may be five times as wide as nodes overlap", "spires"},
    {"planes_half_a_plane_off", blocks, "grid.plane_azimuth_rad(i)",
     "grid.plane_azimuth_rad(i) + 0.5 * grid.azimuth_span_rad / grid.plane_count",
     "planes stand between the wedges they speak for", "spires_limit"},
    {"rows_one_too_steep", blocks, "slopes[j] = f(grid.row_slope(j));",
     "slopes[j] = f(grid.row_slope(j + 1));", "rows are swept at the slope of the row above",
     "near"},
    {"rows_left_out", grid, "static_cast<int>(std::floor(grid.row_of_slope(low))) - 1",
     "static_cast<int>(std::floor(grid.row_of_slope(low))) + 20",
     "the lowest rows of a plane are left as another frame wrote them", "half"},
    {"latitude_in_columns", blocks, "f(map.north_deg[k] / view.lattice.latitude_step_deg)",
     "f(map.north_deg[k] / view.lattice.longitude_step_deg)", "rows as wide as columns", "far"},
    {"drawable_a_post_wide", blocks, "rect.north - row", "rect.north - row + 4 * block_posts",
     "levels are drawn beyond what they hold", "levels_smooth"},

    // --- window ---
    {"maxima_not_edited", renderer, "k <= block_levels",
     "k <= (block.edits > 0 ? 0 : block_levels)",
     "an edit changes the posts but not the highest heights above them", "edits"},
    {"pyramid_of_a_block_elsewhere", renderer, "corner.y + slot.row * side",
     "corner.y + slot.column * side", "the nodes of a block go to the place of another", "near"},
    {"edits_reach_no_block", keeper, "if (!touches(region, held.id)) return;", "return;",
     "an edit does not change the blocks held", "edits"},
    {"blocks_of_before_the_edit", keeper, "block->edits < edits_", "false",
     "blocks built before an edit are taken after it", "edits_arriving"},
    {"range_beyond_the_window", keeper, "if (inside) return range;", "return range;",
     "the range ends where it was wished, not where the window does", "dash"},
    {"clearance_for_granted", ground, "std::min(nine.distance_m, others.distance_m)", "1e4",
     "the eye is always far from the ground", "low_over_geoid"},
};

}  // namespace

std::span<const Mutant> frame_mutants() {
  return table;
}

}  // namespace ridgeline::test
