#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/geo/camera.hpp"
#include "sim/session/session.hpp"

namespace ridgeline::sim {

/// What one layer of an attacked land does to the heights below it. docs/commands.md lists them.
enum class LayerKind : std::uint8_t {
  flat,
  slope,
  fractal,
  ridges,
  rough,
  spires,
  walls,
  cliffs,
  checker,
  stairs,
  clamp,
  seam,
  holes,
  islands,
  stripes,
  half,
  box,
};
inline constexpr int layer_kinds = 17;
inline constexpr std::size_t most_layer_numbers = 5;

/// What a number of a layer means to whoever makes a case smaller.
enum class NumberRole : std::uint8_t {
  amount,   ///< smaller is simpler, 0 simplest
  rarity,   ///< larger is simpler: one in so many
  length,   ///< has no simplest value
  pattern,  ///< a seed, a direction or an offset
};

/// The name, meaning and domain of one number of a layer.
struct LayerNumber {
  const char* name;
  NumberRole role;
  double least, most;
  bool whole;  ///< takes whole numbers only
};

/// What the text of a layer looks like: `name:number,number,...`.
struct LayerForm {
  const char* name;
  std::size_t count;
  std::array<LayerNumber, most_layer_numbers> numbers;
};
[[nodiscard]] const LayerForm& layer_form(LayerKind kind);

struct Layer {
  LayerKind kind = LayerKind::flat;
  std::array<double, most_layer_numbers> numbers{};

  friend bool operator==(const Layer&, const Layer&) = default;
};

/// How the file of a tile is written.
enum class TileFormat : std::uint8_t { hgt, dt0, dt1, tif16, tif32 };

/// One tile. Posts of the one-degree formats follow from format and corner; `lat_per_deg` to
/// `columns` are kept for GeoTIFF alone.
struct TilePlan {
  TileFormat format = TileFormat::dt0;
  double south_deg = 0, west_deg = 0;
  int lat_per_deg = 0, lon_per_deg = 0;  ///< posts a degree
  int rows = 0, columns = 0;

  friend bool operator==(const TilePlan&, const TilePlan&) = default;
};

/// One timed edit that fills a rectangle of posts.
struct EditPlan {
  double time_s = 0, south_deg = 0, west_deg = 0;
  int lat_per_deg = 0, lon_per_deg = 0;
  int rows = 1, columns = 1;
  double height_m = 0;  ///< NaN: void

  friend bool operator==(const EditPlan& a, const EditPlan& b);
};

struct SeaCell {
  int south_deg = 0, west_deg = 0;
  friend bool operator==(const SeaCell&, const SeaCell&) = default;
};

/// A world-wide geoid of posts that each stand for themselves.
struct GeoidPlan {
  double amplitude_m = 0;  ///< 0: no geoid
  double step_deg = 10;    ///< divides 180
  double seed = 0;
  friend bool operator==(const GeoidPlan&, const GeoidPlan&) = default;
};

struct AttackPose {
  double latitude_deg = 0, longitude_deg = 0, height_m = 0;
  double roll_deg = 0, pitch_deg = 0, heading_deg = 0;
  double time_s = 0;
  friend bool operator==(const AttackPose&, const AttackPose&) = default;
};

/// Everything that decides what one case draws, and so what the oracle says of it (but for terrain
/// that arrives `as_ready`, which depends on the machine's speed).
struct AttackCase {
  double at_latitude_deg = 0, at_longitude_deg = 0;  ///< where the layers count posts from
  std::vector<Layer> land;                           ///< applied in this order, from 0 m
  std::vector<TilePlan> tiles;
  std::vector<SeaCell> sea;
  std::vector<EditPlan> edits;
  GeoidPlan geoid;
  double window_mib = 96;
  SceneOptions::Arrival arrival = SceneOptions::Arrival::settled;
  ImageGeometry image{64, 48, 60};
  double error_px = 1, range_m = 10'000;
  std::vector<AttackPose> poses;  ///< at least one; drawn in this order
};
bool operator==(const AttackCase& a, const AttackCase& b);

/// The case as one line of text that parse_case() reads back to the same bits.
[[nodiscard]] std::string text_of(const AttackCase& attack_case);

/// Reads a case. Result: what is wrong with the text, or an empty string.
/// Domain: every number is checked, so that any text either is a case that can be written and drawn
///         or is refused: at most 400 tiles, 64 layers, 64 edits, 256 poses, 2^22 pixels a frame
///         and 2^24 posts a tile.
[[nodiscard]] std::string parse_case(const std::string& text, AttackCase& attack_case);

/// Where the posts of a tile stand.
[[nodiscard]] PostGrid grid_of(const TilePlan& tile);

}  // namespace ridgeline::sim
