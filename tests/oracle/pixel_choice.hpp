#pragma once
#include <cstdint>
#include <vector>

#include "tests/oracle/camera.hpp"
#include "tests/oracle/dump.hpp"

namespace ridgeline::oracle {

/// A pixel to judge, and a second point in it.
struct ChosenPixel {
  int u = 0;
  int v = 0;
  ImagePoint offset;  ///< from the centre, each coordinate in [-1/2, 1/2)
};

/// Chooses pixels of a frame without repetition: half of them where the 3 x 3 pixels round them
/// differ by more than 10 % or in class (fewer if there are not so many), the rest anywhere.
/// The choice depends on the frame's distances, its name, `count` and `seed` only.
[[nodiscard]] std::vector<ChosenPixel> chosen_pixels(const Frame& frame, int count,
                                                     std::uint64_t seed);

}  // namespace ridgeline::oracle
