// Breaks of what is made of the tiles: posts, seams, floors, blocks, levels; and of the geodesy.
#include "tests/mutants/mutant.hpp"

namespace ridgeline::test {
namespace {

constexpr std::string_view block = "core/terrain/terrain_block.cpp";
constexpr std::string_view levels = "core/terrain/terrain_levels.cpp";
constexpr std::string_view shared = "core/terrain/shared_posts.cpp";
constexpr std::string_view region = "core/terrain/post_region.cpp";
constexpr std::string_view floors = "core/terrain/void_floor.cpp";
constexpr std::string_view lattice = "core/terrain/post_lattice.cpp";
constexpr std::string_view polar = "core/terrain/polar_region.cpp";
constexpr std::string_view edits = "core/terrain/terrain_edit.cpp";
constexpr std::string_view map = "core/geo/ground_map.cpp";
constexpr std::string_view chart = "core/geo/chart.cpp";
constexpr std::string_view frame = "core/geo/local_frame.cpp";
constexpr std::string_view camera = "core/geo/camera.cpp";

constexpr Mutant table[] = {
    // --- pyramid of highest heights ---
    {"nodes_without_overlap", block, R"(for (int y = y0 - 1; y <= y0 + 3; ++y) {
        for (int x = x0 - 1; x <= x0 + 3; ++x) highest = std::max(highest, top_of(post(x, y)));
      })",
     R"(for (int y = y0; y <= y0 + 2; ++y) {
        for (int x = x0; x <= x0 + 2; ++x) highest = std::max(highest, top_of(post(x, y)));
      })",
     "nodes hold no more than their own cells: nothing for the wedge", "spires"},
    {"node_lacks_a_row", block, "y <= y0 + 3", "y <= y0 + 1",
     "the smallest nodes lack the row of posts they share with the next", "near"},
    {"node_lacks_a_column", block, "x <= x0 + 3", "x <= x0 + 1",
     "the smallest nodes lack the column they share with the next", "near"},
    {"parent_of_three", block, "node(2 * i + 1, 2 * j + 1)", "node(2 * i, 2 * j)",
     "a node of the pyramid forgets one of its four parts", "near"},
    {"coarse_nodes_without_truth", block, "level_ > 0 && y < y0 + 4", "false && y < y0 + 4",
     "nodes of coarse levels bound their own posts only", "levels_spires"},
    {"nodes_without_floors", block, "highest = std::max(highest, top_of(post(x, y)));",
     "highest = std::max(highest, is_void(post(x, y)) ? nothing : post(x, y));",
     "nodes do not know of unknown ground", "unknown"},

    // --- residual of coarse levels ---
    {"residual_half", block, "residual = std::max(residual, std::abs(gap));",
     "residual = std::max(residual, 0.5F * std::abs(gap));", "half of the residual",
     "levels_crest"},
    {"residual_zero", block, "residual = std::max(residual, std::abs(gap));",
     "static_cast<void>(gap);", "coarse levels count as exact", "levels_crest"},
    {"residual_one_sided", block, "residual = std::max(residual, std::abs(gap));",
     "residual = std::max(residual, -gap);", "only what stands too high counts", "levels_needle"},
    {"residual_of_another_part", block,
     "(cy - margin) / side * residual_parts + (cx - margin) / side",
     "(cx - margin) / side * residual_parts + (cy - margin) / side",
     "the residual is booked to another part of the block", "levels"},
    {"posts_not_settled", block, "post(x + margin, y + margin)",
     "at((x + margin) * step_, (y + margin) * step_)",
     "the posts drawn are not those the residual was measured for", "levels"},
    {"mixed_blocks_drawn", block,
     "if (known != drawn || (!known && some_cell_known(cx, cy))) facts.mixed = true;", "",
     "a void smaller than a coarse cell is drawn over", "levels_voids"},
    {"ball_of_no_size", block, "facts.radius_m = between_samples * radius + 20.0;",
     "facts.radius_m = 20.0;", "a block is where its middle is", "levels_narrow"},
    {"polar_gap_ignored", block,
     "facts.part_residual_m[static_cast<std::size_t>(part)] += gap.gap_m;", "",
     "the posts of a polar chart count as the truth", "polar_rough"},
    {"polar_mixed_ignored", block, "facts.mixed = facts.mixed || gap.mixed;", "",
     "cells of a polar chart that are known in part are drawn", "polar_gap"},

    // --- what the levels hold ---
    {"stale_blocks", levels, "return block.held && block.id == id ? &block : nullptr;",
     "return block.held ? &block : nullptr;", "a block of another place counts as the wanted one",
     "jump"},
    {"level_to_its_last_post", levels, "edge_posts << l", "0 * edge_posts << l",
     "a level is drawn up to the posts it does not have", "levels_smooth"},

    // --- posts that tiles share, seams ---
    {"lower_of_two_posts", shared, "return std::max(a, b);", "return std::min(a, b);",
     "where two tiles disagree the lower post is drawn", "seam"},
    {"seam_of_steps_ignored", region, "facts.seam_m = std::max(facts.seam_m, merge.apart_m);", "",
     "tiles of different steps count as agreeing along their edge", "steps"},
    {"geoid_dropped", region, "(rest + more_m)", "(rest + 0.0 * more_m)",
     "heights count from mean sea level", "geoid"},
    {"longitude_not_wrapped", lattice,
     "return column + circle * std::round((near_column - column) / circle);", "return column;",
     "no terrain on the other side of the antimeridian", "antimeridian"},

    // --- floors of unknown ground ---
    {"floor_too_high", floors,
     "post = (floor > none_known ? floor : outer) + slack - void_offset_m;",
     "post = 9500.0F - void_offset_m;", "unknown ground is drawn higher than it may be",
     "unknown_high"},
    {"floor_of_mean_sea_level", floors,
     "post = (floor > none_known ? floor : outer) + slack - void_offset_m;",
     "post = 0.0F - void_offset_m;", "unknown ground is drawn up to 0 m", "unknown"},

    // --- edits ---
    {"edits_ignored", edits, "if (at >= 0) apply_edit(edit, tile, at, column, posts);", "",
     "edits change nothing", "edits"},

    // --- geodesy ---
    {"roll_the_other_way", camera, "std::cos(phi) * level_right + std::sin(phi) * level_down",
     "std::cos(phi) * level_right - std::sin(phi) * level_down",
     "the picture is sheared by its roll", "near"},
    {"pitch_the_other_way", camera, "attitude.pitch_deg * deg", "-attitude.pitch_deg * deg",
     "nose down shows the sky", "near"},
    {"heading_off", camera, "attitude.heading_deg * deg", "(attitude.heading_deg + 0.001) * deg",
     "heading off by a thousandth of a degree", "near"},
    {"map_error_dropped", map, "map.error_rad = map_margin * worst;",
     "map.error_rad = 0.0 * worst;", "what the ground map leaves out is not counted",
     "gentle_pole"},
    {"polar_turn_to_the_wrong_side", chart,
     "chart == Chart::north_polar ? std::sin(angle) : -std::sin(angle)",
     "chart == Chart::north_polar ? -std::sin(angle) : std::sin(angle)",
     "the polar chart is turned the wrong way", "polar"},
};

}  // namespace

std::span<const Mutant> terrain_mutants() {
  return table;
}

}  // namespace ridgeline::test
