#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace ridgeline::test {

/// Height of the post in `row` (0 = south) and `column` (0 = west). Units: m; nullopt = void.
using PostHeight = std::function<std::optional<int>(int row, int column)>;

/// An SRTM tile of size x size posts, as raw as the shuttle team publishes them.
/// Domain: heights -32767..32767.
std::vector<std::byte> hgt_bytes(int size, const PostHeight& height_m);
void write_hgt(const std::string& path, int size, const PostHeight& height_m);

/// Posts of a DTED file of a level (0, 1 or 2) whose south edge is at `south_deg`.
struct DtedShape {
  int rows = 0;
  int columns = 0;
};
[[nodiscard]] DtedShape dted_shape(int level, int south_deg);

/// A complete DTED file: headers, counts and checksums right. Domain: heights -32766..32767.
std::vector<std::byte> dted_bytes(int level, int south_deg, int west_deg,
                                  const PostHeight& height_m);
void write_dted(const std::string& path, int level, int south_deg, int west_deg,
                const PostHeight& height_m);

/// Makes the checksum of one record right again, after a test has changed its posts.
void seal_dted_record(std::vector<std::byte>& file, int rows, int column);

}  // namespace ridgeline::test
