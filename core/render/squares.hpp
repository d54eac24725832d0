#pragma once
#include <algorithm>

namespace ridgeline {

/// Cuts a rectangle into squares without overlap, as Euclid's algorithm measures it: as many of its
/// shorter side as there is room for, then the rest likewise. put(x, y, side) for each, in order.
template <typename Put>
constexpr void cut_into_squares(int width, int height, Put put) {
  int x = 0, y = 0;
  while (width > 0 && height > 0) {
    const int side = std::min(width, height);
    put(x, y, side);
    const bool wide = width > height;
    (wide ? x : y) += side;
    (wide ? width : height) -= side;
  }
}

}  // namespace ridgeline
