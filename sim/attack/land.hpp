#pragma once
#include <vector>

#include "sim/attack/attack_case.hpp"

namespace ridgeline::sim {

/// Heights of all posts of one tile of a case, as its file stores them: whole metres but for tif32.
/// Shape:  rows x columns, from the south and west. Units: m; NaN = void.
/// Error:  only + - * / and floor, so the same bits on every machine with IEEE-754 doubles.
[[nodiscard]] std::vector<float> posts_of(const AttackCase& attack_case, std::size_t tile);

/// The ground of a case at any place, worked out where it is asked for.
class CaseLand {
 public:
  /// The land of the place, the layers and the tiles of a case; a copy, whatever happens to it.
  explicit CaseLand(const AttackCase& attack_case);

  [[nodiscard]] const std::vector<PostGrid>& grids() const { return grids_; }
  /// The post nearest to a row and column that may lie outside the tile.
  [[nodiscard]] float post_m(std::size_t tile, int row, int column) const;
  /// The highest bilinear surface there of any tile; NaN over unknown ground. Units: degrees, m.
  [[nodiscard]] double ground_m(double latitude_deg, double longitude_deg) const;
  /// The highest known post of one tile within so many posts of a place in posts; NaN without one.
  [[nodiscard]] double highest_near_m(std::size_t tile, double row, double column, int posts) const;

 private:
  AttackCase case_;
  std::vector<PostGrid> grids_;
};

}  // namespace ridgeline::sim
