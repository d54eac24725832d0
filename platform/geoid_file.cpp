#include "platform/geoid_file.hpp"

#include <bit>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "platform/mapped_file.hpp"

namespace ridgeline {
namespace {

constexpr double largest_undulation_m = 200.0;
constexpr int largest_side = 50000;
constexpr double smallest_step_deg = 1e-4;  // 0.36": a tenth of the finest grids there are
constexpr float gtx_no_data = -88.8888F;
constexpr float unknown_m = std::numeric_limits<float>::quiet_NaN();

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

FileProblem corrupt(const std::string& path, const std::string& detail) {
  return file_problem(path, Fault::geoid_corrupt, detail);
}

std::optional<FileProblem> size_problem(const std::string& path, std::size_t has_bytes,
                                        std::size_t asked_bytes) {
  if (has_bytes == asked_bytes) return std::nullopt;
  return corrupt(path, std::to_string(has_bytes) + " bytes; its header asks for " +
                           std::to_string(asked_bytes));
}

template <typename Number>
std::optional<Number> number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

struct PgmHeader {
  std::optional<double> offset_m;
  std::optional<double> scale_m;
  bool origin_is_90n_0e = true;
  int columns = 0;
  int rows = 0;
  std::size_t size_bytes = 0;
};

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())) != 0) {
    text.remove_prefix(1);
  }
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) {
    text.remove_suffix(1);
  }
  return text;
}

// `# Key value`; keys that say nothing about the numbers are passed over.
void read_comment(std::string_view line, PgmHeader& header) {
  const std::string_view text = without_blanks(line.substr(1));
  const std::size_t blank = text.find_first_of(" \t\r\v\f");
  if (blank == std::string_view::npos) return;
  const std::string_view key = text.substr(0, blank);
  const std::string_view value = without_blanks(text.substr(blank));
  if (key == "Offset") header.offset_m = number<double>(value);
  if (key == "Scale") header.scale_m = number<double>(value);
  if (key == "Origin") header.origin_is_90n_0e = value == "90N 0E";
}

// The next line of the header, its line feed taken too; empty when there is none.
std::string_view next_line(std::string_view text, std::size_t& at) {
  const std::size_t end = text.find('\n', at);
  if (end == std::string_view::npos) return {};
  const std::string_view line = text.substr(at, end - at);
  at = end + 1;
  return line;
}

// Line by line, as GeographicLib writes it: P5, comments, `columns rows`, 65535, samples.
std::optional<PgmHeader> pgm_header(std::string_view text) {
  PgmHeader header;
  std::size_t at = 0;
  if (without_blanks(next_line(text, at)) != "P5") return std::nullopt;
  std::string_view line = next_line(text, at);
  for (; line.starts_with('#'); line = next_line(text, at)) read_comment(line, header);
  const std::string_view sides = without_blanks(line);
  const std::size_t blank = sides.find(' ');
  if (blank == std::string_view::npos) return std::nullopt;
  const std::optional<int> columns = number<int>(sides.substr(0, blank));
  const std::optional<int> rows = number<int>(without_blanks(sides.substr(blank)));
  if (!columns.has_value() || !rows.has_value()) return std::nullopt;
  // Exactly: one blank ends this number, what follows it are samples.
  if (next_line(text, at) != "65535") return std::nullopt;
  header.columns = *columns;
  header.rows = *rows;
  header.size_bytes = at;
  return header;
}

template <typename Unsigned>
Unsigned big_endian(const std::byte* at) {
  Unsigned value = 0;
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
    value = static_cast<Unsigned>((value << 8U) | std::to_integer<Unsigned>(at[i]));
  }
  return value;
}

bool sane_sides(int rows, int columns) {
  return rows >= 2 && columns >= 2 && rows <= largest_side && columns <= largest_side;
}

FileResult<GeoidFile> parsed_pgm(const std::string& path, std::span<const std::byte> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::optional<PgmHeader> header = pgm_header(text);
  if (!header.has_value() || !sane_sides(header->rows, header->columns)) {
    return corrupt(path, "not the header of a GeographicLib geoid");
  }
  if (!header->offset_m.has_value() || !header->scale_m.has_value()) {
    return corrupt(path, "no Offset or no Scale");
  }
  const double offset_m = *header->offset_m;
  const double scale_m = *header->scale_m;
  if (!std::isfinite(offset_m) || !(scale_m > 0) || !header->origin_is_90n_0e) {
    return corrupt(path, "Offset, Scale or Origin is not one a geoid can have");
  }
  const auto rows = static_cast<std::size_t>(header->rows);
  const auto columns = static_cast<std::size_t>(header->columns);
  if (auto problem = size_problem(path, bytes.size(), header->size_bytes + 2 * rows * columns)) {
    return *problem;
  }
  std::vector<float> posts_m(rows * columns);
  const std::byte* at = bytes.data() + header->size_bytes;
  for (std::size_t row = rows; row-- > 0;) {  // the file runs from north to south
    for (std::size_t column = 0; column < columns; ++column, at += 2) {
      const double post_m = offset_m + scale_m * big_endian<std::uint16_t>(at);
      if (!(std::abs(post_m) <= largest_undulation_m)) {
        return corrupt(path, "an undulation of " + std::to_string(post_m) + " m");
      }
      posts_m[row * columns + column] = static_cast<float>(post_m);
    }
  }
  const GeoidGrid grid{.south_deg = -90.0,
                       .west_deg = 0.0,
                       .latitude_step_deg = 180.0 / (header->rows - 1),
                       .longitude_step_deg = 360.0 / header->columns,
                       .rows = header->rows,
                       .columns = header->columns,
                       .posts_m = {}};
  return GeoidFile(file_name(path), grid, std::move(posts_m));
}

bool sane_georeference(const GeoidGrid& grid) {
  return grid.south_deg >= -90.0 && grid.west_deg >= -360.0 && grid.west_deg <= 360.0 &&
         grid.latitude_step_deg >= smallest_step_deg &&
         grid.longitude_step_deg >= smallest_step_deg && sane_sides(grid.rows, grid.columns) &&
         grid.south_deg + (grid.rows - 1) * grid.latitude_step_deg <= 90.0 + 1e-6 &&
         (grid.columns - 1) * grid.longitude_step_deg <= 360.0 + 1e-6;
}

FileResult<GeoidFile> parsed_gtx(const std::string& path, std::span<const std::byte> bytes) {
  constexpr std::size_t header_bytes = 40;
  if (bytes.size() < header_bytes) return corrupt(path, "shorter than its header");
  const auto real = [&](std::size_t at) {
    return std::bit_cast<double>(big_endian<std::uint64_t>(bytes.data() + at));
  };
  const auto whole = [&](std::size_t at) {
    return static_cast<std::int32_t>(big_endian<std::uint32_t>(bytes.data() + at));
  };
  const GeoidGrid grid{.south_deg = real(0),
                       .west_deg = real(8),
                       .latitude_step_deg = real(16),
                       .longitude_step_deg = real(24),
                       .rows = whole(32),
                       .columns = whole(36),
                       .posts_m = {}};
  if (!sane_georeference(grid)) return corrupt(path, "not the header of a GTX grid");
  const std::size_t count =
      static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.columns);
  if (auto problem = size_problem(path, bytes.size(), header_bytes + sizeof(float) * count)) {
    return *problem;
  }
  std::vector<float> posts_m(count);
  const std::byte* at = bytes.data() + header_bytes;
  for (float& post : posts_m) {
    const auto post_m = std::bit_cast<float>(big_endian<std::uint32_t>(at));
    at += sizeof(float);
    const bool no_data = post_m == gtx_no_data;  // exactly: -88.9 m is a height the geoid has
    if (!no_data && !(std::abs(post_m) <= static_cast<float>(largest_undulation_m))) {
      return corrupt(path, "an undulation of " + std::to_string(post_m) + " m");
    }
    post = no_data ? unknown_m : post_m;
  }
  return GeoidFile(file_name(path), grid, std::move(posts_m));
}

bool has_gtx_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".gtx";
}

}  // namespace

GeoidFile::GeoidFile(std::string name, GeoidGrid georeference, std::vector<float> posts_m)
    : name_(std::move(name)), georeference_(georeference), posts_m_(std::move(posts_m)) {
  georeference_.posts_m = {};
}

GeoidGrid GeoidFile::grid() const {
  GeoidGrid grid = georeference_;
  grid.posts_m = posts_m_;
  return grid;
}

FileResult<GeoidFile> load_geoid(const std::string& path) {
  if (path == "none") return GeoidFile();
  const Result<MappedFile> mapping = MappedFile::open(path.c_str());
  if (!mapping.ok()) return file_problem(path, Fault::geoid_unreadable, std::strerror(errno));
  return geoid_in(path, mapping.value().bytes());
}

FileResult<GeoidFile> geoid_in(const std::string& path, std::span<const std::byte> bytes) {
  if (has_gtx_extension(path)) return parsed_gtx(path, bytes);
  const bool pgm = bytes.size() >= 2 && bytes[0] == std::byte{'P'} && bytes[1] == std::byte{'5'};
  if (pgm) return parsed_pgm(path, bytes);
  return file_problem(path, Fault::geoid_unreadable, "neither a geoid .pgm nor a .gtx grid");
}

}  // namespace ridgeline
