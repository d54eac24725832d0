#pragma once
#include <memory>
#include <string>

#include "sim/session/session.hpp"

namespace ridgeline::sim {

/// Error of one picture against the oracle's truth.
struct BenchError {
  double max_px = 0, mean_px = 0, p99_px = 0, percent_over_1px = 0;
  int wrong_class_pixels = 0;  ///< of those judged: sky, ground or unknown where it cannot be
  int judged = 0;
};

/// The oracle over one terrain folder.
class BenchJudge {
 public:
  /// With the folder, the geoid and the coverage list of the scene.
  /// Errors: oracle::InputError naming the file.
  explicit BenchJudge(const SceneOptions& scene);
  ~BenchJudge();
  BenchJudge(const BenchJudge&) = delete;
  BenchJudge& operator=(const BenchJudge&) = delete;
  /// Judges `pixels` pixels spread over the picture; the same ones for pictures of one size.
  [[nodiscard]] BenchError error_of(const Picture& picture, int pixels) const;

 private:
  struct Truth;
  std::unique_ptr<Truth> truth_;
};

}  // namespace ridgeline::sim
