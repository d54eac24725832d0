#include "sim/terrain_input/coverage_list.hpp"

#include <algorithm>
#include <tuple>

namespace ridgeline::sim {
namespace {

constexpr std::size_t cell_name_length = 7;  // N46E008

bool says_sea(std::string_view word) {
  return word.size() == 3 && (word[0] == 's' || word[0] == 'S') &&
         (word[1] == 'e' || word[1] == 'E') && (word[2] == 'a' || word[2] == 'A');
}

}  // namespace

FileResult<std::vector<TileLocation>> coverage_list(const std::string& path) {
  const FileResult<StatementFile> read = statements_of(path);
  if (!read.ok()) return read.problem();
  return coverage_list(read.value());
}

FileResult<std::vector<TileLocation>> coverage_list(const StatementFile& file) {
  std::vector<TileLocation> cells;
  for (const Statement& statement : file.statements) {
    const std::vector<std::string_view> words = statement.words();
    if (!says_sea(words[0])) {
      return file.problem(Fault::file_malformed, statement.line,
                          shown(words[0]) + " is no statement; expected sea N46E008 or alike");
    }
    if (words.size() != 2) {
      return file.problem(Fault::file_malformed, statement.line,
                          "sea is followed by one cell, such as N46E008");
    }
    const auto cell = words[1].size() == cell_name_length
                          ? location_from_name(words[1])
                          : Result<TileLocation>(Fault::tile_name_unknown);
    if (!cell.ok()) {
      return file.problem(
          Fault::file_malformed, statement.line,
          shown(words[1]) + " is no cell; expected S90W180 to N89E179, such as N46E008");
    }
    cells.push_back(cell.value());
  }
  const auto place = [](const TileLocation& cell) {
    return std::tie(cell.south_deg, cell.west_deg);
  };
  std::sort(cells.begin(), cells.end(),
            [&](const auto& a, const auto& b) { return place(a) < place(b); });
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

}  // namespace ridgeline::sim
