#include "sim/terrain_input/edit_list.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <limits>
#include <optional>

namespace ridgeline::sim {
namespace {

constexpr std::size_t words_before_heights = 7;
constexpr double arcsec_per_deg = 3600;
constexpr double rounding_deg = 1e-9;
constexpr double latest_s = 1e12;
using Words = std::vector<std::string_view>;

template <typename Number>
std::optional<Number> number(std::string_view word) {
  Number value{};
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (fault != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

/// What is wrong with a line.
struct Wrong {
  Fault fault = Fault::file_malformed;
  std::string what;
};

/// The edit in the words of a line, or what is wrong with them.
class EditReader {
 public:
  EditReader(const Words& words, std::size_t posts_left) : words_(words), posts_left_(posts_left) {}

  std::optional<TerrainEdit> read() {
    if (words_.size() <= words_before_heights) {
      return refused("expected SECONDS SOUTH WEST LAT_STEP LON_STEP ROWS COLUMNS HEIGHTS...");
    }
    PostGrid& grid = edit_.grid;
    if (!take(0, "time", -latest_s, latest_s, edit_.time_s) ||
        !take(1, "south", -90, 90, grid.south_deg) || !take(2, "west", -180, 180, grid.west_deg) ||
        !take_step(3, grid.latitude_step_deg) || !take_step(4, grid.longitude_step_deg) ||
        !take_count(5, "rows", grid.rows) || !take_count(6, "columns", grid.columns)) {
      return std::nullopt;
    }
    if (grid.west_deg == 180) grid.west_deg = -180;
    if (grid.north_deg() > 90 + rounding_deg) return refused("the rows reach beyond the pole");
    if (grid.east_deg() - grid.west_deg > 360 + rounding_deg) {
      return refused("the columns reach round the Earth");
    }
    if (post_count() > posts_left_) {
      wrong_.fault = Fault::capacity_exceeded;
      return refused("more than " + std::to_string(most_edited_posts) + " posts in all");
    }
    if (!take_heights()) return std::nullopt;
    return std::move(edit_);
  }

  [[nodiscard]] const Wrong& wrong() const { return wrong_; }

 private:
  [[nodiscard]] std::size_t post_count() const {
    return static_cast<std::size_t>(edit_.grid.rows) * static_cast<std::size_t>(edit_.grid.columns);
  }

  std::nullopt_t refused(std::string what) {
    wrong_.what = std::move(what);
    return std::nullopt;
  }

  bool take(std::size_t at, const char* name, double low, double high, double& out) {
    const std::optional<double> value = number<double>(words_[at]);
    if (value && *value >= low && *value <= high) {
      out = *value;
      return true;
    }
    char range[64];
    std::snprintf(range, sizeof range, "%.10g to %.10g", low, high);
    refused(std::string(name) + " " + shown(words_[at]) + " is not a number from " + range);
    return false;
  }

  bool take_step(std::size_t at, double& out_deg) {
    double step_arcsec = 0;
    if (!take(at, "step", smallest_edit_step_arcsec, largest_edit_step_arcsec, step_arcsec)) {
      return false;
    }
    out_deg = step_arcsec / arcsec_per_deg;
    return true;
  }

  bool take_count(std::size_t at, const char* name, int& out) {
    const std::optional<int> value = number<int>(words_[at]);
    if (value && *value >= 1 && *value <= static_cast<int>(most_edited_posts)) {
      out = *value;
      return true;
    }
    refused(std::string(name) + " " + shown(words_[at]) + " is not a whole number from 1 to " +
            std::to_string(most_edited_posts));
    return false;
  }

  bool take_height(std::string_view word, float& out_m) {
    if (word == "void") {
      out_m = std::numeric_limits<float>::quiet_NaN();
      return true;
    }
    const std::optional<float> value = number<float>(word);
    if (value && *value >= lowest_post_m && *value <= highest_post_m) {
      out_m = *value;
      return true;
    }
    refused("height " + shown(word) + " is neither a number from -12000 to 9000 nor void");
    return false;
  }

  bool take_heights() {
    const std::size_t given = words_.size() - words_before_heights;
    edit_.heights_m.resize(post_count());
    if (words_[words_before_heights] == "fill") {
      float height_m = 0;
      if (given != 2) {
        refused("fill is followed by one height");
        return false;
      }
      if (!take_height(words_.back(), height_m)) return false;
      std::fill(edit_.heights_m.begin(), edit_.heights_m.end(), height_m);
      return true;
    }
    if (given != post_count()) {
      refused("has " + std::to_string(given) + " heights for " + std::to_string(post_count()) +
              " posts");
      return false;
    }
    for (std::size_t k = 0; k < given; ++k) {
      if (!take_height(words_[words_before_heights + k], edit_.heights_m[k])) return false;
    }
    return true;
  }

  const Words& words_;
  std::size_t posts_left_;
  TerrainEdit edit_;
  Wrong wrong_;
};

}  // namespace

FileResult<std::vector<TerrainEdit>> edit_list(const std::string& path) {
  const FileResult<StatementFile> read = statements_of(path);
  if (!read.ok()) return read.problem();
  return edit_list(read.value());
}

FileResult<std::vector<TerrainEdit>> edit_list(const StatementFile& file) {
  std::vector<TerrainEdit> edits;
  std::size_t posts_left = most_edited_posts;
  for (const Statement& statement : file.statements) {
    if (edits.size() == most_edits) {
      return file.problem(Fault::capacity_exceeded, statement.line,
                          "more than " + std::to_string(most_edits) + " edits");
    }
    const Words words = statement.words();
    EditReader reader(words, posts_left);
    std::optional<TerrainEdit> edit = reader.read();
    if (!edit) return file.problem(reader.wrong().fault, statement.line, reader.wrong().what);
    posts_left -= edit->heights_m.size();
    edit->line = statement.line;
    edits.push_back(std::move(*edit));
  }
  std::stable_sort(edits.begin(), edits.end(),
                   [](const TerrainEdit& a, const TerrainEdit& b) { return a.time_s < b.time_s; });
  return edits;
}

}  // namespace ridgeline::sim
