#include "tests/oracle/coverage.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "tests/oracle/statements.hpp"

namespace ridgeline::oracle {
namespace {

std::string lower(std::string_view word) {
  std::string text(word);
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Degrees of a sign letter and digits, as in `n46`; nothing where it is not that.
std::optional<int> degrees(std::string_view text, char positive, char negative) {
  int value = 0;
  if (text[0] != positive && text[0] != negative) return std::nullopt;
  for (const char c : text.substr(1)) {
    if (c < '0' || c > '9') return std::nullopt;
    value = 10 * value + (c - '0');
  }
  return text[0] == negative ? -value : value;
}

std::optional<DegreeCell> cell_of(const std::string& word) {
  if (word.size() != 7) return std::nullopt;
  const std::string_view text = word;
  const std::optional<int> south = degrees(text.substr(0, 3), 'n', 's');
  const std::optional<int> west = degrees(text.substr(3), 'e', 'w');
  if (!south || !west || *south < -90 || *south > 89 || *west < -180 || *west > 179) {
    return std::nullopt;
  }
  return DegreeCell{*south, *west};
}

DegreeCell stated_cell(const std::filesystem::path& file, const Statement& statement) {
  if (lower(statement.words[0]) != "sea") {
    wrong_statement(file, statement.line, "does not begin with 'sea'");
  }
  if (statement.words.size() != 2) {
    wrong_statement(file, statement.line, "'sea' takes one cell, such as N46E008");
  }
  const std::optional<DegreeCell> cell = cell_of(lower(statement.words[1]));
  if (!cell) {
    wrong_statement(file, statement.line,
                    "names no cell: N46E008 or alike, S90 to N89, W180 to E179");
  }
  return *cell;
}

std::vector<DegreeCell> sorted(std::vector<DegreeCell> cells) {
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

}  // namespace

std::vector<DegreeCell> read_coverage(const std::filesystem::path& file) {
  std::vector<DegreeCell> cells;
  for_each_statement(
      file, [&](const Statement& statement) { cells.push_back(stated_cell(file, statement)); });
  return sorted(std::move(cells));
}

std::vector<DegreeCell> coverage_in(const std::filesystem::path& file, std::string_view text) {
  std::vector<DegreeCell> cells;
  for_each_statement_in(
      text, [&](const Statement& statement) { cells.push_back(stated_cell(file, statement)); });
  return sorted(std::move(cells));
}

StepsPerDegree finest_steps(const std::vector<Grid>& grids) {
  constexpr double most = 36000;
  double lat = 0;
  double lon = 0;
  for (const Grid& grid : grids) {
    lat = std::max(lat, std::min(most, std::round(1 / grid.lat_step_deg)));
    lon = std::max(lon, std::min(most, std::round(1 / grid.lon_step_deg)));
  }
  if (lat < 1 || lon < 1) return {};
  return {static_cast<int>(lat), static_cast<int>(lon)};
}

Tile sea_tile(const DegreeCell& cell, const StepsPerDegree& steps) {
  Tile tile;
  tile.name = "sea";
  tile.south_deg = cell.south_deg;
  tile.west_deg = cell.west_deg;
  tile.lat_step_deg = 1.0 / steps.lat;
  tile.lon_step_deg = 1.0 / steps.lon;
  tile.rows = steps.lat + 1;
  tile.columns = steps.lon + 1;
  tile.sea = Sheet<float>::bordered(tile.rows, tile.columns, 0.0F);
  return tile;
}

bool reaches_into(const Grid& grid, const DegreeCell& cell) {
  const double lat_slack = same_post_steps * grid.lat_step_deg;
  const double lon_slack = same_post_steps * grid.lon_step_deg;
  const double west = west_on_turn(grid, cell.west_deg + 0.5);
  const double east = west + grid.east_deg() - grid.west_deg;
  return grid.south_deg < cell.south_deg + 1 - lat_slack &&
         grid.north_deg() > cell.south_deg + lat_slack && west < cell.west_deg + 1 - lon_slack &&
         east > cell.west_deg + lon_slack;
}

}  // namespace ridgeline::oracle
