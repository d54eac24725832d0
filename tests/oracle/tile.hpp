#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "tests/oracle/grid.hpp"
#include "tests/oracle/sheet.hpp"

namespace ridgeline::oracle {

inline constexpr float void_post = std::numeric_limits<float>::quiet_NaN();

/// Heights of posts, exactly as they were set; NaN = void. Whole metres take two bytes a post, as
/// in the files; the first height of another kind turns all of them into floats.
class Posts {
 public:
  [[nodiscard]] std::size_t size() const { return is_whole_ ? whole_.size() : real_.size(); }
  [[nodiscard]] float operator[](std::size_t index) const {
    if (!is_whole_) return real_[index];
    const std::int16_t height_m = whole_[index];
    return height_m == void_mark ? void_post : static_cast<float>(height_m);
  }
  void set(std::size_t index, float height_m) {
    if (is_whole_ && !has_mark(height_m)) become_real();
    if (is_whole_) {
      whole_[index] = mark(height_m);
    } else {
      real_[index] = height_m;
    }
  }
  void push_back(float height_m) {
    resize(size() + 1);
    set(size() - 1, height_m);
  }
  /// New posts are void.
  void resize(std::size_t count) {
    if (is_whole_) {
      whole_.resize(count, void_mark);
    } else {
      real_.resize(count, void_post);
    }
  }

 private:
  static constexpr std::int16_t void_mark = std::numeric_limits<std::int16_t>::min();

  static bool has_mark(float height_m) {
    return std::isnan(height_m) ||
           (std::abs(height_m) <= 32767 && std::trunc(height_m) == height_m);
  }
  static std::int16_t mark(float height_m) {
    return std::isnan(height_m) ? void_mark : static_cast<std::int16_t>(height_m);
  }
  void become_real() {
    std::vector<float> heights(whole_.size());
    for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = (*this)[i];
    real_ = std::move(heights);
    whole_ = {};
    is_whole_ = false;
  }

  bool is_whole_ = true;
  std::vector<std::int16_t> whole_;
  std::vector<float> real_;
};

/// Heights that no ground or sea bed of the Earth has are marks of one kind or another: such a post
/// is void, in every format. Units: m (docs/adr/0014).
inline constexpr double lowest_ground_m = -12000;
inline constexpr double highest_ground_m = 9000;
[[nodiscard]] inline float known_or_void(double height_m) {
  const bool known = height_m >= lowest_ground_m && height_m <= highest_ground_m;
  return known ? static_cast<float>(height_m) : void_post;
}

/// One tile as the file has it, or a cell of stated sea. Posts are points.
/// Units: m above the file's vertical datum.
struct Tile : Grid {
  std::string name;                 ///< file name, for messages
  Posts posts;                      ///< rows x columns, row-major from the south; none at sea
  std::optional<Sheet<float>> sea;  ///< the posts of stated sea: 0 inside but where edits set them

  [[nodiscard]] std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
  [[nodiscard]] float at(int row, int column) const {
    return sea ? sea->at(row, column) : posts[index(row, column)];
  }
  void set(int row, int column, float height_m) {
    if (sea) {
      sea->set(row, column, height_m);
    } else {
      posts.set(index(row, column), height_m);
    }
  }
};

}  // namespace ridgeline::oracle
