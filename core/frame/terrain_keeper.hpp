#pragma once
#include <limits>
#include <span>

#include "core/geo/local_frame.hpp"
#include "core/render/renderer.hpp"
#include "core/terrain/block_port.hpp"
#include "core/terrain/terrain_levels.hpp"

namespace ridgeline {

/// What the window holds round the eye, added up.
struct WindowSummary {
  double lowest_m = 0, highest_m = 0;  ///< HAE of known posts; highest of floors as well
  std::int64_t known_posts = 0;        ///< of the coarsest level
  std::int64_t void_posts = 0;
  int mismatched_tiles = 0;  ///< tiles whose posts do not lie on the lattice, at most once a block
  int blocks_arrived = 0;    ///< with this frame
  bool complete = false;     ///< every level holds all it should
};

/// How far the eye is from the ground.
struct Clearance {
  enum class Kind : std::uint8_t { above, below, undecided };
  Kind kind = Kind::undecided;  ///< undecided: too little terrain has arrived below the eye
  /// Of the eye over the known surface straight below, NaN where that is unknown.
  double over_m = std::numeric_limits<double>::quiet_NaN();
  double distance_m = 0;  ///< lower bound on the distance to the known surface, at least 1 mm
  /// What is drawn near the eye, the nine cells round it (NearGround) left out where they are drawn
  /// about the eye itself: lower bound on its distance, and the largest of its cells' differences
  /// of heights over their distances.
  double drawn_m = 0, relief_of_distance = 0;
  bool near_ground = false;  ///< those nine cells are
  /// Then, of them: lower bound on the distance, largest difference of heights in one over a post.
  double near_m = 0, near_steepest = 0;
};

/// Copy of the finest level in main memory.
/// Shape: as many as the level has posts; block by block, row-major from the south-west in each.
struct FinestPosts {
  std::span<float> heights_m;
  std::span<std::int8_t> rests;  ///< as TerrainBlock::rests
};

/// Keeps the terrain window round the eye: orders blocks, takes them when they arrive, puts them
/// into the renderer. Never waits for the disk unless its port does. Memory is the caller's, given
/// once at boot.
class TerrainKeeper {
 public:
  /// Shape: held.size() >= sizes.levels * sizes.blocks(). `finest_posts`: for the ground under the
  ///        eye.
  /// `polar_range_m`: display range for which a polar chart takes over near a pole; 0: never.
  TerrainKeeper(BlockPort& port, const PostLattice& lattice, const LevelSizes& sizes,
                std::span<HeldBlock> held, const FinestPosts& finest_posts,
                double polar_range_m = 0);

  /// Moves the window to the eye, takes what has arrived and orders what is missing. Where the
  /// chart changes the window starts afresh.
  void follow(const GeodeticPosition& eye, Renderer& renderer);
  /// Follows until nothing is missing; for boot, and for single pictures.
  void settle(const GeodeticPosition& eye, Renderer& renderer);
  /// Puts the next edits into the terrain, as many as regions; blocks they touch are built anew at
  /// once. `regions`: where each of them changes posts, in order.
  void edit(std::span<const PostGrid> regions, Renderer& renderer);

  /// Display range the window covers round the eye, at most `range_m`; 0 when nothing has arrived.
  [[nodiscard]] double covered_range_m(const GeodeticPosition& eye, double range_m) const;
  [[nodiscard]] Clearance clearance(const GeodeticPosition& eye) const;
  /// The nine cells round the eye. Domain: the finest level draws them (Clearance::near_ground).
  [[nodiscard]] NearGround near_ground() const;
  [[nodiscard]] WindowSummary summary() const;
  [[nodiscard]] TerrainView view() const;
  [[nodiscard]] const TerrainLevels& levels() const { return levels_; }
  [[nodiscard]] const PostLattice& lattice() const { return lattice_; }

 private:
  /// Where the posts that an edit may change stand; over all turns.
  [[nodiscard]] bool touches(const PostGrid& edited, const BlockId& id) const;
  [[nodiscard]] double residual_near_m(const BlockId& id) const;
  /// Changes the chart where the eye demands it; whether it did.
  bool change_chart(const GeodeticPosition& eye);
  void take_arrived(Renderer& renderer);
  void put(const TerrainBlock& block, Renderer& renderer);
  void order_missing();
  [[nodiscard]] std::size_t finest_index(std::int32_t column, std::int32_t row) const;
  [[nodiscard]] float finest_post(std::int32_t column, std::int32_t row) const;
  [[nodiscard]] double exact_post(std::int32_t column, std::int32_t row) const;
  [[nodiscard]] NearCell near_cell(std::int32_t column, std::int32_t row) const;
  [[nodiscard]] double height_below_m(double column, double row) const;
  [[nodiscard]] double cell_distance_m(const GeodeticPosition& eye, std::int32_t c, std::int32_t r,
                                       double post_x, double post_y) const;
  [[nodiscard]] double cell_relief_m(std::int32_t c, std::int32_t r) const;
  [[nodiscard]] Clearance near_clearance(const GeodeticPosition& eye) const;

  BlockPort& port_;
  PostLattice geographic_, lattice_;
  double polar_range_m_;
  TerrainLevels levels_;
  FinestPosts finest_;
  double eye_column_ = 0, eye_row_ = 0;
  PostRect focus_;
  int edits_ = 0;
  int arrived_ = 0;
};

/// The smallest box that holds every ground point within `range_m` of the eye (plus 1 %).
GeoBox range_box(double latitude_deg, double longitude_deg, double range_m);

/// How large a window must be that covers the range round an eye near a latitude, within a budget
/// of GPU bytes. `lattice`: in the geographic chart. `polar`: in a polar chart as well.
LevelSizes window_sizes(const PostLattice& lattice, double latitude_deg, double range_m,
                        double gpu_bytes, bool polar = false);

}  // namespace ridgeline
