#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <ostream>

#include "tests/oracle/verify.hpp"

namespace ridgeline::oracle {
namespace {

using Json = nlohmann::ordered_json;

constexpr double shares[] = {0.5, 0.9, 0.99, 0.999};
constexpr const char* share_names[] = {"p50_px", "p90_px", "p99_px", "p99_9_px"};

std::string bin_name(std::size_t bin) {
  if (bin == 0) return "0";
  if (bin == ErrorSpread::bin_ends.size()) return "> 1";
  char name[32];
  std::snprintf(name, sizeof name, "<= %g", ErrorSpread::bin_ends[bin]);
  return name;
}

void print_spread(const ErrorSpread& spread, std::ostream& out) {
  out << spread.count() << " pixels: mean " << spread.mean_px() << " px, 50 % below "
      << spread.percentile_px(0.5) << ", 90 % " << spread.percentile_px(0.9) << ", 99 % "
      << spread.percentile_px(0.99) << ", 99.9 % " << spread.percentile_px(0.999) << ", largest "
      << spread.max_px() << " px\n  error / bound:";
  for (std::size_t bin = 0; bin < spread.bins().size(); ++bin) {
    if (spread.bins()[bin] == 0) continue;
    out << "  " << bin_name(bin) << ": " << spread.bins()[bin];
  }
  out << "\n  mean bound / mean error " << spread.tightness() << ", largest error / bound "
      << spread.max_of_bound() << '\n';
  if (!spread.has_proven()) return;
  out << "  mean proven / mean error " << spread.tightness_of_proven()
      << ", largest error / proven " << spread.max_of_proven() << '\n';
}

Json json_of(const ErrorSpread& spread) {
  Json json;
  json["pixels"] = spread.count();
  json["max_px"] = spread.max_px();
  json["mean_px"] = spread.mean_px();
  for (std::size_t i = 0; i < std::size(shares); ++i) {
    json[share_names[i]] = spread.percentile_px(shares[i]);
  }
  Json& histogram = json["error_of_bound_histogram"] = Json::array();
  for (std::size_t bin = 0; bin < spread.bins().size(); ++bin) {
    const bool is_open = bin == ErrorSpread::bin_ends.size();
    histogram.push_back({{"up_to", is_open ? Json() : Json(ErrorSpread::bin_ends[bin])},
                         {"pixels", spread.bins()[bin]}});
  }
  json["mean_bound_px"] = spread.mean_bound_px();
  json["max_of_bound"] = spread.max_of_bound();
  json["mean_bound_of_mean_error"] = spread.tightness();
  const bool has_proven = spread.has_proven();
  json["mean_proven_px"] = has_proven ? Json(spread.mean_proven_px()) : Json();
  json["max_of_proven"] = has_proven ? Json(spread.max_of_proven()) : Json();
  json["mean_proven_of_mean_error"] = has_proven ? Json(spread.tightness_of_proven()) : Json();
  return json;
}

const char* mode_word(Mode mode) {
  if (mode == Mode::svs) return "svs";
  return mode == Mode::degraded ? "degraded" : "removed";
}

Json json_of(const std::optional<double>& value) {
  return value ? Json(*value) : Json();
}

Json json_of(const FrameSummary& frame) {
  Json json;
  json["name"] = frame.name;
  json["time_s"] = frame.time_s;
  json["mode"] = mode_word(frame.mode);
  json["bound_px"] = json_of(frame.bound_px);
  json["proven_px"] = json_of(frame.proven_px);
  json["geometry_px"] = json_of(frame.geometry_px);
  json["pixels"] = frame.pixels;
  json["violations"] = frame.violations;
  json["undecided"] = frame.undecided;
  json["error_max_px"] = frame.error_max_px;
  json["error_mean_px"] = frame.error_mean_px;
  json["without_slack_pixels"] = frame.without_slack_pixels;
  json["without_slack_max_px"] = frame.without_slack_max_px;
  json["without_slack_mean_px"] = frame.without_slack_mean_px;
  return json;
}

Json json_of(const VerifyOptions& options) {
  Json json;
  json["dump"] = options.dump_folder.string();
  json["terrain"] = options.terrain_folder.string();
  json["geoid"] = options.geoid.value_or("none");
  json["coverage"] = options.coverage_file ? Json(options.coverage_file->string()) : Json();
  json["edit"] = options.edit_file ? Json(options.edit_file->string()) : Json();
  json["pixels"] = options.all_pixels ? Json("all") : Json(options.pixels_per_frame);
  json["seed"] = options.seed;
  json["walk"] = options.walk == Walk::every_cell ? "every-cell" : "accelerated";
  json["strict_edge"] = options.strict_edge;
  json["between"] = options.asks_between();
  json["without_slack_one_in"] = options.without_slack_one_in;
  return json;
}

}  // namespace

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
      << "undecided " << summary.undecided << '\n';
  for (std::size_t i = 0; i < summary.doubts.size(); ++i) {
    const DoubtCount& doubt = summary.doubts[i];
    if (doubt.pixels == 0) continue;
    out << "  " << name_of(static_cast<Doubt>(i)) << ' ' << doubt.pixels
        << ", the first: " << doubt.example << '\n';
  }
  if (summary.points_between_centres > 0) {
    out << "points between pixel centres that no pixel around brackets "
        << summary.missed_between_centres << " of " << summary.points_between_centres
        << " (for information)\n";
  }
  if (summary.leaning_on_unknown > 0) {
    out << "known pixels complete only by an unknown pixel beside them "
        << summary.leaning_on_unknown << " (for information)\n";
  }
  if (summary.leaning_on_edge > 0) {
    out << "pixels complete only by what is beyond the edge of the image "
        << summary.leaning_on_edge << " (for information)\n";
  }
  out << "largest error " << std::setprecision(4) << summary.error_max_px << " px ("
      << summary.error_max_of_bound << " of the bound), mean " << summary.error_mean_px
      << " px, 99 % below " << summary.error_p99_px << " px\n";
  if (summary.errors.count() > 0) {
    out << "actual error with slack " << eta << " along the ray, ";
    print_spread(summary.errors, out);
  }
  if (summary.errors_without_slack.count() > 0) {
    out << "actual error with slack " << stored_slack << " (storage), ";
    print_spread(summary.errors_without_slack, out);
  }
}

std::string json_report(const VerifyOptions& options, const VerifySummary& summary) {
  Json json;
  json["options"] = json_of(options);
  json["frames"] = summary.frames;
  json["removed_frames"] = summary.removed_frames;
  json["pixels"] = summary.pixels;
  json["violations"] = summary.violations();
  json["soundness_violations"] = summary.soundness_violations;
  json["completeness_violations"] = summary.completeness_violations;
  json["frame_faults"] = summary.frame_faults;
  json["undecided"] = summary.undecided;
  Json& reasons = json["undecided_reasons"] = Json::object();
  for (std::size_t i = 0; i < summary.doubts.size(); ++i) {
    const DoubtCount& doubt = summary.doubts[i];
    if (doubt.pixels == 0) continue;
    reasons[name_of(static_cast<Doubt>(i))] = {{"pixels", doubt.pixels},
                                               {"example", doubt.example}};
  }
  json["points_between_centres"] = summary.points_between_centres;
  json["missed_between_centres"] = summary.missed_between_centres;
  json["leaning_on_unknown"] = summary.leaning_on_unknown;
  json["leaning_on_edge"] = summary.leaning_on_edge;
  json["error"] = json_of(summary.errors);
  json["error_without_slack"] = json_of(summary.errors_without_slack);
  json["details"] = summary.details;
  json["refused_tiles"] = summary.refused_tiles;
  json["sea_cells"] = summary.sea_cells;
  json["ignored_sea_cells"] = summary.ignored_sea_cells;
  Json& frames = json["each_frame"] = Json::array();
  for (const FrameSummary& frame : summary.each_frame) frames.push_back(json_of(frame));
  return json.dump(1) + "\n";
}

}  // namespace ridgeline::oracle
