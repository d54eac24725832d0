#pragma once
#include <string>

#include "tests/oracle/camera.hpp"
#include "tests/oracle/dump.hpp"
#include "tests/oracle/tracer.hpp"

namespace ridgeline::oracle {

/// The relative slack along the ray (contract, section 2).
inline constexpr double eta = 1e-4;

/// What the oracle says of one claim. `undecided` is kept for claims that fail by no more than a
/// hair (see Judge), and for searches that end without a hit and without a proof that there is
/// none.
enum class Verdict { holds, undecided, violated };

struct Judgement {
  Verdict soundness = Verdict::holds;
  Verdict completeness = Verdict::holds;
  /// Completeness at the second point, which no frame of one sample a pixel can promise.
  bool missed_between_centres = false;
  /// The radius of the smallest disc found that makes the pixel sound; at most four bounds.
  double error_px = 0;
  bool error_is_larger = false;  ///< no disc of four bounds does
  FirstHit centre;               ///< the truth at the pixel's centre
  FirstHit off_centre;           ///< the truth at the second point tested for completeness
  std::string fault;             ///< what failed, empty when all holds
};

/// Decides the promise of contract.md section 2 at pixels of one frame.
///
/// Soundness asks for rays in the disc of radius `bound_px`. Few are needed where the pixel is
/// right: the centre, then crosses of growing radius along the image of the vertical. Where they
/// fail, the surface itself is asked: over one vertical plane the lowest ray of the disc hits first
/// and the highest last, so only the lower and the upper arc matter, and along an arc the clearance
/// over the terrain cannot change faster than the steepest slope allows. Halving the arc until each
/// part either holds a hit or is too clear (or too deep) to hold one decides the claim. Where this
/// argument does not apply (near the nadir, beside unknown ground) some 500 rays and climbs from
/// the best of them to the nearest hills and hollows decide; where it ends within a thousandth of a
/// pixel of the surface without a ray that proves the claim, the claim is undecided.
///
/// A claim that fails, but holds with a disc larger by 0.2 % + 1e-4 px, with a slack of 1.02 eta,
/// or with the end of the display range moved by eta, is undecided: the failure is within the
/// rounding of what the dump can say.
///
/// Completeness is asked at the centre, and for information at one more point of the pixel: even a
/// frame of exact rays through the centres misses extremes that lie between four of them, so the
/// promise, which speaks of pixels, is read as one about their centres. Pixels beyond the edge of
/// the image count as drawn exactly. An unknown pixel may hide anything behind unknown ground:
/// it serves as both ends of the interval where the ray at the point *may* be unknown.
/// Owner:  views all three arguments.
class Judge {
 public:
  Judge(const Tracer& tracer, const Tracer& longer_tracer, const Frame& frame);

  /// Units: pixels; `offset` from the pixel's centre, each coordinate in [-1/2, 1/2].
  [[nodiscard]] Judgement judge(int u, int v, const ImagePoint& offset) const;

 private:
  /// One ray of a search.
  struct Sample {
    ImagePoint offset;
    double distance_m = 0;
  };
  struct Search;
  struct Arc;
  enum class ArcResult { proved, excluded, grazing, not_applicable };

  void judge_soundness(int u, int v, Judgement& judgement) const;
  void search_small_crosses(Search& search) const;
  void search_rings(Search& search, double from, double to, int rings, int rays) const;
  void search_around_extremes(Search& search) const;
  void climb(Search& search, Sample best, int claim) const;
  void refine_error(Search& search) const;
  [[nodiscard]] ArcResult search_arc(Search& search, bool upper) const;
  [[nodiscard]] ArcResult halve_arc(Search& search, bool upper, const Arc& arc) const;
  [[nodiscard]] bool holds_by_a_hair(const Search& search) const;
  double add(Search& search, const ImagePoint& offset) const;
  [[nodiscard]] Verdict completeness(const ImagePoint& point, const FirstHit& hit) const;
  [[nodiscard]] bool is_between_neighbours(const ImagePoint& point, const FirstHit& hit) const;

  const Tracer& tracer_;
  const Tracer& longer_tracer_;
  const Frame& frame_;
  Camera camera_;
  double bound_px_;
};

}  // namespace ridgeline::oracle
