#pragma once
#include <cstddef>
#include <optional>
#include <string>

#include "tests/oracle/camera.hpp"
#include "tests/oracle/dump.hpp"
#include "tests/oracle/pixel_search.hpp"
#include "tests/oracle/tracer.hpp"

namespace ridgeline::oracle {

/// The relative slack along the ray (contract, section 2).
inline constexpr double eta = 1e-4;
/// What takes its place where an error is measured without slack: 16 roundings of a stored float32.
inline constexpr double stored_slack = 1e-6;

/// What the oracle says of one claim. `undecided` is kept for claims that fail by no more than a
/// hair (see Judge), and for searches that end without a hit and without a proof that there is
/// none.
enum class Verdict { holds, undecided, violated };

/// Why a claim is undecided.
enum class Doubt {
  none,
  end_of_range,     ///< sound if the end of the display range is moved by eta
  slack_by_a_hair,  ///< sound with 1.002 eta
  radius_by_a_hair,
  several_hairs,  ///< sound with more than one of the three
  unknown_edge,   ///< the class alone holds by a hair: the border of unknown ground is that close
  grazing,        ///< the arc search came within 1e-4 of the disc to the surface, and not to it
  search_ended,   ///< the arc search was cut short
  completeness_at_end_of_range,
  completeness_by_a_hair,       ///< complete for a point 1e-6 px from the pixel's centre
  completeness_within_geometry  ///< and for the rays within the frame's own `geometry_px` of it
};
inline constexpr std::size_t doubt_count = 11;
/// The enumerator's own name.
[[nodiscard]] const char* name_of(Doubt doubt);

struct Judgement {
  Verdict soundness = Verdict::holds;
  Verdict completeness = Verdict::holds;
  Doubt doubt = Doubt::none;  ///< the first reason why one of them is undecided
  /// Completeness at the second point, which no frame of one sample a pixel can promise.
  bool missed_between_centres = false;
  /// Complete only because an unknown pixel around may hide what is behind unknown ground, though
  /// the pixel itself shows something known.
  bool leans_on_unknown = false;
  /// Complete only because pixels beyond the edge of the image count as drawn exactly.
  bool leans_on_edge = false;
  /// The actual error: the radius of the smallest disc found that makes the pixel sound; at most
  /// four bounds. Known to a hundredth of the bound or 0.002 px, whichever is smaller.
  double error_px = 0;
  bool error_is_larger = false;  ///< no disc of four bounds does
  /// The same with `stored_slack` in place of eta, where it was asked for; one bound where the
  /// disc of the bound does not make it sound (`error_without_slack_is_larger`). Known to 3 %.
  std::optional<double> error_without_slack_px;
  bool error_without_slack_is_larger = false;
  FirstHit centre;      ///< the truth at the pixel's centre
  FirstHit off_centre;  ///< the truth at the second point, if there is one
  std::string fault;    ///< what failed, empty when all holds
};

/// One pixel, and what to find out about it besides the promise itself.
struct Question {
  int u = 0;
  int v = 0;
  /// A second point of the pixel to ask for completeness: from its centre, each coordinate in
  /// [-1/2, 1/2].
  std::optional<ImagePoint> between;
  bool without_slack = false;  ///< measure the error without slack as well
  bool error = true;           ///< measure the error; else only decide whether the pixel is sound
};

/// Decides the promise of contract.md section 2 at pixels of one frame.
///
/// Soundness asks for rays in the disc of radius `bound_px`. Few are needed where the pixel is
/// right: the centre, then where the surface should be if it were a plane, then crosses of growing
/// radius along the image of the vertical. Where they fail, the surface itself is asked: over one
/// vertical plane the lowest ray of the disc hits first and the highest last, so only the lower and
/// the upper arc matter, and along an arc the clearance over the terrain cannot change faster than
/// the steepest slope allows. Halving the arc until each part either holds a hit or is too clear
/// (or too deep) to hold one decides the claim. Where this argument does not apply (near the nadir,
/// beside unknown ground) some 500 rays and climbs from the best of them to the nearest hills and
/// hollows decide; where it ends within 1e-4 of the disc of the surface without a ray that proves
/// the claim, the claim is undecided.
///
/// A claim that fails, but holds with a disc larger by 2e-4 of itself + 1e-6 px, with a slack of
/// 1.002 eta (three roundings of a stored float32), or with the end of the display range moved by
/// eta, is undecided: the failure is within the rounding of what the dump can say.
///
/// Completeness is asked at the centre, with the slack eta along the ray, and for information at
/// one more point of the pixel: even a frame of exact rays through the centres misses extremes that
/// lie between four of them, so the promise, which speaks of pixels, is read as one about their
/// centres. An unknown pixel may hide anything behind unknown ground: it serves as both ends of the
/// interval where the ray at the point *may* be unknown, and counts as the truth of its own ray
/// where that may. Pixels beyond the edge of the image count as drawn exactly, unless the edge is
/// strict: what truly stands in the last row may be nearer than anything a picture with any error
/// at all shows there, so without them no bound but 0 would do. How often either of these two rules
/// decides is counted. Owner:  views all three arguments.
class Judge {
 public:
  /// With `strict_edge` only pixels of the image count, to the letter of the contract.
  Judge(const Tracer& tracer, const Tracer& longer_tracer, const Frame& frame,
        bool strict_edge = false);

  [[nodiscard]] Judgement judge(const Question& question) const;

 private:
  struct Arc;
  enum class ArcResult { proved, excluded, grazing, ended, not_applicable };
  /// What the truth at a point lies between.
  enum class Bracket { none, by_edge, by_unknown, by_known };

  void judge_soundness(double z, const ImagePoint& centre, bool measure,
                       Judgement& judgement) const;
  [[nodiscard]] Doubt search_whole_disc(PixelSearch& search) const;
  void search_rings(PixelSearch& search, double from, double to, int rings, int rays) const;
  void search_around_extremes(PixelSearch& search) const;
  void climb(PixelSearch& search, Sample best, int claim) const;
  [[nodiscard]] ArcResult search_arc(PixelSearch& search, bool upper) const;
  [[nodiscard]] ArcResult halve_arc(PixelSearch& search, bool upper, const Arc& arc) const;
  [[nodiscard]] Doubt search_hairs(PixelSearch& search) const;
  void measure_without_slack(double z, const ImagePoint& centre, Judgement& judgement) const;

  void judge_completeness(const ImagePoint& centre, double z, Judgement& judgement) const;
  /// Whether the truth over a small disc, from its nearest to its farthest ray, meets the interval
  /// of the pixels around (docs/adr/0014).
  [[nodiscard]] bool is_complete_within(const ImagePoint& point, double radius_px) const;
  [[nodiscard]] Doubt completeness_by_a_hair(const ImagePoint& point, const FirstHit& hit) const;
  template <class Take>
  void for_each_pixel_around(const ImagePoint& point, const Take& take) const;
  [[nodiscard]] Bracket bracket(const ImagePoint& point, const FirstHit& hit) const;

  const Tracer& tracer_;
  const Tracer& longer_tracer_;
  const Frame& frame_;
  Camera camera_;
  double bound_px_;
  bool strict_edge_;
};

}  // namespace ridgeline::oracle
