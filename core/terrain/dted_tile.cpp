#include "core/terrain/dted_tile.hpp"

#include <cstdint>
#include <string_view>

namespace ridgeline {
namespace {

constexpr std::size_t dsi_at = 80;
constexpr std::size_t acc_at = dsi_at + 648;
constexpr int degree_tenths = 36000;  // tenths of an arc second, the unit of the intervals

// What both the user header and the data set identification say.
struct CellFields {
  int south_deg = 0;
  int west_deg = 0;
  int latitude_interval_tenths = 0;
  int longitude_interval_tenths = 0;
  int rows = 0;
  int columns = 0;

  friend bool operator==(const CellFields&, const CellFields&) = default;
};

// A cursor over fixed-width text fields; one bad field makes the whole bad.
class FieldReader {
 public:
  explicit FieldReader(std::string_view text) : text_(text) {}

  int number(std::size_t at, std::size_t width) {
    int value = 0;
    for (const char c : text_.substr(at, width)) {
      if (c < '0' || c > '9') {
        good_ = false;
        return 0;
      }
      value = 10 * value + (c - '0');
    }
    return value;
  }

  // Degrees in `width` digits, minutes, seconds, hemisphere: `0220000W`. A minus zero is zero.
  int whole_degrees(std::size_t at, std::size_t width, char positive, char negative) {
    const int degrees = number(at, width);
    if (number(at + width, 4) != 0) off_degree_ = true;
    const char hemisphere = text_[at + width + 4];
    if (hemisphere != positive && hemisphere != negative) good_ = false;
    return hemisphere == negative ? -degrees : degrees;
  }

  [[nodiscard]] bool good() const { return good_; }
  [[nodiscard]] bool off_degree() const { return off_degree_; }

 private:
  std::string_view text_;
  bool good_ = true;
  bool off_degree_ = false;
};

CellFields user_header_fields(FieldReader& reader) {
  CellFields fields;
  fields.west_deg = reader.whole_degrees(4, 3, 'E', 'W');
  fields.south_deg = reader.whole_degrees(12, 3, 'N', 'S');
  fields.longitude_interval_tenths = reader.number(20, 4);
  fields.latitude_interval_tenths = reader.number(24, 4);
  fields.columns = reader.number(47, 4);
  fields.rows = reader.number(51, 4);
  return fields;
}

CellFields data_set_fields(FieldReader& reader) {
  CellFields fields;
  fields.south_deg = reader.whole_degrees(dsi_at + 204, 2, 'N', 'S');
  fields.west_deg = reader.whole_degrees(dsi_at + 211, 3, 'E', 'W');
  fields.latitude_interval_tenths = reader.number(dsi_at + 273, 4);
  fields.longitude_interval_tenths = reader.number(dsi_at + 277, 4);
  fields.rows = reader.number(dsi_at + 281, 4);
  fields.columns = reader.number(dsi_at + 285, 4);
  return fields;
}

bool inside_the_world(const CellFields& fields) {
  return fields.south_deg >= -90 && fields.south_deg <= 89 && fields.west_deg >= -180 &&
         fields.west_deg <= 179;
}

bool whole_cell(int interval_tenths, int count) {
  return count >= 2 && interval_tenths > 0 && interval_tenths * (count - 1) == degree_tenths;
}

std::uint32_t big_endian(std::span<const std::byte> bytes) {
  std::uint32_t value = 0;
  for (const std::byte byte : bytes) value = (value << 8U) | std::to_integer<std::uint32_t>(byte);
  return value;
}

// The checksum is the plain sum of every byte of the record in front of it.
Status verified_record(std::span<const std::byte> record, std::uint32_t column) {
  if (record[0] != std::byte{0xAA}) return Fault::tile_record_corrupt;
  const std::span<const std::byte> summed = record.first(record.size() - 4);
  std::uint32_t sum = 0;
  for (const std::byte byte : summed) sum += std::to_integer<std::uint32_t>(byte);
  if (sum != big_endian(record.last(4))) return Fault::tile_checksum_mismatch;
  const bool in_place = big_endian(record.subspan(1, 3)) == column &&
                        big_endian(record.subspan(4, 2)) == column &&
                        big_endian(record.subspan(6, 2)) == 0;
  return in_place ? Status{} : Status{Fault::tile_record_corrupt};
}

}  // namespace

Result<PostGrid> dted_grid(std::span<const std::byte> header, std::size_t size_bytes) {
  if (header.size() < dted_header_bytes || size_bytes < dted_header_bytes) {
    return Fault::tile_truncated;
  }
  const std::string_view text(reinterpret_cast<const char*>(header.data()), dted_header_bytes);
  if (text.starts_with("VOL") || text.starts_with("HDR")) return Fault::tile_unsupported;
  if (!text.starts_with("UHL1") || text.substr(dsi_at, 3) != "DSI" ||
      text.substr(acc_at, 3) != "ACC" || text.substr(dsi_at + 59, 4) != "DTED") {
    return Fault::tile_header_corrupt;
  }
  FieldReader reader(text);
  const CellFields fields = user_header_fields(reader);
  const CellFields repeated = data_set_fields(reader);
  if (!reader.good() || fields != repeated || !inside_the_world(fields)) {
    return Fault::tile_header_corrupt;
  }
  if (reader.off_degree() || !whole_cell(fields.latitude_interval_tenths, fields.rows) ||
      !whole_cell(fields.longitude_interval_tenths, fields.columns)) {
    return Fault::tile_unsupported;
  }
  const std::size_t expected_bytes =
      dted_header_bytes + static_cast<std::size_t>(fields.columns) * dted_record_bytes(fields.rows);
  if (size_bytes < expected_bytes) return Fault::tile_truncated;
  if (size_bytes > expected_bytes) return Fault::tile_size_mismatch;
  return PostGrid{.south_deg = static_cast<double>(fields.south_deg),
                  .west_deg = static_cast<double>(fields.west_deg),
                  .latitude_step_deg = 1.0 / (fields.rows - 1),
                  .longitude_step_deg = 1.0 / (fields.columns - 1),
                  .rows = fields.rows,
                  .columns = fields.columns};
}

Result<HeightTile> parse_dted(std::span<const std::byte> bytes) {
  const Result<PostGrid> grid = dted_grid(bytes, bytes.size());
  if (!grid.ok()) return grid.fault();
  const std::size_t stride = dted_record_bytes(grid.value().rows);
  const auto columns = static_cast<std::uint32_t>(grid.value().columns);
  for (std::uint32_t column = 0; column < columns; ++column) {
    const Status record =
        verified_record(bytes.subspan(dted_header_bytes + column * stride, stride), column);
    if (!record.ok()) return record.fault();
  }
  return HeightTile{grid.value(), TileLayout::dted, bytes};
}

}  // namespace ridgeline
