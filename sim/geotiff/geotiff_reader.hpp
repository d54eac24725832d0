#pragma once
#include <string>

#include "platform/tile_reader.hpp"

namespace ridgeline {

/// First post and distance of the posts along one axis of a raster.
struct PostAxis {
  double first_deg = 0;
  double step_deg = 0;
};

/// The axis moved onto whole multiples of 1/n degree when every one of its `count` posts stands
/// within 1e-6 degree (0.11 m) of one; else as it was. Files write their georeference rounded;
/// without this the posts of two tiles of one grid would not meet.
[[nodiscard]] PostAxis snapped_axis(PostAxis axis, int count);

/// Reads GeoTIFF height rasters (.tif, .tiff) with GDAL, for the desktop program only.
///
/// Posts stand at the centres of the pixels (for a pixel-is-point file GDAL moves the corner so
/// that this holds as well), snapped by snapped_axis(). One band of int16, uint16, int32, float32
/// or float64; scale and offset are applied. A post is NaN when it holds the no-data value, is
/// masked out, is not finite, lies outside lowest_post_m..highest_post_m after scaling, or was
/// never written (a hole of a sparse file, which GDAL shows as 0).
/// Frame:  WGS 84. Other geographic systems on an ellipsoid of that radius (NAD83, ETRS89, GDA)
///         are taken as WGS 84, which they are within about 2 m.
/// Domain: a projected raster is Fault::tile_projected, its system named in the message. No or
///         another coordinate system (other datum, grads, other meridian), a rotated raster,
///         posts less than 1e-6 degree apart or beyond the poles, other bands or types, heights not
///         in metres, or more than 2^28 posts: Fault::tile_unsupported. A file that is no GeoTIFF,
///         or whose directory is damaged: Fault::tile_header_corrupt; damaged pixels:
///         Fault::tile_record_corrupt. Messages end with what GDAL said; nothing is printed. The
///         format has no checksum of its own: damage that still decodes is not found.
class GeotiffReader final : public TileReader {
 public:
  GeotiffReader();
  [[nodiscard]] bool accepts(const std::string& path) const override;
  FileResult<PostGrid> describe(const std::string& path) override;
  FileResult<DecodedTile> load(const std::string& path) override;
};

}  // namespace ridgeline
