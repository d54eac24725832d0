#pragma once
#include <memory>
#include <string>
#include <vector>

#include "sim/bench/bench_row.hpp"
#include "sim/session/session.hpp"

namespace ridgeline::sim {

/// The oracle over one terrain folder, as a ruler: it measures errors, of methods that promise
/// something and of those that do not, all in the same way.
///
/// The error of a pixel is the radius of the smallest disc round its centre found to make it sound
/// (contract, section 2): backward error, so a silhouette that is half a pixel off is half a pixel
/// of error and not the depth between ridge and sky. Found with rings of 12 rays, each half as
/// large again as the last, then refined to 2 % or 0.002 px; at most what is found is too large.
class BenchJudge {
 public:
  /// Errors that no disc of this radius explains count as this. px
  static constexpr double largest_px = 64.0;

  /// With the folder, the geoid and the coverage list of the scene.
  /// Errors: oracle::InputError naming the file.
  explicit BenchJudge(const SceneOptions& scene);
  ~BenchJudge();
  BenchJudge(const BenchJudge&) = delete;
  BenchJudge& operator=(const BenchJudge&) = delete;

  /// From now on judges pictures of this view: `pixels` of them spread evenly, and a quarter as
  /// many more at depth jumps of `reference`, which count for the worst error alone.
  void begin_view(const Picture& reference, int pixels);
  /// Measures one picture of the view.
  [[nodiscard]] BenchError error_of(const Picture& picture);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ridgeline::sim
