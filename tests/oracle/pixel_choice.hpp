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
  ImagePoint offset;        ///< from the centre, each coordinate in [-1/2, 1/2)
  bool is_sampled = false;  ///< measure its error without slack
};

/// Chooses pixels of a frame without repetition: half of them where the 3 x 3 pixels round them
/// differ by more than 10 % or in class (fewer if there are not so many), the rest anywhere. One in
/// `sample_one_in` of them is sampled, none where that is 0. They come in rows from the top,
/// because neighbours meet the same ground. The choice depends on the frame's distances, its name
/// and the arguments only.
[[nodiscard]] std::vector<ChosenPixel> chosen_pixels(const Frame& frame, int count,
                                                     std::uint64_t seed, int sample_one_in);

}  // namespace ridgeline::oracle
