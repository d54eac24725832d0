#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "tests/oracle/dump.hpp"
#include "tests/oracle/error_spread.hpp"
#include "tests/oracle/judge.hpp"
#include "tests/oracle/tracer.hpp"

/// The independent oracle behind `ridgeline verify`. It decides what contract.md sections 1 to 3
/// say about a dump, in double precision, with its own readers and its own geodesy: nothing here
/// uses core/, platform/ or shaders/.
namespace ridgeline::oracle {

struct VerifyOptions {
  std::filesystem::path dump_folder;
  std::filesystem::path terrain_folder;
  /// A geoid file or `none`. Without it only frames that say `none` can be judged.
  std::optional<std::string> geoid;
  std::optional<std::filesystem::path> coverage_file;  ///< cells that are sea without a tile file
  std::optional<std::filesystem::path> edit_file;      ///< terrain that changes at the frames' time
  int pixels_per_frame = 5000;                         ///< > 0; half of them at depth jumps
  bool all_pixels = false;                             ///< every pixel of every frame instead
  std::uint64_t seed = 1;
  int threads = 2;  ///< > 0; the result does not depend on it
  Walk walk = Walk::accelerated;
  /// Pixels beyond the edge of the image do not count as drawn exactly (see Judge).
  bool strict_edge = false;
  /// Ask for completeness at a second point of every pixel, for information; without a word here,
  /// unless all pixels are judged: then most neighbours answer for it, and it doubles the time.
  std::optional<bool> between;
  /// The error without slack is measured at one in so many of the pixels; 0 = nowhere.
  int without_slack_one_in = 16;
  /// Measure the error with slack of those pixels only, too; of the others only decide the promise.
  bool errors_sampled = false;

  [[nodiscard]] bool asks_between() const { return between.value_or(!all_pixels); }
};

/// What was found in one frame.
struct FrameSummary {
  std::string name;
  double time_s = 0;
  Mode mode = Mode::svs;
  std::optional<double> bound_px;
  std::optional<double> proven_px;
  std::optional<double> geometry_px;
  std::size_t pixels = 0;
  std::size_t violations = 0;  ///< those of the frame as a whole included
  std::size_t undecided = 0;
  std::size_t measured_pixels = 0;  ///< whose error was
  double error_max_px = 0;
  double error_mean_px = 0;
  std::size_t without_slack_pixels = 0;
  double without_slack_max_px = 0;
  double without_slack_mean_px = 0;
};

/// Undecided pixels for one reason.
struct DoubtCount {
  std::size_t pixels = 0;
  std::string example;  ///< the first of them
};

struct VerifySummary {
  std::size_t frames = 0;
  std::size_t removed_frames = 0;
  std::size_t frame_faults = 0;  ///< violations of a frame as a whole
  std::size_t pixels = 0;
  std::size_t soundness_violations = 0;
  std::size_t completeness_violations = 0;
  /// Points between pixel centres that were asked, and those whose truth is not between the pixels
  /// around. No violation: frames of exact rays have some, too.
  std::size_t points_between_centres = 0;
  std::size_t missed_between_centres = 0;
  /// Pixels that show something known and are complete only because an unknown pixel around may
  /// hide what is behind unknown ground. No violation: how much that rule lets pass.
  std::size_t leaning_on_unknown = 0;
  /// Pixels that are complete only because pixels beyond the edge of the image count as drawn
  /// exactly. No violation, unless the edge is strict.
  std::size_t leaning_on_edge = 0;
  std::size_t undecided = 0;  ///< pixels without a violation, but with an undecided claim
  std::array<DoubtCount, doubt_count> doubts;  ///< the same by reason

  double error_max_px = 0;  ///< errors above four bounds count as four bounds
  double error_mean_px = 0;
  double error_p99_px = 0;
  double error_max_of_bound = 0;     ///< largest error divided by its frame's bound
  ErrorSpread errors;                ///< with the contract's slack along the ray
  ErrorSpread errors_without_slack;  ///< of the pixels sampled; above a bound counts as the bound

  std::vector<std::string> details;  ///< the first violations, one line each
  std::vector<FrameSummary> each_frame;

  int sea_cells = 0;                       ///< of the coverage list
  int ignored_sea_cells = 0;               ///< of the coverage list, because of a tile file
  std::vector<std::string> refused_tiles;  ///< tiles that count as missing: file and fault

  [[nodiscard]] std::size_t violations() const {
    return frame_faults + soundness_violations + completeness_violations;
  }
};

/// Judges every frame of a dump. Progress (frames done, pixels, violations, pixels a second) goes
/// to `progress`, at most two lines a second but for frames with violations.
/// The result is a function of the files and the options alone, `threads` left out.
/// Errors: InputError (tests/oracle/input_error.hpp), one line naming the file and its fault.
[[nodiscard]] VerifySummary run_verify(const VerifyOptions& options, std::ostream& progress);

/// Writes a summary as text.
void print_summary(const VerifySummary& summary, std::ostream& out);

/// All of a summary, and the options that led to it, as JSON text. Numbers that are not finite, and
/// what was not measured, are null.
[[nodiscard]] std::string json_report(const VerifyOptions& options, const VerifySummary& summary);

/// The exit status of `ridgeline verify`: 1 on any violation, else 0.
[[nodiscard]] inline int exit_status(const VerifySummary& summary) {
  return summary.violations() > 0 ? 1 : 0;
}

}  // namespace ridgeline::oracle
