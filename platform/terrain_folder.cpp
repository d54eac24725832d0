#include "platform/terrain_folder.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <tuple>
#include <utility>

#include "core/terrain/dted_tile.hpp"
#include "core/terrain/hgt_tile.hpp"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

// Room for the longest fault text and the longest system error in a message made after boot.
constexpr std::size_t message_reserve_bytes = 256;

std::string file_name(const std::string& path) {
  return fs::path(path).filename().string();
}

std::string lower_extension(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  for (char& c : extension) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return extension;
}

std::string cell_name(int south_deg, int west_deg) {
  std::string name = std::to_string(1000 + std::abs(south_deg)).replace(0, 2, "");
  name.insert(0, 1, south_deg < 0 ? 'S' : 'N');
  name += west_deg < 0 ? 'W' : 'E';
  return name + std::to_string(1000 + std::abs(west_deg)).substr(1);
}

FileResult<PostGrid> described_hgt(const std::string& path) {
  const Result<TileLocation> location = hgt_location(file_name(path));
  if (!location.ok()) return file_problem(path, location.fault(), "expected N46E008.hgt or alike");
  std::error_code error;
  const std::uintmax_t size_bytes = fs::file_size(path, error);
  if (error) return file_problem(path, Fault::tile_unreadable, error.message());
  const Result<PostGrid> grid = hgt_grid(size_bytes, location.value());
  if (!grid.ok()) {
    return file_problem(path, grid.fault(), std::to_string(size_bytes) + " bytes");
  }
  return grid.value();
}

FileResult<PostGrid> described_dted(const std::string& path) {
  const Result<MappedFile> mapping = MappedFile::open(path.c_str());
  if (!mapping.ok()) return file_problem(path, Fault::tile_unreadable, std::strerror(errno));
  const std::span<const std::byte> bytes = mapping.value().bytes();
  const Result<PostGrid> grid = dted_grid(bytes, bytes.size());
  if (!grid.ok()) {
    return file_problem(path, grid.fault(), std::to_string(bytes.size()) + " bytes");
  }
  const int south_deg = static_cast<int>(grid.value().south_deg);
  const int west_deg = static_cast<int>(grid.value().west_deg);
  const Result<TileLocation> named = location_from_name(file_name(path));
  if (named.ok() && named.value() != TileLocation{south_deg, west_deg}) {
    return file_problem(path, Fault::tile_location_mismatch,
                        "the header says " + cell_name(south_deg, west_deg));
  }
  return grid.value();
}

/// Posts a side of a one-degree tile with the finest steps of some tiles; 1201 without any.
std::pair<int, int> finest_posts(const std::vector<PostGrid>& grids) {
  double rows = 0, columns = 0;
  for (const PostGrid& grid : grids) {
    rows = std::max(rows, std::round(1.0 / grid.latitude_step_deg));
    columns = std::max(columns, std::round(1.0 / grid.longitude_step_deg));
  }
  constexpr double srtm3 = 1200, most = 36'000;
  if (rows < 1 || columns < 1) rows = columns = srtm3;
  return {static_cast<int>(std::min(rows, most)) + 1,
          static_cast<int>(std::min(columns, most)) + 1};
}

}  // namespace

std::optional<TerrainFolder::Format> TerrainFolder::format_of(const std::string& path,
                                                              const TileReader* extra) {
  const std::string extension = lower_extension(path);
  if (extension == ".hgt") return Format::hgt;
  if (extension == ".dt0" || extension == ".dt1" || extension == ".dt2") return Format::dted;
  if (extra != nullptr && extra->accepts(path)) return Format::extra;
  return std::nullopt;
}

FileResult<PostGrid> TerrainFolder::described(const std::string& path, Format format,
                                              TileReader* extra) {
  switch (format) {
    case Format::hgt:
      return described_hgt(path);
    case Format::dted:
      return described_dted(path);
    case Format::extra:
      return extra->describe(path);
    case Format::sea:
      break;
  }
  return file_problem(path, Fault::tile_unsupported, "");
}

void TerrainFolder::add_tile(const std::string& path, Format format) {
  FileResult<PostGrid> grid = described(path, format, extra_);
  if (!grid.ok()) {
    refused_.push_back(grid.problem());
    return;
  }
  Entry entry;
  entry.grid = grid.value();
  entry.format = format;
  entry.problem.file = path;
  entries_.push_back(std::move(entry));
}

bool TerrainFolder::search(const std::string& folder, bool into_sub_folders) {
  std::error_code error;
  std::vector<fs::path> paths;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    if (!at->path().filename().string().starts_with('.')) paths.push_back(at->path());
  }
  if (error) {
    refused_.push_back(file_problem(folder, Fault::folder_unreadable, error.message()));
    return false;
  }
  std::sort(paths.begin(), paths.end());  // the order of a folder is the file system's whim
  for (const fs::path& path : paths) {
    const std::string name = path.string();
    const std::optional<Format> format = format_of(name, extra_);
    const bool is_folder = fs::is_directory(path, error);
    if (is_folder && format.has_value()) {
      refused_.push_back(file_problem(name, Fault::tile_unreadable, "is a folder"));
    } else if (is_folder && into_sub_folders) {
      static_cast<void>(search(name, false));  // an unreadable sub-folder is in refused_ now
    } else if (format.has_value()) {
      add_tile(name, *format);
    }
  }
  return true;
}

void TerrainFolder::add_sea(const TileLocation& cell, int rows, int columns) {
  constexpr double inside = 1e-6;  // a tile that only touches the cell does not lie in it
  const GeoBox box{cell.south_deg + inside, cell.west_deg + inside, cell.south_deg + 1 - inside,
                   cell.west_deg + 1 - inside};
  const bool has_tile = std::any_of(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    return entry.format != Format::sea && overlaps(box, entry.grid);
  });
  const bool has_refused =
      std::any_of(refused_.begin(), refused_.end(), [&](const FileProblem& problem) {
        const Result<TileLocation> named = location_from_name(file_name(problem.file));
        return named.ok() && named.value() == cell;
      });
  if (has_tile || has_refused) {  // a corrupt tile never becomes sea
    ++idle_sea_count_;
    return;
  }
  Entry entry;
  entry.grid = {static_cast<double>(cell.south_deg),
                static_cast<double>(cell.west_deg),
                1.0 / (rows - 1),
                1.0 / (columns - 1),
                rows,
                columns};
  entry.format = Format::sea;
  entry.problem.file = cell_name(cell.south_deg, cell.west_deg) + " (sea)";
  entries_.push_back(std::move(entry));
  ++sea_count_;
}

FileResult<TerrainFolder> TerrainFolder::open(const std::string& path, TileReader* extra,
                                              std::span<const TileLocation> sea) {
  TerrainFolder folder;
  folder.extra_ = extra;
  if (!folder.search(path, true)) return folder.refused_.front();
  if (folder.entries_.empty() && folder.refused_.empty()) {
    return file_problem(path, Fault::folder_without_tiles, "");
  }
  folder.usable_count_ = folder.entries_.size();  // statements alone are no terrain
  const auto [rows, columns] = finest_posts(folder.grids());
  for (const TileLocation& cell : sea) folder.add_sea(cell, rows, columns);
  std::vector<Entry>& entries = folder.entries_;
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.grid.south_deg, a.grid.west_deg, a.problem.file) <
           std::tie(b.grid.south_deg, b.grid.west_deg, b.problem.file);
  });
  for (Entry& entry : entries) {
    entry.problem.message.reserve(entry.problem.file.size() + message_reserve_bytes);
  }
  folder.tiles_.reserve(entries.size());
  folder.refused_.reserve(folder.refused_.size() + entries.size());
  return folder;
}

bool TerrainFolder::select(const GeoBox& box) {
  bool changed = false;
  for (Entry& entry : entries_) {
    const bool wanted = !entry.refused && overlaps(box, entry.grid);
    const bool had = entry.tile.has_value();
    if (had && !wanted) drop(entry);
    if (!had && wanted) choose(entry);
    changed = changed || had != entry.tile.has_value();
  }
  if (!changed) return false;
  tiles_.clear();
  for (const Entry& entry : entries_) {
    if (entry.tile.has_value()) tiles_.push_back(*entry.tile);
  }
  return true;
}

void TerrainFolder::forget_pages() const {
  for (const Entry& entry : entries_) entry.mapping.forget_pages();
}

std::vector<PostGrid> TerrainFolder::grids() const {
  std::vector<PostGrid> grids;
  for (const Entry& entry : entries_) {
    if (entry.format != Format::sea) grids.push_back(entry.grid);
  }
  return grids;
}

std::vector<PostGrid> TerrainFolder::sea_grids() const {
  std::vector<PostGrid> grids;
  for (const Entry& entry : entries_) {
    if (entry.format == Format::sea) grids.push_back(entry.grid);
  }
  return grids;
}

void TerrainFolder::choose(Entry& entry) {
  if (entry.format == Format::extra) {
    choose_decoded(entry);
    return;
  }
  if (entry.format == Format::sea) {
    entry.tile = HeightTile{entry.grid, TileLayout::all_zero, {}};
    return;
  }
  Result<MappedFile> mapping = MappedFile::open(entry.problem.file.c_str());
  if (!mapping.ok()) {
    refuse(entry, Fault::tile_unreadable, std::strerror(errno));
    return;
  }
  const std::span<const std::byte> bytes = mapping.value().bytes();
  const Result<HeightTile> tile = entry.format == Format::dted
                                      ? parse_dted(bytes)
                                      : parse_hgt(bytes, static_cast<int>(entry.grid.south_deg),
                                                  static_cast<int>(entry.grid.west_deg));
  if (!tile.ok()) {
    refuse(entry, tile.fault(), "");
  } else if (tile.value().grid != entry.grid) {
    refuse(entry, Fault::tile_header_corrupt, "changed since the folder was opened");
  } else {
    entry.mapping = std::move(mapping).value();
    entry.tile = tile.value();
    mapped_bytes_ += bytes.size();
  }
}

void TerrainFolder::choose_decoded(Entry& entry) {
  FileResult<DecodedTile> decoded = extra_->load(entry.problem.file);
  if (!decoded.ok()) {
    entry.refused = true;
    --usable_count_;
    refused_.push_back(decoded.problem());
    return;
  }
  entry.decoded = std::move(decoded).value();
  const std::span<const std::byte> bytes = std::as_bytes(std::span(entry.decoded.posts_m));
  entry.tile = HeightTile{entry.decoded.grid, TileLayout::float32_rows, bytes};
  decoded_bytes_ += bytes.size();
}

void TerrainFolder::drop(Entry& entry) {
  if (entry.format == Format::extra) {
    decoded_bytes_ -= entry.tile->bytes.size();
    entry.decoded = {};
  } else if (entry.format != Format::sea) {
    mapped_bytes_ -= entry.tile->bytes.size();
    entry.mapping = {};
  }
  entry.tile.reset();
}

void TerrainFolder::refuse(Entry& entry, Fault fault, const char* detail) {
  // In flight: only memory that open() has set aside, so the strings are appended to and moved.
  FileProblem& problem = entry.problem;
  problem.fault = fault;
  problem.message.append(problem.file).append(": ").append(fault_text(fault));
  if (detail[0] != '\0') problem.message.append(" (").append(detail).append(")");
  entry.refused = true;
  --usable_count_;
  refused_.push_back(std::move(problem));
}

}  // namespace ridgeline
