#include "tests/oracle/judge.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ridgeline::oracle {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Which of the three claims of soundness one ray proves.
struct Claims {
  bool near = false;       ///< Z <= z (1 + eta)
  bool far = false;        ///< Z >= z (1 - eta), sky counting as infinite
  bool permitted = false;  ///< the class of z is allowed for this ray
};

Claims claims_of(double z, const FirstHit& hit, double slack) {
  if (std::isnan(z)) return {true, true, hit.may_be_unknown};
  if (z == infinity) return {true, hit.is_sky() && !hit.must_be_unknown, true};
  return {hit.distance_m <= z * (1 + slack), hit.distance_m >= z * (1 - slack),
          !hit.must_be_unknown};
}

ImagePoint turned(const ImagePoint& unit, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * unit.x - s * unit.y, s * unit.x + c * unit.y};
}

double size_of(const ImagePoint& offset) {
  return std::hypot(offset.x, offset.y);
}

const char* const class_names[] = {"near", "far", "class"};

}  // namespace

/// The state of one pixel's search. `smallest[i]` is the offset of the closest ray that proves
/// claim i (near, far, permitted).
struct Judge::Search {
  ImagePoint centre;
  ImagePoint down;  ///< unit, towards the nadir
  double z = 0;
  bool proved[3] = {false, false, false};
  ImagePoint smallest[3] = {};
  double nearest_m = infinity;
  double farthest_m = 0;
  std::vector<Sample> samples;  ///< every ray so far
  bool met_unknown = false;     ///< some ray passed unknown ground, so surfaces may end abruptly

  [[nodiscard]] bool done() const { return proved[0] && proved[1] && proved[2]; }
  [[nodiscard]] double radius_px() const {
    return std::max({size_of(smallest[0]), size_of(smallest[1]), size_of(smallest[2])});
  }
};

Judge::Judge(const Tracer& tracer, const Tracer& longer_tracer, const Frame& frame)
    : tracer_(tracer),
      longer_tracer_(longer_tracer),
      frame_(frame),
      camera_(frame),
      bound_px_(*frame.bound_px) {}

double Judge::add(Search& search, const ImagePoint& offset) const {
  const FirstHit hit = tracer_.first_hit(camera_.direction(search.centre + offset));
  search.samples.push_back({offset, hit.distance_m});
  search.nearest_m = std::min(search.nearest_m, hit.distance_m);
  search.farthest_m = std::max(search.farthest_m, hit.distance_m);
  search.met_unknown = search.met_unknown || hit.may_be_unknown;
  const Claims claims = claims_of(search.z, hit, eta);
  const bool proves[3] = {claims.near, claims.far, claims.permitted};
  for (int i = 0; i < 3; ++i) {
    if (!proves[i] || (search.proved[i] && size_of(search.smallest[i]) <= size_of(offset))) {
      continue;
    }
    search.proved[i] = true;
    search.smallest[i] = offset;
  }
  return hit.distance_m;
}

void Judge::search_small_crosses(Search& search) const {
  // The last cross lies just inside the disc: its border belongs to it only as a limit.
  for (const double part : {0.125, 0.25, 0.5, 0.75, 1 - 1e-9}) {
    for (const double angle : {0.0, pi, 0.5 * pi, -0.5 * pi}) {
      if (search.done()) return;
      add(search, part * bound_px_ * turned(search.down, angle));
    }
  }
}

void Judge::search_rings(Search& search, double from, double to, int rings, int rays) const {
  for (int ring = 0; ring < rings; ++ring) {
    const double radius = from + (to - from) * ring / std::max(1, rings - 1);
    for (int ray = 0; ray < rays; ++ray) {
      if (search.done()) return;
      // Every other ring is turned by half a step, so that rays do not line up.
      const double angle = 2 * pi * (ray + 0.5 * (ring % 2)) / rays;
      add(search, radius * turned(search.down, angle));
    }
  }
}

void Judge::search_around_extremes(Search& search) const {
  // A larger disc holds more hills and hollows, any of which may be the one that counts.
  const auto starts = static_cast<std::size_t>(std::clamp(bound_px_, 2.0, 12.0));
  for (const int claim : {0, 1}) {
    std::vector<Sample> samples = search.samples;
    std::stable_sort(samples.begin(), samples.end(), [&](const Sample& a, const Sample& b) {
      return claim == 0 ? a.distance_m < b.distance_m : a.distance_m > b.distance_m;
    });
    std::vector<ImagePoint> tried;
    for (const Sample& sample : samples) {
      if (search.done() || search.proved[claim] || tried.size() == starts) break;
      const bool is_new = std::all_of(tried.begin(), tried.end(), [&](const ImagePoint& other) {
        return size_of(sample.offset + (-1.0) * other) > 0.15 * bound_px_;
      });
      if (!is_new) continue;
      tried.push_back(sample.offset);
      climb(search, sample, claim);
    }
  }
}

void Judge::climb(Search& search, Sample best, int claim) const {
  const double edge = bound_px_ * (1 - 1e-9);
  int budget = 200;
  for (double step = 0.1 * bound_px_; step > 1e-4 * bound_px_;) {
    bool has_moved = false;
    for (int turn = 0; turn < 8; ++turn) {
      if (search.done() || search.proved[claim] || --budget < 0) return;
      ImagePoint offset = best.offset + step * turned(search.down, 0.25 * pi * turn);
      if (size_of(offset) > edge) offset = (edge / size_of(offset)) * offset;
      const double distance_m = add(search, offset);
      if (claim == 0 ? distance_m < best.distance_m : distance_m > best.distance_m) {
        best = {offset, distance_m};
        has_moved = true;
      }
    }
    if (!has_moved) step *= 0.5;
  }
}

void Judge::refine_error(Search& search) const {
  // Halving towards the centre, claim by claim, tells the error to about a sixteenth of the bound.
  const double goal = bound_px_ / 16;
  for (int i = 0; i < 3; ++i) {
    const ImagePoint outermost = search.smallest[i];
    double known = 0;
    while (size_of(search.smallest[i]) - known > goal &&
           size_of(search.smallest[i]) >= search.radius_px()) {
      const double radius = 0.5 * (known + size_of(search.smallest[i]));
      add(search, (radius / size_of(outermost)) * outermost);
      if (size_of(search.smallest[i]) > radius * (1 + 1e-12)) known = radius;
    }
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
Judge::ArcResult Judge::search_arc(Search& search, bool upper) const {
  const Vec3 direction = camera_.direction(search.centre);
  const double sine = camera_.sine_above_level(direction);
  const double cosine = std::sqrt(std::max(0.0, 1 - sine * sine));
  Arc arc;
  arc.middle = upper ? (-1.0) * search.down : search.down;
  const double step_px = 1e-3 * bound_px_;
  const Vec3 turned_ray = camera_.direction(search.centre + step_px * arc.middle);
  const double turn_rad_per_px = length(turned_ray - direction) / step_px;
  const double disc_rad = 2 * bound_px_ * turn_rad_per_px;
  if (search.met_unknown || cosine < 0.2 || disc_rad > 0.05) return ArcResult::not_applicable;
  // Rays of one vertical plane reach the same ground at distances that differ by this much.
  const double stretch = 1.1 * disc_rad * std::abs(sine) / cosine + 0.5 * disc_rad * disc_rad;
  if (search.z == infinity) {
    arc.cap_m = arc.safe_cap_m = tracer_.range_m();
  } else {
    arc.cap_m = search.z * (upper ? 1 - eta : 1 + eta);
    arc.safe_cap_m = arc.cap_m * (upper ? 1 - stretch : 1 + stretch);
  }
  arc.px_per_slope = cosine / turn_rad_per_px;
  arc.steepness = 1.05 * std::hypot(1.0, std::clamp(tracer_.terrain().steepest(), 1.0, 30.0));
  return halve_arc(search, upper, arc);
}

Judge::ArcResult Judge::halve_arc(Search& search, bool upper, const Arc& arc) const {
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
    const ImagePoint offset = bound_px_ * (1 - 1e-9) * turned(arc.middle, angle);
    const Vec3 ray = camera_.direction(search.centre + offset);
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
      add(search, offset);
      if (search.proved[upper ? 1 : 0]) return ArcResult::proved;
    }
    if (--budget == 0 || reach_px < 1e-4 * bound_px_) return ArcResult::grazing;
    parts.push_back({part.from, angle});
    parts.push_back({angle, part.to});
  }
  return excluded_in_disc ? ArcResult::excluded : ArcResult::not_applicable;
}

bool Judge::holds_by_a_hair(const Search& search) const {
  constexpr int rays = 96;
  const double radius = bound_px_ * 1.002 + 1e-4;
  bool proved[3] = {search.proved[0], search.proved[1], search.proved[2]};
  for (int ring = 0; ring < 3; ++ring) {
    for (int ray = 0; ray < rays; ++ray) {
      const double angle = 2 * pi * ray / rays;
      const ImagePoint offset = (radius * (1 - ring / 3.0)) * turned(search.down, angle);
      FirstHit hit = longer_tracer_.first_hit(camera_.direction(search.centre + offset));
      // A surface at the very end of the display range may be seen or not.
      if (search.z == infinity && hit.distance_m >= tracer_.range_m() * (1 - eta)) {
        hit.distance_m = infinity;
      }
      const Claims claims = claims_of(search.z, hit, 1.02 * eta);
      proved[0] = proved[0] || claims.near;
      proved[1] = proved[1] || claims.far;
      proved[2] = proved[2] || claims.permitted;
      if (proved[0] && proved[1] && proved[2]) return true;
    }
  }
  return false;
}

void Judge::judge_soundness(int u, int v, Judgement& judgement) const {
  Search search;
  search.centre = {u + 0.5, v + 0.5};
  search.z = frame_.z(u, v);
  search.down = camera_.image_down(search.centre);
  const Claims claims = claims_of(search.z, judgement.centre, eta);
  search.proved[0] = claims.near;
  search.proved[1] = claims.far;
  search.proved[2] = claims.permitted;
  search.met_unknown = judgement.centre.may_be_unknown;
  search.nearest_m = search.farthest_m = judgement.centre.distance_m;
  search.samples.push_back({{0, 0}, judgement.centre.distance_m});
  search_small_crosses(search);
  bool excluded = false;
  bool grazing = false;
  for (const int claim : {0, 1}) {
    if (search.proved[claim]) continue;
    const ArcResult result = search_arc(search, claim == 1);
    excluded = excluded || result == ArcResult::excluded;
    grazing = grazing || result == ArcResult::grazing;
  }
  if (!search.done() && !excluded) {
    search_rings(search, bound_px_ * (1 - 1e-9), 0.1 * bound_px_, 7, 56);
    search_around_extremes(search);
  }
  if (search.done()) {
    refine_error(search);
    judgement.error_px = search.radius_px();
    return;
  }
  const bool by_a_hair = (grazing && !excluded) || holds_by_a_hair(search);
  judgement.soundness = by_a_hair ? Verdict::undecided : Verdict::violated;
  for (int i = 0; i < 3; ++i) {
    if (search.proved[i]) continue;
    judgement.fault += std::string(judgement.fault.empty() ? "" : ", ") +
                       "no ray of the disc for " + class_names[i] + " claim (truth " +
                       std::to_string(search.nearest_m) + " to " +
                       std::to_string(search.farthest_m) + " m)";
  }
  search_rings(search, 1.125 * bound_px_, 4 * bound_px_, 10, 12);
  judgement.error_is_larger = !search.done();
  judgement.error_px = search.done() ? search.radius_px() : 4 * bound_px_;
}

bool Judge::is_between_neighbours(const ImagePoint& point, const FirstHit& hit) const {
  const double radius = bound_px_ + std::sqrt(0.5) + 1e-9;
  bool below = false;
  bool above = false;
  const auto take = [&](double z) {
    if (std::isnan(z)) {
      below = below || hit.may_be_unknown;
      above = above || hit.may_be_unknown;
      return;
    }
    below = below || z * (1 - eta) <= hit.distance_m;
    above = above || z * (1 + eta) >= hit.distance_m;
  };
  std::vector<ImagePoint> beyond;
  for (int v = static_cast<int>(std::floor(point.y - radius)); v <= point.y + radius; ++v) {
    for (int u = static_cast<int>(std::floor(point.x - radius)); u <= point.x + radius; ++u) {
      const ImagePoint centre{u + 0.5, v + 0.5};
      if (size_of(centre + (-1.0) * point) > radius) continue;
      if (u < 0 || v < 0 || u >= frame_.width || v >= frame_.height) {
        beyond.push_back(centre);
      } else {
        take(frame_.z(u, v));
      }
    }
  }
  for (const ImagePoint& centre : beyond) {
    if (below && above) break;
    take(tracer_.first_hit(camera_.direction(centre)).distance_m);
  }
  return below && above;
}

Verdict Judge::completeness(const ImagePoint& point, const FirstHit& hit) const {
  if (is_between_neighbours(point, hit)) return Verdict::holds;
  const double range = tracer_.range_m();
  if (hit.is_sky() || hit.distance_m >= range * (1 - eta)) {
    // At the very end of the display range a surface may be seen or not.
    FirstHit other = longer_tracer_.first_hit(camera_.direction(point));
    if (other.distance_m < infinity) {
      if (!hit.is_sky()) other.distance_m = infinity;
      if (is_between_neighbours(point, other)) return Verdict::undecided;
    }
  }
  constexpr double hair_px = 1e-4;
  for (const ImagePoint& step : {ImagePoint{hair_px, 0}, ImagePoint{-hair_px, 0},
                                 ImagePoint{0, hair_px}, ImagePoint{0, -hair_px}}) {
    const ImagePoint beside = point + step;
    if (is_between_neighbours(beside, tracer_.first_hit(camera_.direction(beside)))) {
      return Verdict::undecided;
    }
  }
  return Verdict::violated;
}

Judgement Judge::judge(int u, int v, const ImagePoint& offset) const {
  Judgement judgement;
  const ImagePoint centre{u + 0.5, v + 0.5};
  judgement.centre = tracer_.first_hit(camera_.direction(centre));
  judgement.off_centre = tracer_.first_hit(camera_.direction(centre + offset));
  judge_soundness(u, v, judgement);
  judgement.completeness = completeness(centre, judgement.centre);
  judgement.missed_between_centres = !is_between_neighbours(centre + offset, judgement.off_centre);
  if (judgement.completeness != Verdict::holds) {
    judgement.fault += std::string(judgement.fault.empty() ? "" : ", ") +
                       "what is at its centre is not between the pixels around";
  }
  return judgement;
}

}  // namespace ridgeline::oracle
