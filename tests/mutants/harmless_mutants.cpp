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
      {{"sweep_without_swell", "shaders/sweep.comp",
        "(abs(tolerance.y) + abs(tolerance.w)) * u * u * u * 1.2;", "0.0;",
        "the grid does not allow for the swell", "long_view"},
       "A node is passed only if it stays under the ray but for the swell: what a pixel then "
       "misses "
       "it meets by less than 1.66e-6 rad. The rest as for ray_without_swell."},
  };
  return all;
}

}  // namespace ridgeline::test
