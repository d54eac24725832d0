#include "tests/oracle/verify.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iomanip>
#include <map>
#include <ostream>
#include <sstream>
#include <thread>
#include <utility>

#include "tests/oracle/coverage.hpp"
#include "tests/oracle/dump.hpp"
#include "tests/oracle/edits.hpp"
#include "tests/oracle/input_error.hpp"
#include "tests/oracle/judge.hpp"
#include "tests/oracle/pixel_choice.hpp"

namespace ridgeline::oracle {
namespace {

constexpr std::size_t details_kept = 20;

/// Tiles farther than the display range still shape thresholds of unknown ground near its end.
constexpr double beyond_range_m = 150000;

struct Totals {
  VerifySummary summary;
  std::vector<double> errors_px;

  void note(const std::string& line) {
    if (summary.details.size() < details_kept) summary.details.push_back(line);
  }
};

/// A distance, `sky` or `unknown`.
std::string shown(double z) {
  if (std::isnan(z)) return "unknown";
  if (std::isinf(z)) return "sky";
  std::ostringstream text;
  text << std::setprecision(9) << z << " m";
  return text.str();
}

std::string described(const Frame& frame, const ChosenPixel& pixel, const Judgement& judgement) {
  std::ostringstream text;
  const bool violated =
      judgement.soundness == Verdict::violated || judgement.completeness == Verdict::violated;
  text << "frame " << frame.name << " pixel (" << pixel.u << ", " << pixel.v << ") "
       << (violated ? "violates" : "leaves undecided")
       << (judgement.soundness != Verdict::holds ? " soundness" : "")
       << (judgement.completeness != Verdict::holds ? " completeness" : "") << ": shows "
       << shown(frame.z(pixel.u, pixel.v)) << ", centre truly "
       << shown(judgement.centre.distance_m)
       << (judgement.centre.must_be_unknown  ? " (must be unknown)"
           : judgement.centre.may_be_unknown ? " (may be unknown)"
                                             : "")
       << ", bound " << *frame.bound_px << " px, error " << (judgement.error_is_larger ? "> " : "")
       << judgement.error_px << " px: " << judgement.fault;
  return text.str();
}

std::vector<Judgement> judgements(const Judge& judge, const std::vector<ChosenPixel>& pixels,
                                  int threads) {
  std::vector<Judgement> results(pixels.size());
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    constexpr std::size_t batch = 16;
    for (std::size_t start = next.fetch_add(batch); start < pixels.size();
         start = next.fetch_add(batch)) {
      for (std::size_t i = start; i < std::min(start + batch, pixels.size()); ++i) {
        results[i] = judge.judge(pixels[i].u, pixels[i].v, pixels[i].offset);
      }
    }
  };
  std::vector<std::thread> workers;
  for (int i = 1; i < threads; ++i) workers.emplace_back(work);
  work();
  for (std::thread& worker : workers) worker.join();
  return results;
}

void count(const Frame& frame, const ChosenPixel& pixel, const Judgement& judgement,
           Totals& totals) {
  VerifySummary& summary = totals.summary;
  ++summary.pixels;
  const bool unsound = judgement.soundness == Verdict::violated;
  const bool incomplete = judgement.completeness == Verdict::violated;
  const bool open =
      judgement.soundness == Verdict::undecided || judgement.completeness == Verdict::undecided;
  if (unsound) ++summary.soundness_violations;
  if (incomplete) ++summary.completeness_violations;
  if (!unsound && !incomplete && open) ++summary.undecided;
  if (unsound || incomplete || open) totals.note(described(frame, pixel, judgement));
  if (judgement.missed_between_centres) ++summary.missed_between_centres;
  totals.errors_px.push_back(judgement.error_px);
  summary.error_max_px = std::max(summary.error_max_px, judgement.error_px);
  summary.error_max_of_bound =
      std::max(summary.error_max_of_bound, judgement.error_px / *frame.bound_px);
}

void judge_frame(const Frame& frame, const Terrain& terrain, const VerifyOptions& options,
                 Totals& totals) {
  const Tracer tracer(terrain, frame.eye, frame.range_m);
  const Tracer longer(terrain, frame.eye, frame.range_m * (1 + 2 * eta));
  const Judge judge(tracer, longer, frame);
  const std::vector<ChosenPixel> pixels =
      chosen_pixels(frame, options.pixels_per_frame, options.seed);
  const std::vector<Judgement> results = judgements(judge, pixels, options.threads);
  for (std::size_t i = 0; i < pixels.size(); ++i) count(frame, pixels[i], results[i], totals);
}

/// The geoid of the run, which every drawn frame must have been drawn with.
Geoid geoid_of(const VerifyOptions& options, const std::vector<std::filesystem::path>& files,
               const std::vector<Frame>& headers) {
  const std::string name = options.geoid.value_or("none");
  Geoid geoid = name == "none" ? Geoid() : Geoid::read(name);
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (headers[i].mode == Mode::removed) continue;
    const std::string frame_geoid = std::filesystem::path(headers[i].geoid).filename().string();
    if (frame_geoid != geoid.name()) {
      throw InputError(files[i].string(), "was drawn with geoid '" + headers[i].geoid +
                                              "', not with '" + geoid.name() + "'");
    }
  }
  return geoid;
}

/// The terrain near the drawn frames, or nothing without a drawn frame.
std::optional<Terrain> terrain_of(const VerifyOptions& options, Geoid geoid,
                                  const std::vector<Neighbourhood>& places,
                                  VerifySummary& summary) {
  std::vector<DegreeCell> coverage;
  if (options.coverage_file) coverage = read_coverage(*options.coverage_file);
  if (places.empty()) return std::nullopt;
  std::optional<Terrain> terrain =
      Terrain::load(options.terrain_folder, std::move(geoid), places, coverage);
  summary.refused_tiles = terrain->refused();
  summary.sea_cells = terrain->sea_cells();
  summary.ignored_sea_cells = terrain->ignored_sea_cells();
  return terrain;
}

std::optional<TimedEdits> edits_of(const VerifyOptions& options, std::optional<Terrain>& terrain) {
  if (!options.edit_file) return std::nullopt;
  std::vector<Edit> edits = read_edits(*options.edit_file);
  if (!terrain) return std::nullopt;
  return TimedEdits(*options.edit_file, std::move(edits), *terrain);
}

bool is_drawn(const Frame& frame) {
  return frame.mode != Mode::removed;
}

void finish(Totals& totals) {
  std::vector<double>& errors = totals.errors_px;
  if (errors.empty()) return;
  std::sort(errors.begin(), errors.end());
  double sum = 0;
  for (const double error : errors) sum += error;
  totals.summary.error_mean_px = sum / static_cast<double>(errors.size());
  totals.summary.error_p99_px = errors[(errors.size() - 1) * 99 / 100];
}

}  // namespace

VerifySummary run_verify(const VerifyOptions& options, std::ostream& progress) {
  const std::vector<std::filesystem::path> files = frame_files(options.dump_folder);
  std::vector<Frame> headers;
  std::vector<Neighbourhood> places;
  for (const std::filesystem::path& file : files) {
    headers.push_back(read_frame_header(file));
    const Frame& header = headers.back();
    if (!is_drawn(header)) continue;
    places.push_back({header.eye.lat_deg, header.eye.lon_deg, header.range_m + beyond_range_m});
  }
  Geoid geoid = geoid_of(options, files, headers);
  Totals totals;
  std::optional<Terrain> terrain = terrain_of(options, std::move(geoid), places, totals.summary);
  std::optional<TimedEdits> edits = edits_of(options, terrain);
  for (const std::filesystem::path& file : files) {
    const Frame frame = read_frame(file);
    const std::size_t violations_before = totals.summary.violations();
    const std::size_t pixels_before = totals.summary.pixels;
    ++totals.summary.frames;
    bool has_bound = false;
    for (const std::string& fault : frame_faults(frame)) {
      ++totals.summary.frame_faults;
      totals.note("frame " + frame.name + ": " + fault);
    }
    if (is_drawn(frame)) {
      if (edits) edits->advance_to(frame.time_s);
      has_bound = frame.bound_px && *frame.bound_px > 0 && std::isfinite(*frame.bound_px);
      if (has_bound) judge_frame(frame, *terrain, options, totals);
    } else {
      ++totals.summary.removed_frames;
    }
    progress << "frame " << frame.name << ": " << totals.summary.pixels - pixels_before
             << " pixels, " << totals.summary.violations() - violations_before << " violations\n"
             << std::flush;
  }
  finish(totals);
  return totals.summary;
}

void print_summary(const VerifySummary& summary, std::ostream& out) {
  for (const std::string& line : summary.refused_tiles)
    out << "counts as missing: " << line << '\n';
  for (const std::string& line : summary.details) out << line << '\n';
  if (summary.sea_cells + summary.ignored_sea_cells > 0) {
    out << "cells stated to be sea " << summary.sea_cells << " (and " << summary.ignored_sea_cells
        << " that have a tile file)\n";
  }
  out << "frames " << summary.frames << " (removed " << summary.removed_frames << ")\n"
      << "pixels checked " << summary.pixels << '\n'
      << "violations " << summary.violations() << " (soundness " << summary.soundness_violations
      << ", completeness " << summary.completeness_violations << ", frame " << summary.frame_faults
      << ")\n"
      << "undecided " << summary.undecided << '\n'
      << "points between pixel centres that no pixel around brackets "
      << summary.missed_between_centres << " (for information)\n"
      << "largest error " << std::setprecision(4) << summary.error_max_px << " px ("
      << summary.error_max_of_bound << " of the bound), mean " << summary.error_mean_px
      << " px, 99 % below " << summary.error_p99_px << " px\n";
}

}  // namespace ridgeline::oracle
