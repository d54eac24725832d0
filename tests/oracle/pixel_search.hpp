#pragma once
#include <limits>
#include <vector>

#include "tests/oracle/camera.hpp"
#include "tests/oracle/tracer.hpp"

namespace ridgeline::oracle {

/// The three claims of soundness (contract, section 2), each proved by one ray of the disc.
enum Claim {
  claim_near,       ///< Z <= z (1 + slack)
  claim_far,        ///< Z >= z (1 - slack), sky counting as infinite
  claim_permitted,  ///< the class of z is allowed for this ray
  claim_count
};

/// Which claims one ray proves.
struct Claims {
  bool holds[claim_count] = {false, false, false};

  [[nodiscard]] bool all() const { return holds[0] && holds[1] && holds[2]; }
  [[nodiscard]] bool lacks_one_of(const Claims& other) const {
    return (other.holds[0] && !holds[0]) || (other.holds[1] && !holds[1]) ||
           (other.holds[2] && !holds[2]);
  }
  void join(const Claims& other) {
    for (int i = 0; i < claim_count; ++i) holds[i] = holds[i] || other.holds[i];
  }
};

/// What a ray proves about a pixel that shows `z`: a distance in m, +inf for sky, NaN for unknown.
[[nodiscard]] Claims claims_of(double z, const FirstHit& hit, double slack);

/// A unit vector of the image, turned. Units: rad.
[[nodiscard]] ImagePoint turned(const ImagePoint& unit, double angle_rad);
/// Its length, px.
[[nodiscard]] inline double size_of(const ImagePoint& offset) {
  return std::sqrt(offset.x * offset.x + offset.y * offset.y);
}

/// One ray of a search.
struct Sample {
  ImagePoint offset;
  double distance_m = 0;
};

/// Looks for rays that prove the claims of one pixel, as close to its centre as they can be found.
/// Every ray only ever adds a proof, so what is found is a disc that makes the pixel sound, and the
/// smallest one at most.
/// Units:  pixels, offsets from the pixel's centre.
/// Owner:  views the tracer and the camera.
class PixelSearch {
 public:
  /// `at_centre` is what the ray of the centre meets.
  PixelSearch(const Tracer& tracer, const Camera& camera, const ImagePoint& centre, double z,
              double slack, const FirstHit& at_centre);

  [[nodiscard]] bool done() const { return proved_[0] && proved_[1] && proved_[2]; }
  [[nodiscard]] bool proved(int claim) const { return proved_[claim]; }
  [[nodiscard]] Claims proofs() const { return {{proved_[0], proved_[1], proved_[2]}}; }
  /// The smallest disc known to make the pixel sound. Domain: done().
  [[nodiscard]] double radius_px() const;

  /// Traces one more ray; the distance it meets, m.
  double add(const ImagePoint& offset);

  /// Looks where the surface should cross the pixel's distance if the picture were a plane there:
  /// two rays beside the centre tell its slope. Finds nothing farther than `within_px`.
  void search_linearly(double probe_px, double within_px);
  /// One ray towards, away from and to both sides of the nadir at a radius. Nothing to do where
  /// that is known to be too large or too small.
  void search_cross(double radius_px);
  /// Where the radius is larger, points half a pixel apart as far as that. Crosses find a disc, not
  /// the smallest; whoever shows several pixels one ray has it at such a point.
  void search_within(double within_px);
  /// Looks closer to the centre, in several directions, until the radius is known to a share of
  /// itself or to a number of pixels. Domain: done().
  void refine(double share, double to_px);

  [[nodiscard]] const ImagePoint& centre() const { return centre_; }
  [[nodiscard]] const ImagePoint& down() const { return down_; }  ///< unit, towards the nadir
  [[nodiscard]] double z() const { return z_; }
  [[nodiscard]] double nearest_m() const { return nearest_m_; }
  [[nodiscard]] double farthest_m() const { return farthest_m_; }
  [[nodiscard]] const std::vector<Sample>& samples() const { return samples_; }  ///< rays so far
  /// Some ray passed unknown ground, so surfaces may end abruptly.
  [[nodiscard]] bool met_unknown() const { return met_unknown_; }

 private:
  [[nodiscard]] bool is_open_at(double radius_px) const;
  [[nodiscard]] bool is_smallest_within(int claim, double radius_px) const {
    return proved_[claim] && size_of(smallest_[claim]) <= radius_px * (1 + 1e-12);
  }

  const Tracer& tracer_;
  const Camera& camera_;
  ImagePoint centre_;
  ImagePoint down_;
  double z_;
  double slack_;
  double centre_m_;
  bool proved_[claim_count];
  ImagePoint smallest_[claim_count] = {};      ///< the closest ray that proves a claim
  double failed_px_[claim_count] = {0, 0, 0};  ///< no ray tried up to here proves it
  double nearest_m_;
  double farthest_m_;
  bool met_unknown_;
  std::vector<Sample> samples_;
};

}  // namespace ridgeline::oracle
