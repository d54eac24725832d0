#pragma once
#include <cstddef>
#include <string>

#include "tests/mutants/scenes.hpp"

namespace ridgeline::test {

enum class Thoroughness {
  first_violation,  ///< stops where the oracle has found one
  every_pixel,
};

/// What the oracle says of a scene as the active mutant draws it.
struct SceneVerdict {
  std::size_t frames = 0;   ///< drawn and judged
  std::size_t removed = 0;  ///< frames the display refused to draw
  std::size_t pixels = 0, violations = 0, undecided = 0;
  double largest_of_bound = 0;  ///< largest error over its frame's bound
  double largest_bound_px = 0;
  std::string first;  ///< the first violation in words
};

/// Draws the scene with the real session and has the oracle judge the dumps, frame by frame.
[[nodiscard]] SceneVerdict judged(const DesignedScene& scene, Thoroughness thoroughness);

}  // namespace ridgeline::test
