#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

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
  std::uint64_t seed = 1;
  int threads = 2;  ///< > 0; the result does not depend on it
};

struct VerifySummary {
  std::size_t frames = 0;
  std::size_t removed_frames = 0;
  std::size_t frame_faults = 0;  ///< violations of a frame as a whole
  std::size_t pixels = 0;
  std::size_t soundness_violations = 0;
  std::size_t completeness_violations = 0;
  /// Points between pixel centres whose truth is not between the pixels around. No violation:
  /// frames of exact rays have some, too.
  std::size_t missed_between_centres = 0;
  std::size_t undecided = 0;  ///< pixels without a violation, but with an undecided claim
  double error_max_px = 0;    ///< errors above four bounds count as four bounds
  double error_mean_px = 0;
  double error_p99_px = 0;
  double error_max_of_bound = 0;     ///< largest error divided by its frame's bound
  std::vector<std::string> details;  ///< the first violations and undecided pixels, one line each

  int sea_cells = 0;                       ///< of the coverage list
  int ignored_sea_cells = 0;               ///< of the coverage list, because of a tile file
  std::vector<std::string> refused_tiles;  ///< tiles that count as missing: file and fault

  [[nodiscard]] std::size_t violations() const {
    return frame_faults + soundness_violations + completeness_violations;
  }
};

/// Judges every frame of a dump; one progress line a frame goes to `progress`.
/// The result is a function of the files, `pixels_per_frame` and `seed` alone.
/// Errors: InputError (tests/oracle/input_error.hpp), one line naming the file and its fault.
[[nodiscard]] VerifySummary run_verify(const VerifyOptions& options, std::ostream& progress);

/// Writes a summary as text.
void print_summary(const VerifySummary& summary, std::ostream& out);

/// The exit status of `ridgeline verify`: 1 on any violation, else 0.
[[nodiscard]] inline int exit_status(const VerifySummary& summary) {
  return summary.violations() > 0 ? 1 : 0;
}

}  // namespace ridgeline::oracle
