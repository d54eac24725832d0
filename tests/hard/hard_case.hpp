#pragma once
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tests/gl/scene.hpp"
#include "tests/hard/patch.hpp"

namespace ridgeline::test {

/// Odd sizes: the middle pixel's ray is the axis of the camera.
inline constexpr ImageGeometry hard_image{129, 97, 60};

/// How a land is looked at.
struct StageOptions {
  ImageGeometry image = hard_image;
  double range_m = 12'000;
  double error_px = 1;
  double gpu_bytes = limits::terrain_gpu_bytes;  ///< most the terrain window may take
  sim::SceneOptions::Arrival arrival = sim::SceneOptions::Arrival::settled;
};

/// What a window of several levels takes where one level would take more. Units: bytes.
inline constexpr double few_bytes = 1.1 * 1024 * 1024;

/// A land in a session. One at a time: a session draws in the context that was made last.
/// Owner: views the land.
struct Stage {
  Stage(const Land& over, const StageOptions& options, const GeodeticPosition& first);
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  [[nodiscard]] int levels() { return scene.session().window().levels; }

  const Land& land;
  ImageGeometry image;
  Scene scene;
};

/// One drawn frame.
struct Shot {
  Pose pose;
  ImageGeometry image;
  sim::Picture picture;

  [[nodiscard]] bool drawn() const { return picture.report.availability.mode != Mode::removed; }
  [[nodiscard]] bool says(Reason reason) const;
  /// What pixel (u, v) shows: m, +inf sky, NaN unknown. Only of a drawn frame.
  [[nodiscard]] double range_m(int u, int v) const;
  /// The same of the pixel that holds a point of space.
  [[nodiscard]] double range_m(const GeodeticPosition& point) const;
  [[nodiscard]] double middle_m() const { return range_m(image.width_px / 2, image.height_px / 2); }
  [[nodiscard]] ImagePlace place(const GeodeticPosition& point) const {
    return image_place(pose, image, point);
  }
};

/// The attitude without roll that puts a point into the middle of the picture.
Attitude aimed(const GeodeticPosition& eye, const GeodeticPosition& point);

/// What frames of a case say of themselves.
struct Promise {
  /// The plain picture with the bound that was asked for.
  static Promise plain(double bound_px = 1) { return {Mode::svs, {}, bound_px}; }
  /// Drawn, where asked for less than it can have with a bound of at most `most_px`, or over a part
  /// of the range where all of it has no bound.
  static Promise bound_up_to(double most_px) { return {Mode::degraded, {}, most_px}; }
  /// The same, or removed for want of a bound.
  static Promise if_bounded() { return {Mode::removed, {}, limits::max_error_px}; }
  /// Drawn; a shorter range than asked for is allowed, a larger bound up to `most_px` as well.
  static Promise shorter_range(double most_px = 1) {
    return {Mode::degraded, Reason::range_reduced, most_px};
  }
  /// While terrain is on its way: drawn with whatever bound and range there is, or not at all.
  static Promise while_loading() { return {Mode::removed, {}, limits::max_error_px}; }
  static Promise removed(Reason reason) { return {Mode::removed, reason, 0}; }

  Mode worst = Mode::svs;
  std::optional<Reason> reason;  ///< that a frame worse than plain gives
  double most_px = 1;            ///< the largest bound

  [[nodiscard]] std::string text() const;
};

/// 3" posts from 46 N 8 E, 361 x 481 of them: mountains with spires of 400 m.
const Patch& rough_land();
/// The same size from 33 S 70 W: hills a kilometre wide, posts off them by up to 12 m.
const Patch& hilly_land();

/// Calls use(stage, land, promise) with a rough land in a window of one level, then with a hilly
/// one in a window of several.
template <typename Use>
void in_both_windows(StageOptions options, const Use& use) {
  {
    Stage one(rough_land(), options, rough_land().over(180, 240, 500));
    EXPECT_EQ(one.levels(), 1);
    use(one, rough_land(), Promise::plain(options.error_px));
  }
  options.gpu_bytes = few_bytes;
  Stage several(hilly_land(), options, hilly_land().over(180, 240, 500));
  EXPECT_GE(several.levels(), 3);
  use(several, hilly_land(), Promise::bound_up_to(limits::max_error_px));
}

/// One case of the catalogue. A test says why the case is hard, draws, and asserts what is its own;
/// the fixture checks what every frame promises and lets the oracle judge every pixel of every
/// frame. RL_HARD_TABLE=FILE adds a row of Markdown to FILE.
class HardCase : public testing::Test {
 protected:
  void TearDown() override;

  /// What could go wrong, and why this scene would show it.
  void why(std::string text) { why_ = std::move(text); }
  /// What the test itself asserted, for the table.
  void also(std::string text) { also_ = std::move(text); }
  /// A land of this test's own; it stays until the frames over it are judged.
  const Patch& made(const PatchShape& shape, PatchHeight height_m,
                    std::vector<PatchPart> parts = {});
  /// Draws a frame that will be judged, and checks it against the promise.
  Shot shoot(Stage& stage, const Pose& pose, const Promise& promise);
  /// Judges so many pixels of a frame instead of all: where the oracle is slow, as round a pole.
  void judge_only(int pixels_per_frame) { pixels_per_frame_ = pixels_per_frame; }
  /// So many pixels may be complete only within the frame's own geometry error (docs/adr/0014).
  void may_be_within_geometry(std::size_t pixels) { most_undecided_ = pixels; }

 private:
  void write_row(const oracle::VerifySummary& summary) const;

  std::string why_, also_;
  std::vector<std::unique_ptr<Patch>> lands_;
  std::map<const Land*, std::unique_ptr<TemporaryFolder>> dumps_;
  std::map<const Land*, int> shots_;
  std::vector<std::string> poses_;
  std::map<std::string, int> modes_;  ///< frames by mode and reasons
  std::set<std::string> promises_;
  int pixels_per_frame_ = 1 << 20;
  std::size_t most_undecided_ = 0;
  std::size_t pixels_ = 0;  ///< to be judged, of all drawn frames
  double least_px_ = 1e9, most_px_ = 0;
};

}  // namespace ridgeline::test
