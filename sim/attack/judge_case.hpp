#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "sim/attack/attack_case.hpp"

namespace ridgeline::sim {

/// What came of one case.
struct CaseResult {
  std::size_t frames = 0;  ///< removed ones included
  std::size_t removed = 0;
  std::size_t pixels = 0;
  std::size_t violations = 0, undecided = 0;
  int levels = 0;                              ///< of the terrain window
  std::map<std::string, std::size_t> reasons;  ///< of removed frames: the word of each
  /// The oracle's first violations and undecided pixels, one line each.
  std::vector<std::string> details;
  /// What kept the case from being judged: a crash, a hang, a tile of the case that was refused.
  std::string fault;
  /// What would keep every case from being judged: no graphics, no room on the disk.
  std::string unusable;

  [[nodiscard]] bool failed() const { return violations > 0 || !fault.empty(); }
};

struct JudgeOptions {
  int pixels_per_frame = 12'000;
  int threads = 1;
  double longest_s = 600;  ///< after so many seconds of wall time a case counts as hung
  /// Where the tiles and dumps of the case stay; empty: in a temporary folder, removed afterwards.
  std::string keep_folder;
  /// Applied to every picture before it is dumped. Tests break pictures with it.
  std::function<void(Picture&)> spoil;
};

/// Writes a case into a folder, draws and dumps its poses and lets the oracle judge them.
/// That happens in a process of its own, so that a crash is a result like any other.
[[nodiscard]] CaseResult judge_case(const AttackCase& attack_case, const JudgeOptions& options);

}  // namespace ridgeline::sim
