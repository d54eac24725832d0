#include <algorithm>

#include "sim/attack/random_case.hpp"

namespace ridgeline::sim {
namespace {

constexpr double metres_per_degree = 111'195;

double post_m(const AttackCase& c) {
  return metres_per_degree * grid_of(c.tiles.front()).latitude_step_deg;
}

void add(AttackCase& c, LayerKind kind, std::array<double, most_layer_numbers> numbers) {
  c.land.push_back({kind, numbers});
}

double with_sign(Random& r, double value) {
  return r.chance(0.5) ? value : -value;
}

double round_height(Random& r, double low, double high) {
  return with_decimals(r.spread(low, high), 1);
}

double direction(Random& r) {
  return r.whole(0, 3);
}

void mountains(Random& r, bool gentle, AttackCase& c) {
  const double wave = std::round(post_m(c) * r.spread(gentle ? 25 : 4, gentle ? 400 : 200));
  const double most = gentle ? std::min(0.05 * wave, 2'000.0) : std::min(1.5 * wave, 9'000.0);
  const LayerKind kind = r.chance(0.5) ? LayerKind::fractal : LayerKind::ridges;
  add(c, kind, {round_height(r, most / 8, most), wave, r.seed()});
}

void base(Random& r, AttackCase& c) {
  if (r.chance(0.4)) {
    mountains(r, r.chance(0.5), c);
  } else if (r.chance(0.7)) {
    add(c, LayerKind::flat, {r.one_of({100, 500, 1, 2'000, -300, 0.3, 999.99})});
  }
}

void spires(Random& r, AttackCase& c) {
  base(r, c);
  add(c, LayerKind::spires,
      {with_sign(r, round_height(r, 1, 8'000)), std::round(r.spread(8, 4'000)), r.seed()});
}

void walls(Random& r, AttackCase& c) {
  base(r, c);
  const int spacing = r.whole(3, 60);
  add(c, LayerKind::walls,
      {round_height(r, 1, 6'000), static_cast<double>(spacing), 1, direction(r),
       static_cast<double>(r.whole(0, spacing - 1))});
}

void cliffs(Random& r, AttackCase& c) {
  if (r.chance(0.4)) add(c, LayerKind::flat, {r.one_of({-300, -12'000, 0, 5})});
  const int spacing = r.whole(1, 40);
  add(c, LayerKind::cliffs,
      {r.chance(0.4) ? 9'000.0 : round_height(r, 10, 12'000), static_cast<double>(spacing),
       direction(r), static_cast<double>(r.whole(0, spacing - 1))});
}

void checker(Random& r, AttackCase& c) {
  base(r, c);
  add(c, LayerKind::checker, {round_height(r, 1, 3'000), r.chance(0.7) ? 1.0 : r.whole(2, 6)});
}

void stairs(Random& r, AttackCase& c) {
  mountains(r, r.chance(0.5), c);
  add(c, LayerKind::stairs, {r.one_of({10, 25, 50, 100, 333, 1'000})});
}

void flat(Random& r, AttackCase& c) {
  add(c, LayerKind::flat,
      {r.one_of({0, 0, 0, 1, -1, 0.1, 333.25, 100, 2'800, -430, 9'000, -12'000})});
}

void hardly_sloping(Random& r, AttackCase& c) {
  if (r.chance(0.5)) add(c, LayerKind::flat, {r.one_of({100, 1'000, -5, 2'000})});
  if (r.chance(0.5)) {
    add(c, LayerKind::slope,
        {r.one_of({0, 1e-40, 1e-7, 1e-5, 1e-3, -1e-30, 0.01}),
         r.one_of({0, 1e-40, -1e-7, 1e-5, 1e-3, 0.02})});
  } else {
    const int spacing = r.whole(10, 120);
    add(c, LayerKind::cliffs,
        {r.one_of({1, -1, 1, 0.01, 1e-6}), static_cast<double>(spacing), direction(r),
         static_cast<double>(r.whole(0, spacing - 1))});
  }
}

void extreme(Random& r, AttackCase& c) {
  const double wave = std::round(post_m(c) * r.spread(2, 60));
  add(c, LayerKind::flat, {r.one_of({-1'500, 0, -9'000, 4'000})});
  add(c, LayerKind::fractal, {25'000, wave, r.seed()});
  if (r.chance(0.3)) add(c, LayerKind::clamp, {-12'000, r.one_of({8'999, 9'000, 0, -430})});
}

void rough(Random& r, AttackCase& c) {
  base(r, c);
  add(c, LayerKind::rough, {round_height(r, 1, 4'000), r.seed()});
}

void canyons(Random& r, AttackCase& c) {
  base(r, c);
  add(c, LayerKind::flat, {r.one_of({500, 2'000, 1'000})});
  const int spacing = r.whole(4, 60);
  add(c, LayerKind::walls,
      {-round_height(r, 5, 2'500), static_cast<double>(spacing), r.chance(0.5) ? 1.0 : 2.0,
       direction(r), static_cast<double>(r.whole(0, spacing - 1))});
}

void voids(Random& r, AttackCase& c) {
  const double wave = std::round(post_m(c) * r.spread(4, 60));
  const int spacing = r.whole(3, 60);
  const double first = r.whole(-20, 20), other = r.whole(-20, 20);
  switch (r.whole(0, 4)) {
    case 0:
      return add(c, LayerKind::holes, {std::round(r.spread(10, 5'000)), r.seed()});
    case 1:
      return add(c, LayerKind::islands, {r.one_of({0.1, 0.2, 0.3, 0.5}), wave, r.seed()});
    case 2:
      return add(c, LayerKind::stripes,
                 {static_cast<double>(spacing), static_cast<double>(r.whole(1, 3)), direction(r),
                  static_cast<double>(r.whole(0, spacing - 1))});
    case 3:
      return add(c, LayerKind::half, {direction(r), first});
    default:
      return add(
          c, LayerKind::box,
          {first, other, static_cast<double>(r.whole(1, 30)), static_cast<double>(r.whole(1, 30))});
  }
}

void any_family(Random& r, AttackCase& c) {
  switch (r.whole(0, 11)) {
    case 0:
      return spires(r, c);
    case 1:
      return walls(r, c);
    case 2:
      return cliffs(r, c);
    case 3:
      return checker(r, c);
    case 4:
      return stairs(r, c);
    case 5:
      return flat(r, c);
    case 6:
      return hardly_sloping(r, c);
    case 7:
      return extreme(r, c);
    case 8:
      return rough(r, c);
    case 9:
      return canyons(r, c);
    default:
      return mountains(r, r.chance(0.3), c);
  }
}

void gentle_family(Random& r, AttackCase& c) {
  if (r.chance(0.15)) return flat(r, c);
  if (r.chance(0.15)) return hardly_sloping(r, c);
  mountains(r, true, c);
  if (r.chance(0.4)) add(c, LayerKind::flat, {r.one_of({500, 1'500, -200, 50})});
}

/// Saw teeth whose flanks rise by about as much as ground may that shares rays.
void teeth(Random& r, AttackCase& c) {
  const double slope = r.between(0.2, 1.3);
  const double tooth_m = with_decimals(slope * post_m(c), 1);
  switch (r.whole(0, 3)) {
    case 0:
      return add(c, LayerKind::checker, {tooth_m, static_cast<double>(r.whole(1, 3))});
    case 1: {
      const int spacing = r.whole(2, 6);
      return add(c, LayerKind::walls,
                 {with_sign(r, tooth_m), static_cast<double>(spacing), 1, direction(r),
                  static_cast<double>(r.whole(0, spacing - 1))});
    }
    case 2:
      return add(c, LayerKind::rough, {tooth_m, r.seed()});
    default: {
      const double wave = std::round(post_m(c) * r.spread(2, 30));
      const LayerKind kind = r.chance(0.5) ? LayerKind::fractal : LayerKind::ridges;
      return add(c, kind, {with_decimals(0.5 * slope * wave, 1), wave, r.seed()});
    }
  }
}

}  // namespace

void choose_shared_land(Random& r, AttackCase& c) {
  if (r.chance(0.3)) mountains(r, true, c);
  const int kind = r.whole(0, 9);
  if (kind < 5) teeth(r, c);
  if (kind == 4 || kind == 5) spires(r, c);
  if (kind == 6) walls(r, c);
  if (kind == 7) cliffs(r, c);
  if (kind == 8) hardly_sloping(r, c);
  if (kind == 9) stairs(r, c);
  if (r.chance(0.08)) voids(r, c);
}

void choose_land(Random& random, Roughness roughness, AttackCase& c) {
  const bool gentle = roughness == Roughness::gentle;
  if (gentle) {
    gentle_family(random, c);
  } else {
    any_family(random, c);
    if (random.chance(0.25)) any_family(random, c);
  }
  if (c.tiles.size() > 1 && random.chance(0.1)) {
    add(c, LayerKind::seam, {round_height(random, 1, gentle ? 5 : 200)});
  }
  if (random.chance(gentle ? 0.1 : 0.3)) voids(random, c);
}

}  // namespace ridgeline::sim
