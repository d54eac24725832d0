#pragma once
#include <vector>

#include "sim/attack/attack_case.hpp"

namespace ridgeline::sim {

/// Heights of all posts of one tile of a case, as its file stores them: whole metres but for tif32.
/// Shape:  rows x columns, from the south and west. Units: m; NaN = void.
/// Error:  only + - * / and floor, so the same bits on every machine with IEEE-754 doubles.
[[nodiscard]] std::vector<float> posts_of(const AttackCase& attack_case, std::size_t tile);

/// The posts of every tile of a case, kept.
class CaseLand {
 public:
  explicit CaseLand(const AttackCase& attack_case);

  [[nodiscard]] const std::vector<PostGrid>& grids() const { return grids_; }
  [[nodiscard]] const std::vector<float>& posts(std::size_t tile) const { return posts_[tile]; }
  [[nodiscard]] float post_m(std::size_t tile, int row, int column) const;
  /// The highest bilinear surface there of any tile; NaN over unknown ground. Units: degrees, m.
  [[nodiscard]] double ground_m(double latitude_deg, double longitude_deg) const;
  /// The highest known post of one tile within so many posts of a place in posts; NaN without one.
  [[nodiscard]] double highest_near_m(std::size_t tile, double row, double column, int posts) const;

 private:
  std::vector<PostGrid> grids_;
  std::vector<std::vector<float>> posts_;
};

}  // namespace ridgeline::sim
