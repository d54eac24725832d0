#include "tests/oracle/edits.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "tests/oracle/statements.hpp"

namespace ridgeline::oracle {
namespace {

constexpr std::size_t most_edits = 64;
constexpr std::size_t most_posts = 65536;
constexpr double lowest_m = lowest_ground_m;
constexpr double highest_m = highest_ground_m;
constexpr std::size_t words_before_heights = 7;

std::optional<double> real(std::string_view word) {
  double value = 0;
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (fault != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

/// Degrees of a step in seconds of arc: whole fractions of a degree are exact, however few of their
/// digits are written.
double step_deg(double arcsec) {
  const double per_degree = std::round(3600 / arcsec);
  if (per_degree >= 1 && std::abs(per_degree * arcsec / 3600 - 1) < 1e-6) return 1 / per_degree;
  return arcsec / 3600;
}

/// One statement of an edit file, word by word.
class EditLine {
 public:
  EditLine(const std::filesystem::path& file, const Statement& statement)
      : file_(file), statement_(statement) {}

  [[nodiscard]] Edit parsed(std::size_t posts_before) const {
    if (statement_.words.size() <= words_before_heights) wrong("is too short for an edit");
    Edit edit;
    edit.line = statement_.line;
    edit.time_s = number(0, "SECONDS", -1e15, 1e15);
    Tile& patch = edit.patch;
    patch.name = "edit";
    patch.south_deg = number(1, "SOUTH_DEG", -90, 90);
    patch.west_deg = number(2, "WEST_DEG", -180, 180);
    patch.lat_step_deg = step_deg(number(3, "LAT_STEP_ARCSEC", 1e-3, 648000));
    patch.lon_step_deg = step_deg(number(4, "LON_STEP_ARCSEC", 1e-3, 648000));
    patch.rows = count(5, "ROWS");
    patch.columns = count(6, "COLUMNS");
    const std::size_t posts =
        static_cast<std::size_t>(patch.rows) * static_cast<std::size_t>(patch.columns);
    if (posts_before + posts > most_posts) wrong("makes more than 65536 posts in all");
    const double slack = same_post_steps * patch.lat_step_deg;
    if (patch.north_deg() > 90 + slack) wrong("reaches beyond the pole");
    if (patch.east_deg() - patch.west_deg > 360) wrong("is wider than the Earth");
    take_heights(posts, patch);
    return edit;
  }

 private:
  [[noreturn]] void wrong(const std::string& fault) const {
    wrong_statement(file_, statement_.line, fault);
  }

  [[nodiscard]] double number(std::size_t at, const char* name, double low, double high) const {
    const std::optional<double> value = real(statement_.words[at]);
    if (!value) wrong(std::string(name) + " is not a number");
    if (*value < low || *value > high) wrong(std::string(name) + " is outside its domain");
    return *value;
  }

  [[nodiscard]] int count(std::size_t at, const char* name) const {
    const double value = number(at, name, 1, static_cast<double>(most_posts));
    if (value != std::floor(value)) wrong(std::string(name) + " is not a whole number");
    return static_cast<int>(value);
  }

  [[nodiscard]] float height(std::size_t at) const {
    if (statement_.words[at] == "void") return void_post;
    return static_cast<float>(number(at, "a height", lowest_m, highest_m));
  }

  void take_heights(std::size_t posts, Tile& patch) const {
    const std::size_t words = statement_.words.size() - words_before_heights;
    if (statement_.words[words_before_heights] == "fill") {
      if (words != 2) wrong("'fill' takes one height");
      const float all = height(words_before_heights + 1);
      for (std::size_t i = 0; i < posts; ++i) patch.posts.push_back(all);
      return;
    }
    if (words != posts) {
      wrong("has " + std::to_string(words) + " heights instead of " + std::to_string(posts));
    }
    for (std::size_t i = 0; i < posts; ++i) {
      patch.posts.push_back(height(words_before_heights + i));
    }
  }

  const std::filesystem::path& file_;
  const Statement& statement_;
};

/// The statements of an edit file, one after the other.
class EditFile {
 public:
  explicit EditFile(const std::filesystem::path& file) : file_(file) {}

  void take(const Statement& statement) {
    if (edits_.size() == most_edits) {
      wrong_statement(file_, statement.line, "is one edit more than 64");
    }
    edits_.push_back(EditLine(file_, statement).parsed(posts_));
    posts_ += edits_.back().patch.posts.size();
  }

  std::vector<Edit> in_time_order() && {
    std::stable_sort(edits_.begin(), edits_.end(),
                     [](const Edit& a, const Edit& b) { return a.time_s < b.time_s; });
    return std::move(edits_);
  }

 private:
  const std::filesystem::path& file_;
  std::vector<Edit> edits_;
  std::size_t posts_ = 0;
};

}  // namespace

std::vector<Edit> read_edits(const std::filesystem::path& file) {
  EditFile edits(file);
  for_each_statement(file, [&](const Statement& statement) { edits.take(statement); });
  return std::move(edits).in_time_order();
}

std::vector<Edit> edits_in(const std::filesystem::path& file, std::string_view text) {
  EditFile edits(file);
  for_each_statement_in(text, [&](const Statement& statement) { edits.take(statement); });
  return std::move(edits).in_time_order();
}

TimedEdits::TimedEdits(const std::filesystem::path& file, std::vector<Edit> edits, Terrain& terrain)
    : edits_(std::move(edits)), terrain_(terrain) {
  for (const Edit& edit : edits_) {
    if (!terrain_.has_lattice_of(edit.patch)) {
      wrong_statement(file, edit.line, "no tile has posts at these steps there");
    }
  }
}

void TimedEdits::advance_to(double time_s) {
  std::size_t wanted = 0;
  while (wanted < edits_.size() && edits_[wanted].time_s <= time_s) ++wanted;
  for (; done_.size() > wanted; done_.pop_back()) terrain_.put_back(done_.back());
  while (done_.size() < wanted) done_.push_back(terrain_.replace(edits_[done_.size()].patch));
}

}  // namespace ridgeline::oracle
