// Breaks that no frame can show, and why: what they take away is covered by what stays.
#include "tests/mutants/mutant.hpp"

namespace ridgeline::test {

const std::vector<HarmlessMutant>& harmless_mutants() {
  static const std::vector<HarmlessMutant> all = {
      {{"cell_without_bend", "shaders/ray_cast.frag",
        "float bend = 0.5 * r.along * r.along * r.inverse_radius;", "float bend = 0.0;",
        "no curvature inside a cell", "saddles"},
       "A hit counts only within x = A / 2 + sqrt(A t) of the point t where the ray was computed, "
       "A "
       "= 2e-6 / k, k >= 1 / R. The term is at most x x / 2R <= k x x / 2 = 1e-6 (t + sqrt(A t) + "
       "A "
       "/ 4) <= 1e-6 (t + x): an angle of 1e-6 rad. The rows of docs/error_bound.md, section 4, "
       "sum "
       "to 3.0e-6 + 0.75e-6 S; with 1e-6 more that is 4.07e-6 sqrt(1 + S S) at most, and 5.5e-6 "
       "sqrt(1 + S S) is counted."},
      {{"polar_turn_without_slant", "core/frame/level_error.cpp", "grip >= least_grip",
        "grip > -1e9", "turns that win hardly any height count, or none", "levels_steep"},
       "Where 0 < grip < 0.05, rule (1) of docs/error_bound.md, section 5, holds as it stands: it "
       "asks only for a positive grip, and the slope in it is rounded up. Where grip <= 0, nothing "
       "reads the turn: `possible`, `turn_rad` and `stays_complete` each ask for grip > 0, and the "
       "smallest of several grips is then no more than 0 as before. The limit keeps the bound from "
       "growing without end; it is no part of the proof."},
      {{"ray_without_swell", "shaders/ray_cast.frag",
        "q.h.z -= a * aa * z.y * (tolerance.y * z.y * z.y + tolerance.w * z.x * z.x);", "",
        "the ellipsoid does not swell away from its circle", "long_view"},
       "The swell grows with the cube of the distance and is largest at 45 degrees: 0.332 m at 200 "
       "km, an angle of 1.66e-6 rad, less anywhere nearer. With it the rows of section 4 sum to "
       "4.66e-6 + 0.75e-6 S, which is 4.72e-6 sqrt(1 + S S) at most (test "
       "HarmlessReasons.swell_is_less_than_1_7e_6_rad)."},
      {{"sweep_without_swell", "shaders/sweep.comp", "swell * u * u * u * 1.2;", "0.0;",
        "the grid does not allow for the swell", "long_view"},
       "A node is passed only if it stays under the ray but for the swell: what a pixel then "
       "misses "
       "it meets by less than 1.66e-6 rad. The rest as for ray_without_swell."},
      {{"way_turned", "core/frame/tile_look.cpp", "std::atan2(upright.way.y, upright.way.x)",
        "std::atan2(upright.way.x, -upright.way.y)",
        "blocks are asked what they bear at a right angle to the vertical", "shared_combs_rolled"},
       "A square block, its lattice and the pixels within reach are the same turned by a right "
       "angle, so it bears the same. The pair that is used lies within 45 degrees of the vertical; "
       "turned it is one that lies across, which bears less (test "
       "HarmlessReasons.a_block_turned_by_a_right_angle_bears_no_more, without loss; with it a "
       "turned pair may bear up to a fifth more than an upright one, but never more than an "
       "upright "
       "one without loss, and that is enough: loss_zero)."},
      {{"loss_zero", "core/frame/ray_tiles.cpp",
        "std::ceil(sharing.geometry_px / loss_step_px) * loss_step_px", "0.0",
        "what rounding moves is not counted between a pixel and its witness", "shared_combs"},
       "What a witness c shows is the truth at some c' within geometry_px of c. Take p' = p + (c' "
       "- "
       "c), within geometry_px of p. The lemma of docs/error_bound.md, section 8, holds between p' "
       "and c', which lie as p and c do, without any loss: z(c) = Z(c') <= Z(p') or >= Z(p'). That "
       "is completeness as docs/adr/0014 promises it."},
      {{"ring_of_one_pixel", "core/frame/ray_tiles.cpp", "static_cast<int>(reach_px) + 1", "1",
        "pixels near the edge of the picture share rays as any others", "shared_combs_rolled"},
       "Pixels beyond the edge count as drawn exactly (docs/adr/0014), so to a tile at the edge "
       "the "
       "outside is a tile in which every pixel has its own ray; and what a block finds beside a "
       "block of its own shape it finds beside single pixels (docs/error_bound.md, section 8)."},
  };
  return all;
}

}  // namespace ridgeline::test
