#pragma once
#include <string>
#include <vector>

#include "core/geo/local_frame.hpp"
#include "sim/output/outcome.hpp"

namespace ridgeline::sim {

/// The square height map of Puget Sound that terrain papers measure on, as a picture: 16-bit grey,
/// 0.1 m a unit, row 0 in the north, 160 m from post to post in the size of 1025 posts a side.
///
/// Where it stands. The picture has no georeference; three of its summits have one. Rainier (post
/// 803, 529 of 1025), Adams (940, 977) and St. Helens (600, 990) lie within 170 m of their surveyed
/// places when post (0, 0) is put at UTM zone 10, 466 040 E, 5 274 030 N. Its middle post is then
/// at 46.882 N, 122.371 W.
///
/// How it is placed here. Every height of the picture becomes a post of a grid in latitude and
/// longitude, none is resampled: middle post at that place, steps of 1/695 degree of latitude
/// (159.95 m) and 1/476 degree of longitude (160.1 m there) times 1024 / (posts - 1). UTM north is
/// up to 1.2 degrees off true north and a degree of longitude is 1.4 % shorter or longer at the
/// north and south edge: the summits named above land within 2 km of their places. Heights count
/// from the ellipsoid.
struct PugetMap {
  int posts = 0;  ///< a side
  double latitude_step_deg = 0, longitude_step_deg = 0;
  double north_deg = 0, west_deg = 0;  ///< of post (0, 0)
  std::vector<float> heights_m;        ///< rows from the north

  [[nodiscard]] GeodeticPosition at(double column, double row) const;
  /// Largest height of the posts within `posts_around` of a post.
  [[nodiscard]] double highest_m(int column, int row, int posts_around) const;
};

/// Reads the picture. Outcome: the message names the file and what is wrong with it: no 16-bit grey
/// picture, not square, fewer than 64 posts a side.
Outcome read_puget(const std::string& png_file, PugetMap& map);

/// Writes the map as one GeoTIFF of float heights into a folder.
Outcome write_puget_tile(const PugetMap& map, const std::string& folder);

}  // namespace ridgeline::sim
