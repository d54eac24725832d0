#pragma once

#include "core/terrain/terrain_block.hpp"
#include "core/terrain/tile_location.hpp"

namespace ridgeline {

/// One block that is wanted, with the first so many edits in it, on the session's lattice in a
/// chart.
struct BlockOrder {
  BlockId id;
  int edits = 0;
  Chart chart = Chart::geographic;
};

/// Whoever reads raw tiles and builds blocks from them; implemented by platform/ on a thread of its
/// own. Blocks come back in the order in which they were ordered.
class BlockPort {
 public:
  virtual ~BlockPort() = default;
  /// Orders that fit in now. Ends a round of take().
  [[nodiscard]] virtual int room() = 0;
  /// Orders one block. Domain: room() > 0.
  virtual void order(const BlockOrder& order) = 0;
  /// The next finished block, or null. A port for deterministic runs waits for every block ordered
  /// so far, so that what a frame sees depends on frame numbers alone; one for live use never
  /// waits. Owner: valid until the next call of take().
  virtual const TerrainBlock* take() = 0;
  /// The box that blocks will be ordered from; tiles outside it may be let go.
  virtual void focus(const GeoBox& box) = 0;
  /// Builds one block at once; for changes of the terrain, which the very next frame must show.
  virtual const TerrainBlock* build(const BlockOrder& order) = 0;
  /// Files refused so far because they are corrupt; their area is unknown.
  [[nodiscard]] virtual int refused_count() const = 0;
};

}  // namespace ridgeline
