#pragma once
#include <memory>
#include <optional>
#include <string>

#include "sim/session/session.hpp"
#include "sim/synthetic/tile_writer.hpp"
#include "tests/oracle/verify.hpp"
#include "tests/support/temporary_folder.hpp"

namespace ridgeline::test {

struct Pose {
  GeodeticPosition eye;
  Attitude attitude;
};

/// A folder of tiles that a test writes for itself, and the heights it wrote.
class Land {
 public:
  /// Posts that `height_m` gives as NaN are void.
  explicit Land(sim::HeightFunction height_m) : height_m_(std::move(height_m)) {}

  /// Adds one tile of `posts` x `posts`; aborts the test program where it cannot be written.
  void add_tile(int south_deg, int west_deg, int posts = 1201) const;
  /// Adds one DTED level 1 tile.
  void add_dted(int south_deg, int west_deg) const;

  [[nodiscard]] const std::string& path() const { return folder_.path(); }
  /// Height of the bilinear surface between stored posts `step_deg` apart. NaN beside a void.
  [[nodiscard]] double ground_m(double latitude_deg, double longitude_deg, double latitude_step_deg,
                                double longitude_step_deg) const;
  [[nodiscard]] double ground_m(double latitude_deg, double longitude_deg) const {
    return ground_m(latitude_deg, longitude_deg, 1.0 / 1200, 1.0 / 1200);
  }

 private:
  TemporaryFolder folder_;
  sim::HeightFunction height_m_;
};

/// Steep mountains with single tall posts; continuous over the antimeridian. No voids.
double rough_m(double latitude_deg, double longitude_deg);
/// The same with void islands and single void posts.
double rough_with_voids_m(double latitude_deg, double longitude_deg);

/// One 3" tile of that land at 46 N 8 E.
class RoughTile : public Land {
 public:
  RoughTile() : Land(rough_with_voids_m) { add_tile(46, 8); }
};

/// A session over a land on the surfaceless context, and the dumps it leaves.
class Scene {
 public:
  Scene(const Land& land, const ImageGeometry& image, double error_px, double range_m,
        const GeodeticPosition& first);
  /// Over a folder of tiles that outlives the scene.
  Scene(const std::string& land_path, const ImageGeometry& image, double error_px, double range_m,
        const GeodeticPosition& first,
        sim::SceneOptions::Arrival arrival = sim::SceneOptions::Arrival::settled);

  /// The same with every option of a session; its terrain folder is that of the land.
  Scene(const Land& land, sim::SceneOptions options, const GeodeticPosition& first);

  [[nodiscard]] FrameSettings& settings() { return session_.settings(); }
  [[nodiscard]] sim::Session& session() { return session_; }
  sim::Picture draw(const Pose& pose, double time_s = 0);
  /// Draws and dumps one frame; the picture.
  sim::Picture shoot(const Pose& pose, double time_s = 0);
  /// The oracle's word on every frame shot so far.
  [[nodiscard]] oracle::VerifySummary judged(int pixels_per_frame) const;
  [[nodiscard]] const std::string& dump_path() const { return dumps_.path(); }

 private:
  TemporaryFolder dumps_;
  sim::SceneOptions options_;
  sim::Session session_;
  int shots_ = 0;
};

/// The frame is drawn in full (not removed) and the oracle finds no violation in it.
/// Fails the running test with the command that shows the same frame otherwise.
/// `may_lack_bound`: so many frames may be removed because no bound can be given.
void expect_sound(Scene& scene, const std::vector<Pose>& poses, int pixels_per_frame,
                  int may_lack_bound = 0);

/// Where a point on or over the Earth appears, by GeographicLib alone (pixels, centres at +1/2).
struct ImagePlace {
  double u_px = 0, v_px = 0, distance_m = 0;
  bool in_front = false;
};
ImagePlace image_place(const Pose& pose, const ImageGeometry& image, const GeodeticPosition& point);

}  // namespace ridgeline::test
