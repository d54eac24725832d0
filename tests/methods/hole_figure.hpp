#pragma once
#include <string>

#include "tests/gl/scene.hpp"
#include "tests/methods/method_judge.hpp"

namespace ridgeline::test {

/// A scene that shows one hole in a published guarantee.
struct Hole {
  std::string file;  ///< of the picture, without folder
  std::string what;  ///< one line for the table
  sim::HeightFunction height_m;
  std::vector<std::pair<int, int>> tiles;  ///< south and west, degrees
  Pose pose;
  ImageGeometry image;
  double range_m = 0;
  std::string settings;  ///< of loffler
  double claim_px = 1;   ///< its gamma
  PixelSet crop;         ///< what is shown and judged
  int zoom = 1;
};

/// What a figure says in numbers.
struct HoleNumbers {
  int judged = 0, unsound = 0, incomplete = 0;
  int wrong = 0;         ///< one of the two
  int wrong_uncast = 0;  ///< of those, where the error buffer is empty
  int lost = 0;          ///< sky where ours shows ground
  double cast_percent = 0;
  double max_px = 0;         ///< real error
  bool max_is_more = false;  ///< the search ended there
  int ours_wrong = 0;        ///< of the module's own picture, against the same claim
};

/// Every hole of docs/evidence/published_holes.md that has a picture.
std::vector<Hole> published_holes();

/// Draws a hole with `loffler` and with the module's own passes, has the oracle judge every pixel
/// of the crop, and writes one PNG of three panels, from the top: loffler, ours, and the verdict
/// (red: further wrong than claimed; yellow: not wrong itself, but what stands there is shown
/// nowhere near; blue: the error buffer asked for a ray; grey: ours, darkened). Outcome: of writing
/// the file.
sim::Outcome draw_hole(const Hole& hole, const std::string& folder, HoleNumbers& numbers);

}  // namespace ridgeline::test
