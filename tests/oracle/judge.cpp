#include "tests/oracle/judge.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

namespace ridgeline::oracle {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The border of the disc belongs to it only as a limit.
constexpr double just_inside = 1 - 1e-9;

/// What a claim may lack and still be undecided (see Judge).
constexpr double hair_of_slack = 1.002;
constexpr double hair_of_radius = 1 + 2e-4;
constexpr double hair_of_radius_px = 1e-6;
constexpr double hair_of_place_px = 1e-6;

const char* const claim_names[claim_count] = {"near", "far", "class"};

/// Ways to relax a claim; several may be taken together.
enum Relaxed : unsigned {
  relaxed_range = 1,
  relaxed_slack = 2,
  relaxed_radius = 4,
  relaxed_all = 8
};

Doubt doubt_of(unsigned relaxed) {
  if (relaxed == relaxed_range) return Doubt::end_of_range;
  if (relaxed == relaxed_slack) return Doubt::slack_by_a_hair;
  if (relaxed == relaxed_radius) return Doubt::radius_by_a_hair;
  return Doubt::several_hairs;
}

}  // namespace

const char* name_of(Doubt doubt) {
  constexpr const char* names[] = {"none",
                                   "end_of_range",
                                   "slack_by_a_hair",
                                   "radius_by_a_hair",
                                   "several_hairs",
                                   "unknown_edge",
                                   "grazing",
                                   "search_ended",
                                   "completeness_at_end_of_range",
                                   "completeness_by_a_hair",
                                   "completeness_within_geometry"};
  static_assert(std::size(names) == doubt_count);
  return names[static_cast<std::size_t>(doubt)];
}

Judge::Judge(const Tracer& tracer, const Tracer& longer_tracer, const Frame& frame,
             bool strict_edge)
    : tracer_(tracer),
      longer_tracer_(longer_tracer),
      frame_(frame),
      camera_(frame),
      bound_px_(*frame.bound_px),
      strict_edge_(strict_edge) {}

void Judge::search_rings(PixelSearch& search, double from, double to, int rings, int rays) const {
  for (int ring = 0; ring < rings; ++ring) {
    const double radius = from + (to - from) * ring / std::max(1, rings - 1);
    for (int ray = 0; ray < rays; ++ray) {
      if (search.done()) return;
      // Every other ring is turned by half a step, so that rays do not line up.
      const double angle = 2 * pi * (ray + 0.5 * (ring % 2)) / rays;
      search.add(radius * turned(search.down(), angle));
    }
  }
}

void Judge::search_around_extremes(PixelSearch& search) const {
  // A larger disc holds more hills and hollows, any of which may be the one that counts.
  const auto starts = static_cast<std::size_t>(std::clamp(bound_px_, 2.0, 12.0));
  for (const int claim : {0, 1}) {
    std::vector<Sample> samples = search.samples();
    std::stable_sort(samples.begin(), samples.end(), [&](const Sample& a, const Sample& b) {
      return claim == 0 ? a.distance_m < b.distance_m : a.distance_m > b.distance_m;
    });
    std::vector<ImagePoint> tried;
    for (const Sample& sample : samples) {
      if (search.done() || search.proved(claim) || tried.size() == starts) break;
      const bool is_new = std::all_of(tried.begin(), tried.end(), [&](const ImagePoint& other) {
        return size_of(sample.offset + (-1.0) * other) > 0.15 * bound_px_;
      });
      if (!is_new) continue;
      tried.push_back(sample.offset);
      climb(search, sample, claim);
    }
  }
}

void Judge::climb(PixelSearch& search, Sample best, int claim) const {
  const double edge = bound_px_ * just_inside;
  int budget = 200;
  for (double step = 0.1 * bound_px_; step > 1e-4 * bound_px_;) {
    bool has_moved = false;
    for (int turn = 0; turn < 8; ++turn) {
      if (search.done() || search.proved(claim) || --budget < 0) return;
      ImagePoint offset = best.offset + step * turned(search.down(), 0.25 * pi * turn);
      if (size_of(offset) > edge) offset = (edge / size_of(offset)) * offset;
      const double distance_m = search.add(offset);
      if (claim == 0 ? distance_m < best.distance_m : distance_m > best.distance_m) {
        best = {offset, distance_m};
        has_moved = true;
      }
    }
    if (!has_moved) step *= 0.5;
  }
}

/// What one arc is searched with.
struct Judge::Arc {
  ImagePoint middle;        ///< unit, towards the middle of the arc
  double cap_m = 0;         ///< how far along the rays the surface matters
  double safe_cap_m = 0;    ///< the same, moved so that an exclusion holds for the whole disc
  double px_per_slope = 0;  ///< image distance that lifts a ray by one m per m
  double steepness = 0;     ///< px of clearance that one px along the arc can change at most
};

/// Decides whether a ray of the lower (near claim) or upper (far claim) arc of the disc proves it.
Judge::ArcResult Judge::search_arc(PixelSearch& search, bool upper) const {
  const Vec3 direction = camera_.direction(search.centre());
  const double sine = camera_.sine_above_level(direction);
  const double cosine = std::sqrt(std::max(0.0, 1 - sine * sine));
  Arc arc;
  arc.middle = upper ? (-1.0) * search.down() : search.down();
  const double step_px = 1e-3 * bound_px_;
  const Vec3 turned_ray = camera_.direction(search.centre() + step_px * arc.middle);
  const double turn_rad_per_px = length(turned_ray - direction) / step_px;
  const double disc_rad = 2 * bound_px_ * turn_rad_per_px;
  if (search.met_unknown() || cosine < 0.2 || disc_rad > 0.05) return ArcResult::not_applicable;
  // Rays of one vertical plane reach the same ground at distances that differ by this much.
  const double stretch = 1.1 * disc_rad * std::abs(sine) / cosine + 0.5 * disc_rad * disc_rad;
  if (search.z() == infinity) {
    arc.cap_m = arc.safe_cap_m = tracer_.range_m();
  } else {
    arc.cap_m = search.z() * (upper ? 1 - eta : 1 + eta);
    arc.safe_cap_m = arc.cap_m * (upper ? 1 - stretch : 1 + stretch);
  }
  arc.px_per_slope = cosine / turn_rad_per_px;
  arc.steepness = 1.05 * std::hypot(1.0, std::clamp(tracer_.terrain().steepest(), 1.0, 30.0));
  return halve_arc(search, upper, arc);
}

Judge::ArcResult Judge::halve_arc(PixelSearch& search, bool upper, const Arc& arc) const {
  struct Part {
    double from;
    double to;
  };
  constexpr int first_parts = 8;
  std::vector<Part> parts;
  parts.reserve(64);
  for (int i = 0; i < first_parts; ++i) {
    parts.push_back({pi * i / first_parts - pi / 2, pi * (i + 1) / first_parts - pi / 2});
  }
  const double ceiling = 2 * arc.steepness * bound_px_ / arc.px_per_slope;
  bool excluded_in_disc = true;
  int budget = 400;
  while (!parts.empty()) {
    const Part part = parts.back();
    parts.pop_back();
    const double angle = 0.5 * (part.from + part.to);
    const double reach_px = 0.5 * (part.to - part.from) * bound_px_;
    const ImagePoint offset = bound_px_ * just_inside * turned(arc.middle, angle);
    const Vec3 ray = camera_.direction(search.centre() + offset);
    // Seen from the claim: how far this ray is from proving it.
    const auto lacking_px = [&](double cap_m) {
      return (upper ? -1 : 1) * arc.px_per_slope * tracer_.clearance(ray, cap_m, ceiling);
    };
    if (lacking_px(arc.safe_cap_m) > arc.steepness * reach_px) continue;
    const double lacking = lacking_px(arc.cap_m);
    if (lacking > arc.steepness * reach_px) {
      excluded_in_disc = false;  // on the arc itself only
      continue;
    }
    if (lacking <= 0) {
      search.add(offset);
      if (search.proved(upper ? claim_far : claim_near)) return ArcResult::proved;
    }
    if (reach_px < 1e-4 * bound_px_) return ArcResult::grazing;
    if (--budget == 0) return ArcResult::ended;
    parts.push_back({part.from, angle});
    parts.push_back({angle, part.to});
  }
  return excluded_in_disc ? ArcResult::excluded : ArcResult::not_applicable;
}

Doubt Judge::search_hairs(PixelSearch& search) const {
  constexpr int rays = 96;
  const double hair = bound_px_ * hair_of_radius + hair_of_radius_px;
  const bool only_class = search.proved(claim_near) && search.proved(claim_far);
  Claims held[relaxed_all];
  for (Claims& claims : held) claims = search.proofs();
  for (const double radius : {hair, just_inside * bound_px_, 0.5 * bound_px_}) {
    for (int ray = 0; ray < rays; ++ray) {
      const ImagePoint offset = radius * turned(search.down(), 2 * pi * ray / rays);
      const FirstHit hit = longer_tracer_.first_hit(camera_.direction(search.centre() + offset));
      for (unsigned relaxed = 0; relaxed < relaxed_all; ++relaxed) {
        if ((relaxed & relaxed_radius) == 0 && radius > bound_px_) continue;
        // A surface at the very end of the display range may be seen or not.
        const bool moves_end = (relaxed & relaxed_range) != 0;
        const double moved_m = search.z() == infinity ? tracer_.range_m() * (1 - eta) : infinity;
        FirstHit seen = hit;
        if (hit.distance_m >= (moves_end ? moved_m : tracer_.range_m())) seen.distance_m = infinity;
        const double slack = (relaxed & relaxed_slack) != 0 ? hair_of_slack * eta : eta;
        const Claims claims = claims_of(search.z(), seen, slack);
        if (relaxed == 0 && search.proofs().lacks_one_of(claims)) search.add(offset);
        held[relaxed].join(claims);
      }
      if (search.done()) return Doubt::none;
    }
  }
  for (const unsigned relaxed : {1U, 2U, 4U, 3U, 5U, 6U, 7U}) {
    if (held[relaxed].all()) return only_class ? Doubt::unknown_edge : doubt_of(relaxed);
  }
  return Doubt::none;
}

Doubt Judge::search_whole_disc(PixelSearch& search) const {
  bool excluded = false;
  Doubt doubt = Doubt::none;
  for (const int claim : {claim_near, claim_far}) {
    if (search.proved(claim)) continue;
    const ArcResult result = search_arc(search, claim == claim_far);
    excluded = excluded || result == ArcResult::excluded;
    if (result == ArcResult::grazing) doubt = Doubt::grazing;
    if (result == ArcResult::ended) doubt = Doubt::search_ended;
  }
  if (!search.done() && !excluded) {
    search_rings(search, bound_px_ * just_inside, 0.1 * bound_px_, 7, 56);
    search_around_extremes(search);
  }
  if (search.done()) return Doubt::none;
  const Doubt by_a_hair = search_hairs(search);
  if (search.done() || by_a_hair != Doubt::none) return by_a_hair;
  return excluded ? Doubt::none : doubt;
}

void Judge::judge_soundness(double z, const ImagePoint& centre, bool measure,
                            Judgement& judgement) const {
  if (claims_of(z, judgement.centre, eta).all()) return;
  PixelSearch search(tracer_, camera_, centre, z, eta, judgement.centre);
  if (!measure) {  // the lowest and the highest ray of the disc are nearly always enough
    for (const double part : {just_inside, -just_inside}) {
      search.add(part * bound_px_ * search.down());
    }
    if (search.done()) return;
  }
  search.search_linearly(0.01 * bound_px_, bound_px_ * just_inside);
  for (const double part : {1.0 / 64, 1.0 / 16, 0.125, 0.25, 0.5, 0.75, just_inside}) {
    search.search_cross(part * bound_px_);
  }
  if (!search.done()) judgement.doubt = search_whole_disc(search);
  const double accuracy_px = std::min(0.01 * bound_px_, 0.002);
  if (search.done()) {
    search.refine(0, accuracy_px);
    if (frame_.proven_px) search.search_within(*frame_.proven_px);
    judgement.error_px = search.radius_px();
    return;
  }
  judgement.soundness = judgement.doubt == Doubt::none ? Verdict::violated : Verdict::undecided;
  for (int i = 0; i < claim_count; ++i) {
    if (search.proved(i)) continue;
    judgement.fault += std::string(judgement.fault.empty() ? "" : ", ") +
                       "no ray of the disc for " + claim_names[i] + " claim (truth " +
                       std::to_string(search.nearest_m()) + " to " +
                       std::to_string(search.farthest_m()) + " m)";
  }
  search_rings(search, 1.125 * bound_px_, 4 * bound_px_, 10, 12);
  judgement.error_is_larger = !search.done();
  judgement.error_px = search.done() ? search.radius_px() : 4 * bound_px_;
}

void Judge::measure_without_slack(double z, const ImagePoint& centre, Judgement& judgement) const {
  judgement.error_without_slack_px = 0;
  if (claims_of(z, judgement.centre, stored_slack).all()) return;
  judgement.error_without_slack_px = bound_px_;
  judgement.error_without_slack_is_larger = true;
  if (judgement.soundness != Verdict::holds) return;
  PixelSearch search(tracer_, camera_, centre, z, stored_slack, judgement.centre);
  search.search_linearly(std::min(1e-3, 0.1 * bound_px_), bound_px_ * just_inside);
  for (double radius = 1e-5; radius < bound_px_; radius *= 4) search.search_cross(radius);
  search.search_cross(bound_px_ * just_inside);
  if (!search.done()) return;
  search.refine(0.03, 1e-6);
  judgement.error_without_slack_is_larger = false;
  judgement.error_without_slack_px = search.radius_px();
  // What proves the claims without slack proves them with it.
  judgement.error_px = std::min(judgement.error_px, search.radius_px());
}

/// Calls `take(u, v)` for the pixels within the bound + 1/sqrt(2), in the image or not, until it
/// returns true. The pixel of the point itself comes first: it is nearly always enough.
template <class Take>
void Judge::for_each_pixel_around(const ImagePoint& point, const Take& take) const {
  const double radius = bound_px_ + std::sqrt(0.5) + 1e-9;
  const auto is_near = [&](int u, int v) {
    return size_of(ImagePoint{u + 0.5, v + 0.5} + (-1.0) * point) <= radius;
  };
  const int own_u = static_cast<int>(std::floor(point.x));
  const int own_v = static_cast<int>(std::floor(point.y));
  if (is_near(own_u, own_v) && take(own_u, own_v)) return;
  for (int v = static_cast<int>(std::floor(point.y - radius)); v <= point.y + radius; ++v) {
    for (int u = static_cast<int>(std::floor(point.x - radius)); u <= point.x + radius; ++u) {
      if (is_near(u, v) && take(u, v)) return;
    }
  }
}

Judge::Bracket Judge::bracket(const ImagePoint& point, const FirstHit& hit) const {
  bool below = false;
  bool above = false;
  bool meets_unknown = false;
  bool meets_edge = false;
  const auto join = [&](double z) {
    below = below || z * (1 - eta) <= hit.distance_m;
    above = above || z * (1 + eta) >= hit.distance_m;
    return below && above;
  };
  const auto is_inside = [&](int u, int v) {
    return u >= 0 && v >= 0 && u < frame_.width && v < frame_.height;
  };
  for_each_pixel_around(point, [&](int u, int v) {
    if (!is_inside(u, v)) {
      meets_edge = true;
      return false;
    }
    meets_unknown = meets_unknown || std::isnan(frame_.z(u, v));
    return join(frame_.z(u, v));
  });
  if (below && above) return Bracket::by_known;
  if (meets_unknown && hit.may_be_unknown) return Bracket::by_unknown;
  if (meets_unknown) {
    // An unknown pixel counts as the truth of its own ray, where that may be unknown.
    for_each_pixel_around(point, [&](int u, int v) {
      if (!is_inside(u, v) || !std::isnan(frame_.z(u, v))) return false;
      const FirstHit hidden = tracer_.first_hit(camera_.direction({u + 0.5, v + 0.5}));
      return hidden.may_be_unknown && join(hidden.distance_m);
    });
    if (below && above) return Bracket::by_unknown;
  }
  if (!meets_edge || strict_edge_) return Bracket::none;
  for_each_pixel_around(point, [&](int u, int v) {
    if (is_inside(u, v)) return false;
    return join(tracer_.first_hit(camera_.direction({u + 0.5, v + 0.5})).distance_m);
  });
  return below && above ? Bracket::by_edge : Bracket::none;
}

bool Judge::is_complete_within(const ImagePoint& point, double radius_px) const {
  constexpr int rays = 16, rings = 6;
  double nearest_m = infinity, farthest_m = 0;
  bool may_be_unknown = false;
  for (int ring = 0; ring < rings; ++ring) {
    for (int ray = 0; ray < rays; ++ray) {
      const double angle = 2 * pi * (ray + 0.5 * (ring % 2)) / rays;
      const double radius = std::ldexp(radius_px, -ring);
      const ImagePoint beside = point + radius * ImagePoint{std::cos(angle), std::sin(angle)};
      const FirstHit hit = tracer_.first_hit(camera_.direction(beside));
      nearest_m = std::min(nearest_m, hit.distance_m);
      farthest_m = std::max(farthest_m, hit.distance_m);
      may_be_unknown = may_be_unknown || hit.may_be_unknown;
    }
  }
  bool below = false, above = false;
  for_each_pixel_around(point, [&](int u, int v) {
    const bool is_inside = u >= 0 && v >= 0 && u < frame_.width && v < frame_.height;
    if (!is_inside && strict_edge_) return false;
    double z = is_inside ? frame_.z(u, v) : infinity;
    if (!is_inside || std::isnan(z)) {
      const FirstHit truth = tracer_.first_hit(camera_.direction({u + 0.5, v + 0.5}));
      if (is_inside && !may_be_unknown && !truth.may_be_unknown) return false;
      below = below || (is_inside && may_be_unknown);
      above = above || (is_inside && may_be_unknown);
      z = truth.distance_m;
    }
    below = below || z * (1 - eta) <= farthest_m;
    above = above || z * (1 + eta) >= nearest_m;
    return below && above;
  });
  return below && above;
}

Doubt Judge::completeness_by_a_hair(const ImagePoint& point, const FirstHit& hit) const {
  if (hit.is_sky() || hit.distance_m >= tracer_.range_m() * (1 - eta)) {
    // At the very end of the display range a surface may be seen or not.
    FirstHit other = longer_tracer_.first_hit(camera_.direction(point));
    if (other.distance_m < infinity) {
      if (!hit.is_sky()) other.distance_m = infinity;
      if (bracket(point, other) != Bracket::none) return Doubt::completeness_at_end_of_range;
    }
  }
  for (const ImagePoint& step :
       {ImagePoint{hair_of_place_px, 0}, ImagePoint{-hair_of_place_px, 0},
        ImagePoint{0, hair_of_place_px}, ImagePoint{0, -hair_of_place_px}}) {
    const ImagePoint beside = point + step;
    if (bracket(beside, tracer_.first_hit(camera_.direction(beside))) != Bracket::none) {
      return Doubt::completeness_by_a_hair;
    }
  }
  // What the frame says that rounding may move; never more than a tenth of a pixel of it.
  const double geometry_px = std::min(frame_.geometry_px.value_or(0.0), 0.1);
  if (geometry_px > 0 && is_complete_within(point, geometry_px)) {
    return Doubt::completeness_within_geometry;
  }
  return Doubt::none;
}

void Judge::judge_completeness(const ImagePoint& centre, double z, Judgement& judgement) const {
  const Bracket found = bracket(centre, judgement.centre);
  judgement.leans_on_unknown = found == Bracket::by_unknown && !std::isnan(z);
  judgement.leans_on_edge = found == Bracket::by_edge;
  if (found != Bracket::none) return;
  const Doubt doubt = completeness_by_a_hair(centre, judgement.centre);
  judgement.completeness = doubt == Doubt::none ? Verdict::violated : Verdict::undecided;
  if (judgement.doubt == Doubt::none) judgement.doubt = doubt;
  judgement.fault += std::string(judgement.fault.empty() ? "" : ", ") +
                     "what is at its centre is not between the pixels around";
}

Judgement Judge::judge(const Question& question) const {
  Judgement judgement;
  const ImagePoint centre{question.u + 0.5, question.v + 0.5};
  const double z = frame_.z(question.u, question.v);
  judgement.centre = tracer_.first_hit(camera_.direction(centre));
  judge_soundness(z, centre, question.error, judgement);
  judge_completeness(centre, z, judgement);
  if (question.between) {
    const ImagePoint point = centre + *question.between;
    judgement.off_centre = tracer_.first_hit(camera_.direction(point));
    judgement.missed_between_centres = bracket(point, judgement.off_centre) == Bracket::none;
  }
  if (question.without_slack) measure_without_slack(z, centre, judgement);
  return judgement;
}

}  // namespace ridgeline::oracle
