#pragma once
#include <span>

#include "core/terrain/height_tile.hpp"
#include "core/terrain/tile_location.hpp"

namespace ridgeline {

/// Whoever holds the raw tiles; implemented by platform/ on mapped files.
class TerrainPort {
 public:
  virtual ~TerrainPort() = default;
  /// The tiles that overlap a box, in a fixed order. The views stay valid until the next call.
  virtual std::span<const HeightTile> select(const GeoBox& box) = 0;
  /// Files refused so far because they are corrupt; their area is unknown.
  [[nodiscard]] virtual int refused_count() const = 0;
};

}  // namespace ridgeline
