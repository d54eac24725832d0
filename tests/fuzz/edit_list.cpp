// Lists of terrain edits, read by the display and by the oracle, and laid over a tile. An input is
// the text of a list.
#include "sim/terrain_input/edit_list.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/terrain/terrain_edit.hpp"
#include "tests/fuzz/input_bytes.hpp"
#include "tests/fuzz/list_properties.hpp"
#include "tests/fuzz/property.hpp"
#include "tests/oracle/edits.hpp"
#include "tests/oracle/input_error.hpp"

using namespace ridgeline;
using ridgeline::fuzz::must;

namespace {

using Edits = std::vector<sim::TerrainEdit>;

void check_edit(const sim::TerrainEdit& edit) {
  const PostGrid& grid = edit.grid;
  must(std::isfinite(edit.time_s), "an edit has a time");
  must(grid.rows >= 1 && grid.columns >= 1 &&
           edit.heights_m.size() ==
               static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.columns),
       "an edit has its posts");
  must(grid.south_deg >= -90 && grid.north_deg() <= 90 + 1e-6 && grid.west_deg >= -180 &&
           grid.west_deg < 180 && grid.latitude_step_deg > 0 && grid.longitude_step_deg > 0,
       "an edit is on the Earth");
  for (const float height_m : edit.heights_m) {
    must(std::isnan(height_m) || (height_m >= lowest_post_m && height_m <= highest_post_m),
         "a height is one of the Earth's or unknown");
  }
}

/// The decimal number of a list, rounded to a float at once or by way of a double.
bool is_close(float a, float b) {
  return a == b || (std::isnan(a) && std::isnan(b)) || std::nextafter(a, b) == b;
}

void check_truth(const Edits& edits, std::string_view text) {
  try {
    const std::vector<oracle::Edit> truth = oracle::edits_in("list", text);
    must(truth.size() == edits.size(), "the oracle has the same edits");
    for (std::size_t index = 0; index < edits.size(); ++index) {
      const sim::TerrainEdit& edit = edits[index];
      const oracle::Tile& patch = truth[index].patch;
      must(edit.line == truth[index].line && edit.time_s == truth[index].time_s,
           "the oracle has the same times and lines");
      must(edit.grid.rows == patch.rows && edit.grid.columns == patch.columns,
           "the oracle has the same counts");
      const std::size_t last = edit.heights_m.size() - 1;
      for (const std::size_t at : {std::size_t{0}, last / 2, last}) {
        must(is_close(edit.heights_m[at], patch.posts[at]), "the oracle has the same heights");
      }
    }
  } catch (const oracle::InputError&) {
    must(false, "the oracle takes what the display takes");
  }
}

/// Lays the edits over a row of the tile that the first one begins in.
void check_laid(const Edits& edits) {
  constexpr float ground_m = 123.25F;
  const PostGrid& first = edits.front().grid;
  const PostGrid tile{
      std::floor(first.south_deg), std::floor(first.west_deg), 1.0 / 16, 1.0 / 16, 17, 17};
  std::vector<TerrainEdit> views;
  for (const sim::TerrainEdit& edit : edits) views.push_back({edit.grid, edit.heights_m});
  for (int row = 0; row < tile.rows; row += 8) {
    std::array<float, 17> posts_m;
    posts_m.fill(ground_m);
    apply_edits(views, tile, row, 0, posts_m);
    for (const float post_m : posts_m) {
      must(std::isnan(post_m) || (post_m >= lowest_post_m && post_m <= highest_post_m),
           "a post stays a height or becomes one of an edit");
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::InputBytes(data, size).text();
  const FileResult<sim::StatementFile> file = sim::statements_in("list", text);
  must(file.ok(), "a text is statements");
  const FileResult<Edits> edits = sim::edit_list(file.value());
  if (!edits.ok()) {
    fuzz::check_problem(edits.problem(), text);
    return 0;
  }
  std::size_t posts = 0;
  double time_s = -std::numeric_limits<double>::infinity();
  for (const sim::TerrainEdit& edit : edits.value()) {
    check_edit(edit);
    must(edit.time_s >= time_s, "edits are in order of time");
    time_s = edit.time_s;
    posts += edit.heights_m.size();
  }
  must(edits.value().size() <= sim::most_edits && posts <= sim::most_edited_posts,
       "edits keep to their limits");
  check_truth(edits.value(), text);
  if (!edits.value().empty()) check_laid(edits.value());
  return 0;
}
