// Coverage lists, read by the display and by the oracle. An input is the text of a list.
#include "sim/terrain_input/coverage_list.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "tests/fuzz/input_bytes.hpp"
#include "tests/fuzz/list_properties.hpp"
#include "tests/fuzz/property.hpp"
#include "tests/oracle/coverage.hpp"
#include "tests/oracle/input_error.hpp"

using namespace ridgeline;
using ridgeline::fuzz::must;

namespace {

using Cells = std::vector<TileLocation>;

bool is_before(const TileLocation& a, const TileLocation& b) {
  return a.south_deg != b.south_deg ? a.south_deg < b.south_deg : a.west_deg < b.west_deg;
}

/// The oracle's cells in our words, or nothing where it refuses the list.
std::optional<Cells> truth_of(std::string_view text) {
  try {
    Cells cells;
    for (const oracle::DegreeCell& cell : oracle::coverage_in("list", text)) {
      cells.push_back({cell.south_deg, cell.west_deg});
    }
    return cells;
  } catch (const oracle::InputError& error) {
    must(std::string_view(error.what()).starts_with("list: line "), "the oracle names the line");
    return std::nullopt;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::InputBytes(data, size).text();
  const FileResult<sim::StatementFile> file = sim::statements_in("list", text);
  must(file.ok(), "a text is statements");
  fuzz::check_statements(file.value(), text);
  const FileResult<Cells> cells = sim::coverage_list(file.value());
  if (!cells.ok()) {
    fuzz::check_problem(cells.problem(), text);
    // Its exception costs more than all the rest: not each time.
    must(text.size() % 8 != 0 || !truth_of(text), "the oracle refuses what the display refuses");
    return 0;
  }
  const std::optional<Cells> truth = truth_of(text);
  must(truth.has_value(), "the oracle takes the lists that the display takes");
  must(cells.value() == *truth, "the oracle has the same cells");
  const auto is_out_of_order = [](const auto& a, const auto& b) { return !is_before(a, b); };
  must(std::adjacent_find(truth->begin(), truth->end(), is_out_of_order) == truth->end(),
       "each cell is there once, in order");
  return 0;
}
