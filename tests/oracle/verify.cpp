#include "tests/oracle/verify.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <ostream>
#include <sstream>
#include <thread>
#include <utility>

#include "tests/oracle/coverage.hpp"
#include "tests/oracle/edits.hpp"
#include "tests/oracle/input_error.hpp"
#include "tests/oracle/pixel_choice.hpp"

namespace ridgeline::oracle {
namespace {

constexpr std::size_t details_kept = 20;

/// Tiles farther than the display range still shape thresholds of unknown ground near its end.
constexpr double beyond_range_m = 150000;

/// Tells how far the run is.
class Progress {
 public:
  Progress(std::ostream& out, std::size_t frames) : out_(out), frames_(frames) {}

  void frame_done(const VerifySummary& summary, const FrameSummary& frame) {
    const Clock::time_point now = Clock::now();
    const bool is_last = summary.frames == frames_;
    const bool is_soon = now - told_ < std::chrono::milliseconds(500);
    if (is_soon && !is_last && frame.violations == 0) return;
    told_ = now;
    const double seconds = std::chrono::duration<double>(now - start_).count();
    out_ << "frame " << frame.name << " (" << summary.frames << " of " << frames_
         << "): " << frame.pixels << " pixels, " << frame.violations << " violations; so far "
         << summary.pixels << " pixels, " << summary.violations() << " violations, "
         << std::llround(static_cast<double>(summary.pixels) / std::max(seconds, 1e-3))
         << " pixels a second\n"
         << std::flush;
  }

 private:
  using Clock = std::chrono::steady_clock;

  std::ostream& out_;
  std::size_t frames_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point told_ = start_ - std::chrono::hours(1);
};

/// A distance, `sky` or `unknown`.
std::string shown(double z) {
  if (std::isnan(z)) return "unknown";
  if (std::isinf(z)) return "sky";
  std::ostringstream text;
  text << std::setprecision(9) << z << " m";
  return text.str();
}

std::string described(const Frame& frame, const Question& pixel, const Judgement& judgement) {
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

/// What is kept of a judgement until its frame is done.
struct Outcome {
  double error_px;
  double without_slack_px;
  bool was_sampled;
  bool was_measured;
  bool error_is_larger;
  bool without_slack_is_larger;
  bool missed_between_centres;
  bool leans_on_unknown;
  bool leans_on_edge;
  Verdict soundness;
  Verdict completeness;
  Doubt doubt;

  Outcome(const Judgement& judgement, bool measured)
      : error_px(judgement.error_px),
        without_slack_px(judgement.error_without_slack_px.value_or(0)),
        was_sampled(judgement.error_without_slack_px.has_value()),
        was_measured(measured),
        error_is_larger(judgement.error_is_larger),
        without_slack_is_larger(judgement.error_without_slack_is_larger),
        missed_between_centres(judgement.missed_between_centres),
        leans_on_unknown(judgement.leans_on_unknown),
        leans_on_edge(judgement.leans_on_edge),
        soundness(judgement.soundness),
        completeness(judgement.completeness),
        doubt(judgement.doubt) {}
};

/// Judges the pixels of one frame and adds them up.
class FrameRun {
 public:
  FrameRun(const Frame& frame, const Terrain& terrain, const VerifyOptions& options)
      : frame_(frame),
        options_(options),
        tracer_(terrain, frame.eye, frame.range_m, options.walk),
        longer_(terrain, frame.eye, frame.range_m * (1 + 2 * eta), options.walk),
        judge_(tracer_, longer_, frame, options.strict_edge) {}

  void add_to(VerifySummary& summary, FrameSummary& of_frame) const {
    const int count =
        options_.all_pixels ? frame_.width * frame_.height : options_.pixels_per_frame;
    const std::vector<ChosenPixel> pixels =
        chosen_pixels(frame_, count, options_.seed, options_.without_slack_one_in);
    const std::vector<Outcome> outcomes = judged(pixels);
    if (options_.asks_between()) summary.points_between_centres += pixels.size();
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      add(pixels[i], outcomes[i], summary, of_frame);
    }
  }

 private:
  [[nodiscard]] Question question(const ChosenPixel& pixel) const {
    Question question{pixel.u, pixel.v, std::nullopt, pixel.is_sampled,
                      pixel.is_sampled || !options_.errors_sampled};
    if (options_.asks_between()) question.between = pixel.offset;
    return question;
  }

  [[nodiscard]] std::vector<Outcome> judged(const std::vector<ChosenPixel>& pixels) const {
    std::vector<Outcome> outcomes(pixels.size(), Outcome(Judgement{}, false));
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
      constexpr std::size_t batch = 64;
      for (std::size_t start = next.fetch_add(batch); start < pixels.size();
           start = next.fetch_add(batch)) {
        for (std::size_t i = start; i < std::min(start + batch, pixels.size()); ++i) {
          const Question asked = question(pixels[i]);
          outcomes[i] = Outcome(judge_.judge(asked), asked.error);
        }
      }
    };
    std::vector<std::thread> workers;
    for (int i = 1; i < options_.threads; ++i) workers.emplace_back(work);
    work();
    for (std::thread& worker : workers) worker.join();
    return outcomes;
  }

  void add(const ChosenPixel& pixel, const Outcome& outcome, VerifySummary& summary,
           FrameSummary& of_frame) const {
    ++summary.pixels;
    const bool unsound = outcome.soundness == Verdict::violated;
    const bool incomplete = outcome.completeness == Verdict::violated;
    if (unsound) ++summary.soundness_violations;
    if (incomplete) ++summary.completeness_violations;
    if (outcome.missed_between_centres) ++summary.missed_between_centres;
    if (outcome.leans_on_unknown) ++summary.leaning_on_unknown;
    if (outcome.leans_on_edge) ++summary.leaning_on_edge;
    if (unsound || incomplete) {
      if (summary.details.size() < details_kept) summary.details.push_back(told(pixel));
    } else if (outcome.doubt != Doubt::none) {
      ++summary.undecided;
      ++of_frame.undecided;
      DoubtCount& doubt = summary.doubts[static_cast<std::size_t>(outcome.doubt)];
      if (doubt.pixels++ == 0) doubt.example = told(pixel);
    }
    add_errors(outcome, summary, of_frame);
  }

  void add_errors(const Outcome& outcome, VerifySummary& summary, FrameSummary& of_frame) const {
    ++of_frame.pixels;
    if (!outcome.was_measured) return;
    summary.errors.add(outcome.error_px, outcome.error_is_larger, *frame_.bound_px,
                       frame_.proven_px);
    ++of_frame.measured_pixels;
    of_frame.error_max_px = std::max(of_frame.error_max_px, outcome.error_px);
    of_frame.error_mean_px += outcome.error_px;
    if (!outcome.was_sampled) return;
    summary.errors_without_slack.add(outcome.without_slack_px, outcome.without_slack_is_larger,
                                     *frame_.bound_px, frame_.proven_px);
    ++of_frame.without_slack_pixels;
    of_frame.without_slack_max_px =
        std::max(of_frame.without_slack_max_px, outcome.without_slack_px);
    of_frame.without_slack_mean_px += outcome.without_slack_px;
  }

  /// A judgement in words: judged again, because that of every pixel takes too much memory.
  [[nodiscard]] std::string told(const ChosenPixel& pixel) const {
    const Question asked = question(pixel);
    return described(frame_, asked, judge_.judge(asked));
  }

  const Frame& frame_;
  const VerifyOptions& options_;
  Tracer tracer_;
  Tracer longer_;
  Judge judge_;
};

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

bool has_bound(const Frame& frame) {
  return frame.bound_px && *frame.bound_px > 0 && std::isfinite(*frame.bound_px);
}

FrameSummary summary_of(const Frame& frame) {
  FrameSummary of_frame;
  of_frame.name = frame.name;
  of_frame.time_s = frame.time_s;
  of_frame.mode = frame.mode;
  of_frame.bound_px = frame.bound_px;
  of_frame.proven_px = frame.proven_px;
  of_frame.geometry_px = frame.geometry_px;
  return of_frame;
}

void judge_frame(const Frame& frame, const std::optional<Terrain>& terrain,
                 const VerifyOptions& options, VerifySummary& summary) {
  FrameSummary of_frame = summary_of(frame);
  const std::size_t violations_before = summary.violations();
  for (const std::string& fault : frame_faults(frame)) {
    ++summary.frame_faults;
    if (summary.details.size() < details_kept) {
      summary.details.push_back("frame " + frame.name + ": " + fault);
    }
  }
  ++summary.frames;
  if (!is_drawn(frame)) ++summary.removed_frames;
  if (is_drawn(frame) && has_bound(frame)) {
    FrameRun(frame, *terrain, options).add_to(summary, of_frame);
  }
  of_frame.violations = summary.violations() - violations_before;
  const auto mean = [](double& sum, std::size_t count) {
    if (count > 0) sum /= static_cast<double>(count);
  };
  mean(of_frame.error_mean_px, of_frame.measured_pixels);
  mean(of_frame.without_slack_mean_px, of_frame.without_slack_pixels);
  summary.each_frame.push_back(std::move(of_frame));
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
  VerifySummary summary;
  std::optional<Terrain> terrain = terrain_of(options, std::move(geoid), places, summary);
  std::optional<TimedEdits> edits = edits_of(options, terrain);
  Progress told(progress, files.size());
  for (const std::filesystem::path& file : files) {
    const Frame frame = read_frame(file);
    if (edits && is_drawn(frame)) edits->advance_to(frame.time_s);
    judge_frame(frame, terrain, options, summary);
    told.frame_done(summary, summary.each_frame.back());
  }
  summary.error_max_px = summary.errors.max_px();
  summary.error_mean_px = summary.errors.mean_px();
  summary.error_p99_px = summary.errors.percentile_px(0.99);
  summary.error_max_of_bound = summary.errors.max_of_bound();
  return summary;
}

}  // namespace ridgeline::oracle
