#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "tests/gl/scene.hpp"
#include "tests/methods/method_judge.hpp"

namespace ridgeline::test {

/// A session over a land that draws with any method of the table, and the oracle over the land.
class MethodStand {
 public:
  MethodStand(const Land& land, const ImageGeometry& image, double range_m,
              const GeodeticPosition& first);

  /// `spec`: as on the command line. Fails the running test where it is wrong.
  sim::Method& use(const std::string& spec);
  /// A method that the table does not have.
  sim::Method& use(std::unique_ptr<sim::Method> method);
  /// The module's own passes again.
  /// With a bound for which every pixel has a ray of its own.
  void use_ours() {
    scene_.session().use(nullptr);
    scene_.settings().error_px = 0.4;
  }

  /// One frame that is not removed.
  sim::Picture draw(const Pose& pose);
  /// Every third pixel both ways, against a claim of `claim_px`.
  [[nodiscard]] JudgedPicture judge(const sim::Picture& picture, double claim_px = 1) const;

 private:
  ImageGeometry image_;
  Scene scene_;
  MethodJudge judge_;
};

/// The picture's distances as bits.
std::vector<std::uint32_t> bits_of(const sim::Picture& picture);
/// Every pixel is unknown, sky or within the range.
void expect_all_written(const sim::Picture& picture, double range_m);

/// Pixels of a picture of ours, and how many of them another picture shows as another kind.
struct UnknownCount {
  int unknown = 0;  ///< of ours
  int lost = 0;     ///< unknown in ours, not in the other
  int invented = 0;
};
UnknownCount count_unknown(const sim::Picture& ours, const sim::Picture& other);

/// Hills without steps or voids, some kilometres from top to top, 200..800 m.
double smooth_m(double latitude_deg, double longitude_deg);
/// A gentle plain at 300 m with one void 4 km across at 46.5 N 8.5 E.
double plain_with_hole_m(double latitude_deg, double longitude_deg);

}  // namespace ridgeline::test
