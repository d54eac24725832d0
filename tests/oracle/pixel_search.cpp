#include "tests/oracle/pixel_search.hpp"

#include <algorithm>
#include <cmath>

namespace ridgeline::oracle {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

Claims claims_of(double z, const FirstHit& hit, double slack) {
  if (std::isnan(z)) return {{true, true, hit.may_be_unknown}};
  if (z == infinity) return {{true, hit.is_sky() && !hit.must_be_unknown, true}};
  return {
      {hit.distance_m <= z * (1 + slack), hit.distance_m >= z * (1 - slack), !hit.must_be_unknown}};
}

ImagePoint turned(const ImagePoint& unit, double angle_rad) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  return {c * unit.x - s * unit.y, s * unit.x + c * unit.y};
}

PixelSearch::PixelSearch(const Tracer& tracer, const Camera& camera, const ImagePoint& centre,
                         double z, double slack, const FirstHit& at_centre)
    : tracer_(tracer),
      camera_(camera),
      centre_(centre),
      down_(camera.image_down(centre)),
      z_(z),
      slack_(slack),
      centre_m_(at_centre.distance_m),
      nearest_m_(at_centre.distance_m),
      farthest_m_(at_centre.distance_m),
      met_unknown_(at_centre.may_be_unknown) {
  const Claims claims = claims_of(z, at_centre, slack);
  std::copy_n(claims.holds, int{claim_count}, proved_);
  samples_.reserve(32);
  samples_.push_back({{0, 0}, centre_m_});
}

double PixelSearch::radius_px() const {
  return std::max({size_of(smallest_[0]), size_of(smallest_[1]), size_of(smallest_[2])});
}

double PixelSearch::add(const ImagePoint& offset) {
  const FirstHit hit = tracer_.first_hit(camera_.direction(centre_ + offset));
  samples_.push_back({offset, hit.distance_m});
  nearest_m_ = std::min(nearest_m_, hit.distance_m);
  farthest_m_ = std::max(farthest_m_, hit.distance_m);
  met_unknown_ = met_unknown_ || hit.may_be_unknown;
  const Claims claims = claims_of(z_, hit, slack_);
  for (int i = 0; i < claim_count; ++i) {
    if (!claims.holds[i] || (proved_[i] && size_of(smallest_[i]) <= size_of(offset))) continue;
    proved_[i] = true;
    smallest_[i] = offset;
  }
  return hit.distance_m;
}

void PixelSearch::search_linearly(double probe_px, double within_px) {
  if (!(z_ < infinity) || !(centre_m_ < infinity)) return;
  if (proved_[claim_near] && proved_[claim_far]) return;
  const int lacking = proved_[claim_near] ? claim_far : claim_near;
  const ImagePoint right = turned(down_, -0.5 * pi);
  const double downwards = (add(probe_px * down_) - centre_m_) / probe_px;
  const double sideways = (add(probe_px * right) - centre_m_) / probe_px;
  const double slope = std::sqrt(downwards * downwards + sideways * sideways);
  const double goal_m = z_ * (lacking == claim_near ? 1 + slack_ : 1 - slack_) - centre_m_;
  const double radius = std::abs(goal_m) / slope;
  if (!(slope < infinity) || !(1.01 * radius < within_px)) return;  // no plane beside the sky
  const double sign = goal_m > 0 ? 1 : -1;
  const ImagePoint way = (sign * downwards / slope) * down_ + (sign * sideways / slope) * right;
  add(1.01 * radius * way);
  // Only where the slope was looked at is a plane any argument against a smaller disc.
  if (!proved_[lacking] || 1.01 * radius > 4 * probe_px) return;
  add(0.99 * radius * way);
  if (!is_smallest_within(lacking, 0.99 * radius)) failed_px_[lacking] = 0.99 * radius;
}

bool PixelSearch::is_open_at(double radius_px) const {
  for (int i = 0; i < claim_count; ++i) {
    if (!is_smallest_within(i, radius_px) && failed_px_[i] < radius_px) return true;
  }
  return false;
}

void PixelSearch::search_cross(double radius_px) {
  for (const double angle : {0.0, pi, 0.5 * pi, -0.5 * pi}) {
    if (!is_open_at(radius_px)) return;
    add(radius_px * turned(down_, angle));
  }
  for (int i = 0; i < claim_count; ++i) {
    if (!is_smallest_within(i, radius_px)) failed_px_[i] = std::max(failed_px_[i], radius_px);
  }
}

void PixelSearch::search_within(double within_px) {
  const auto most = static_cast<int>(2 * within_px);
  for (int j = -most; j <= most; ++j) {
    for (int i = -most; i <= most && radius_px() > within_px; ++i) {
      const ImagePoint offset{0.5 * i, 0.5 * j};
      if (size_of(offset) <= within_px) add(offset);
    }
  }
}

void PixelSearch::refine(double share, double to_px) {
  for (int i = 0; i < claim_count; ++i) {
    const auto size = [&] { return size_of(smallest_[i]); };
    const auto tolerance = [&] { return std::max(share * size(), to_px); };
    // Most often what is known is the smallest already: the first look is for that.
    double radius = size() - 0.99 * tolerance();
    while (size() >= radius_px() && size() - failed_px_[i] > tolerance()) {
      radius = std::max(radius, failed_px_[i]);
      const ImagePoint outermost = (1 / size()) * smallest_[i];
      for (const double angle : {0.0, 0.5, -0.5, 1.0, -1.0}) {
        add(radius * turned(outermost, angle));
        if (is_smallest_within(i, radius)) break;
      }
      if (!is_smallest_within(i, radius)) failed_px_[i] = radius;
      radius = failed_px_[i] > 0 ? std::sqrt(failed_px_[i] * size()) : 0.25 * size();
    }
  }
}

}  // namespace ridgeline::oracle
