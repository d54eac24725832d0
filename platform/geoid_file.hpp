#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/geo/geoid.hpp"
#include "platform/file_result.hpp"

namespace ridgeline {

/// A geoid in memory, with the name that frames and reports give it.
class GeoidFile {
 public:
  /// The geoid `none`: N = 0 everywhere.
  GeoidFile() = default;
  GeoidFile(std::string name, GeoidGrid georeference, std::vector<float> posts_m);

  /// The file name without its folder, or `none`.
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Owner: views this object, wherever it has been moved to; copies have posts of their own.
  [[nodiscard]] GeoidGrid grid() const;

 private:
  std::string name_ = "none";
  GeoidGrid georeference_;  // without posts: a view would not survive a copy
  std::vector<float> posts_m_;
};

/// Reads a geoid: the word `none`, GeographicLib's PGM (16 bit, from 90N 0E, Offset and Scale in
/// the comments) or PROJ's GTX (big-endian float, -88.8888 without data).
/// Domain: a file that cannot be read or is neither: Fault::geoid_unreadable. One whose header is
///         damaged, whose size is not what the header asks for, or that holds an undulation beyond
///         200 m either way (the Earth's lie in -107..86 m): Fault::geoid_corrupt.
/// Cost:   boot time only; 4 bytes of heap a post.
/// Source: GeographicLib 2.1.2 manual, "Geoid height"; PROJ 9.1 manual, "Vertical grids: GTX".
FileResult<GeoidFile> load_geoid(const std::string& path);

/// The geoid in the bytes of a file named `path`, whose ending tells a GTX grid; as load_geoid().
FileResult<GeoidFile> geoid_in(const std::string& path, std::span<const std::byte> bytes);

}  // namespace ridgeline
