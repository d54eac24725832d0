#pragma once
#include <memory>
#include <string>
#include <vector>

#include "sim/session/session.hpp"

namespace ridgeline::test {

/// A part of a picture, every `step`-th pixel of it both ways.
struct PixelSet {
  int left = 0, top = 0, right = 0, bottom = 0;  ///< ends excluded
  int step = 1;
};

/// What the oracle says of one pixel whose picture claims an error of at most `claim_px`.
struct JudgedPixel {
  int u = 0, v = 0;
  bool unsound = false;     ///< what it shows is nowhere within the claim
  bool incomplete = false;  ///< what is truly there is not shown within the claim
  /// Smallest disc that makes it sound; at most `most_px` (then it may be larger).
  double error_px = 0;
};

/// Sums of what was judged.
struct JudgedPicture {
  std::vector<JudgedPixel> pixels;
  double claim_px = 0;

  [[nodiscard]] int unsound() const;
  [[nodiscard]] int incomplete() const;
  /// Share of pixels whose error is above `error_px`, %.
  [[nodiscard]] double percent_over(double error_px) const;
  [[nodiscard]] double mean_px() const;
  [[nodiscard]] double max_px() const;
};

/// The oracle over a folder of tiles, for pictures of methods that promise nothing of their own.
class MethodJudge {
 public:
  explicit MethodJudge(const std::string& terrain_folder);
  ~MethodJudge();
  MethodJudge(const MethodJudge&) = delete;
  MethodJudge& operator=(const MethodJudge&) = delete;

  /// Judges a picture against a claim; errors are measured up to `most_px`.
  [[nodiscard]] JudgedPicture judge(const sim::Picture& picture, const PixelSet& set,
                                    double claim_px, double most_px = 64) const;

 private:
  struct Truth;
  std::unique_ptr<Truth> truth_;
};

}  // namespace ridgeline::test
