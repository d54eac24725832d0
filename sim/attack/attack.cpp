#include "sim/attack/attack.hpp"

#include <algorithm>
#include <chrono>
#include <iomanip>
#include <ostream>
#include <set>

#include "sim/attack/random_case.hpp"
#include "sim/attack/shrink.hpp"

namespace ridgeline::sim {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t lines_of_failing = 3;  ///< of the oracle's on a case of an attack

double since_s(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The kinds that a case counts for.
std::set<std::string> families_of(const AttackCase& c, const CaseResult& result) {
  std::set<std::string> names;
  for (const Layer& layer : c.land)
    names.insert(std::string("land ") + layer_form(layer.kind).name);
  std::set<double> steps;
  for (const TilePlan& tile : c.tiles) {
    const PostGrid grid = grid_of(tile);
    steps.insert(grid.latitude_step_deg);
    names.insert(tile.format == TileFormat::hgt     ? "tiles hgt"
                 : tile.format == TileFormat::dt0   ? "tiles dt0"
                 : tile.format == TileFormat::dt1   ? "tiles dt1"
                 : tile.format == TileFormat::tif16 ? "tiles tif16"
                                                    : "tiles tif32");
    if (grid.north_deg() > 89.5 || grid.south_deg < -89.5) names.insert("tiles at a pole");
  }
  if (steps.size() > 1) names.insert("tiles of two steps");
  if (!c.sea.empty()) names.insert("stated sea");
  if (!c.edits.empty()) names.insert("edits");
  if (c.geoid.amplitude_m != 0) names.insert("geoid");
  if (c.arrival == SceneOptions::Arrival::in_step) names.insert("arrival in step");
  if (c.arrival == SceneOptions::Arrival::as_ready) names.insert("arrival as ready");
  if (result.levels > 0) names.insert("levels " + std::to_string(result.levels));
  return names;
}

std::string command_of(const AttackCase& c) {
  return "ridgeline verify --case '" + text_of(c) + "'";
}

void tell_failure(const CaseResult& result, std::size_t most_lines, std::ostream& out) {
  if (!result.fault.empty()) out << "  " << result.fault << '\n';
  for (std::size_t k = 0; k < std::min(most_lines, result.details.size()); ++k) {
    out << "  " << result.details[k] << '\n';
  }
}

/// Tells a failing case, made smaller as long as it fails in the same way.
void tell_failing(const AttackCase& c, const CaseResult& result, std::uint64_t number, bool shrink,
                  const AttackOptions& options, std::ostream& out) {
  out << "case " << number << " of seed " << options.seed << " fails, " << result.violations
      << " violations:\n  " << command_of(c) << '\n';
  tell_failure(result, lines_of_failing, out);
  if (shrink) {
    const bool by_fault = !result.fault.empty();
    CaseResult last = result;
    const Clock::time_point start = Clock::now();
    const auto fails = [&](const AttackCase& other) {
      if (since_s(start) > options.longest_shrink_s) return false;
      CaseResult now = options.judged(other, options.judge);
      const bool same = by_fault ? !now.fault.empty() : now.violations > 0 && now.fault.empty();
      if (same) last = std::move(now);
      return same;
    };
    const AttackCase smallest = shrunk(c, fails, options.shrink_tries);
    out << "smallest case found that fails as well:\n  " << command_of(smallest) << '\n';
    tell_failure(last, lines_of_failing, out);
  }
  out << std::flush;
}

void tell_counts(const std::string& name, const AttackCounts& c, std::ostream& out) {
  out << std::left << std::setw(20) << name << std::right << std::setw(8) << c.cases << std::setw(9)
      << c.frames << std::setw(9) << c.removed << std::setw(13) << c.pixels << std::setw(12)
      << c.violations << std::setw(11) << c.undecided << '\n';
}

void tell_summary(const AttackOptions& options, const AttackSummary& summary, std::ostream& out) {
  out << "family                 cases   frames  removed       pixels  violations  undecided\n";
  for (const auto& [name, counts] : summary.families) tell_counts(name, counts, out);
  tell_counts("all", summary.all, out);
  for (const auto& [word, count] : summary.removed_reasons) {
    out << "removed because " << word << ' ' << count << '\n';
  }
  out << "seed " << options.seed << ", cases " << summary.all.cases << ", pixels checked "
      << summary.all.pixels << ", violations " << summary.all.violations << ", undecided "
      << summary.all.undecided << ", failed cases " << summary.all.failed_cases << '\n';
}

}  // namespace

void AttackCounts::add(const CaseResult& result) {
  ++cases;
  failed_cases += result.failed() ? 1 : 0;
  frames += result.frames;
  removed += result.removed;
  pixels += result.pixels;
  violations += result.violations;
  undecided += result.undecided;
}

AttackSummary attack(const AttackOptions& options, std::ostream& progress, std::ostream& out) {
  AttackSummary summary;
  const Clock::time_point start = Clock::now();
  double told_s = 0;
  for (std::uint64_t number = 0;; ++number) {
    const bool over = options.cases ? number >= static_cast<std::uint64_t>(*options.cases)
                                    : since_s(start) >= options.seconds;
    if (over) break;
    const AttackCase c = random_case(options.seed, number);
    const CaseResult result = options.judged(c, options.judge);
    if (!result.unusable.empty()) {
      summary.unusable = result.unusable;
      return summary;
    }
    summary.all.add(result);
    for (const std::string& name : families_of(c, result)) summary.families[name].add(result);
    for (const auto& [word, count] : result.reasons) summary.removed_reasons[word] += count;
    if (result.failed()) {
      const bool shrink = static_cast<int>(summary.all.failed_cases) <= options.most_shrunk;
      tell_failing(c, result, number, shrink, options, out);
    }
    if (since_s(start) - told_s < options.progress_every_s) continue;
    told_s = since_s(start);
    const AttackCounts& all = summary.all;
    progress << "cases " << all.cases << ", frames " << all.frames << " (removed " << all.removed
             << "), pixels " << all.pixels << ", violations " << all.violations << ", undecided "
             << all.undecided << '\n'
             << std::flush;
  }
  tell_summary(options, summary, out);
  return summary;
}

CaseResult retell(const AttackCase& c, const JudgeOptions& options, std::ostream& out) {
  CaseResult result = judge_case(c, options);
  if (!result.unusable.empty()) return result;
  tell_failure(result, result.details.size(), out);
  for (const auto& [word, count] : result.reasons) {
    out << "removed because " << word << ' ' << count << '\n';
  }
  out << "frames " << result.frames << " (removed " << result.removed << "), levels "
      << result.levels << ", pixels checked " << result.pixels << ", violations "
      << result.violations << ", undecided " << result.undecided << '\n';
  return result;
}

}  // namespace ridgeline::sim
