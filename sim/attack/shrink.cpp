#include "sim/attack/shrink.hpp"

#include <algorithm>
#include <cmath>

namespace ridgeline::sim {
namespace {

using Cases = std::vector<AttackCase>;

/// All copies of the case with one element of a list missing, and those with only one left.
template <typename Element>
void with_fewer(const AttackCase& c, std::vector<Element> AttackCase::*list, std::size_t least,
                Cases& out) {
  const std::vector<Element>& all = c.*list;
  if (all.size() <= least) return;
  if (all.size() > 2) {
    for (const Element& only : all) {
      out.push_back(c);
      out.back().*list = {only};
    }
  }
  for (std::size_t gone = all.size(); gone-- > 0;) {
    out.push_back(c);
    (out.back().*list).erase((out.back().*list).begin() + static_cast<std::ptrdiff_t>(gone));
  }
}

/// `value` with so many decimals.
double rounded(double value, int decimals) {
  const double scale = std::pow(10.0, decimals);
  return std::round(value * scale) / scale;
}

/// Copies with a number of the case changed; unchanged ones are left out.
template <typename Change>
void changed(const AttackCase& c, const Change& change, Cases& out) {
  AttackCase other = c;
  change(other);
  if (!(other == c)) out.push_back(std::move(other));
}

void simpler_setting(const AttackCase& c, Cases& out) {
  changed(
      c, [](AttackCase& o) { o.arrival = SceneOptions::Arrival::settled; }, out);
  changed(
      c, [](AttackCase& o) { o.window_mib = 96; }, out);
  changed(
      c, [](AttackCase& o) { o.geoid = {}; }, out);
  changed(
      c, [](AttackCase& o) { o.error_px = 1; }, out);
  changed(
      c, [](AttackCase& o) { o.image.horizontal_field_of_view_deg = 60; }, out);
  constexpr int small_px = 32;
  for (const int divide : {4, 2}) {
    changed(
        c,
        [&](AttackCase& o) {
          o.image.width_px =
              std::max(std::min(small_px, o.image.width_px), o.image.width_px / divide);
          o.image.height_px =
              std::max(std::min(small_px, o.image.height_px), o.image.height_px / divide);
        },
        out);
  }
  for (const double part : {0.25, 0.5, 0.8}) {
    changed(
        c,
        [&](AttackCase& o) {
          o.range_m = std::min(o.range_m, std::max(1'000.0, std::round(o.range_m * part)));
        },
        out);
  }
}

/// One number of a layer made simpler, by what it means.
void simpler_number(double& value, const LayerNumber& meaning, int step) {
  if (meaning.role == NumberRole::amount) {
    constexpr double hardly_anything = 0.01;  // halved no further: that would not end
    const double simpler[] = {0, value / 4, value / 2, std::round(value)};
    if (step == 0 || step == 3 || std::abs(value) > hardly_anything) value = simpler[step];
    if (meaning.whole) value = std::trunc(value);
  } else if (meaning.role == NumberRole::rarity) {
    const double simpler[] = {value * 16, value * 4, value * 2, value};
    value = simpler[step];
  }
  value = std::clamp(value, meaning.least, meaning.most);
}

void simpler_land(const AttackCase& c, Cases& out) {
  for (std::size_t layer = 0; layer < c.land.size(); ++layer) {
    const LayerForm& form = layer_form(c.land[layer].kind);
    for (std::size_t n = 0; n < form.count; ++n) {
      for (int step = 0; step < 4; ++step) {
        changed(
            c,
            [&](AttackCase& o) { simpler_number(o.land[layer].numbers[n], form.numbers[n], step); },
            out);
      }
    }
  }
}

void smaller_tiles(const AttackCase& c, Cases& out) {
  for (std::size_t tile = 0; tile < c.tiles.size(); ++tile) {
    const TilePlan& whole = c.tiles[tile];
    if (whole.rows < 8 || whole.columns < 8) continue;
    for (const int side : {0, 1, 2, 3}) {
      changed(
          c,
          [&](AttackCase& o) {
            TilePlan& t = o.tiles[tile];
            const PostGrid grid = grid_of(t);
            const bool rows = side < 2;
            const int gone = (rows ? t.rows : t.columns) / 3;
            (rows ? t.rows : t.columns) -= gone;
            if (side == 1) t.south_deg = grid.south_deg + gone * grid.latitude_step_deg;
            if (side == 3) t.west_deg = grid.west_deg + gone * grid.longitude_step_deg;
          },
          out);
    }
  }
}

void rounder_poses(const AttackCase& c, Cases& out) {
  using Number = double AttackPose::*;
  for (std::size_t k = 0; k < c.poses.size(); ++k) {
    for (const Number n :
         {&AttackPose::roll_deg, &AttackPose::pitch_deg, &AttackPose::heading_deg}) {
      for (const int decimals : {-9, 0, 2}) {
        const auto round = [&](AttackCase& o) {
          o.poses[k].*n = decimals < 0 ? 0.0 : rounded(o.poses[k].*n, decimals);
        };
        changed(c, round, out);
      }
    }
    for (const int decimals : {0, 2}) {
      changed(
          c, [&](AttackCase& o) { o.poses[k].height_m = rounded(o.poses[k].height_m, decimals); },
          out);
    }
    for (const int decimals : {1, 3, 5}) {
      const auto round = [&](AttackCase& o) {
        o.poses[k].latitude_deg = rounded(o.poses[k].latitude_deg, decimals);
        o.poses[k].longitude_deg = rounded(o.poses[k].longitude_deg, decimals);
      };
      changed(c, round, out);
    }
  }
}

/// Simpler cases, the boldest first.
Cases simplifications(const AttackCase& c) {
  Cases out;
  with_fewer(c, &AttackCase::poses, 1, out);
  with_fewer(c, &AttackCase::edits, 0, out);
  with_fewer(c, &AttackCase::sea, 0, out);
  with_fewer(c, &AttackCase::tiles, 1, out);
  with_fewer(c, &AttackCase::land, 0, out);
  simpler_setting(c, out);
  simpler_land(c, out);
  smaller_tiles(c, out);
  rounder_poses(c, out);
  return out;
}

}  // namespace

AttackCase shrunk(AttackCase failing, const Fails& fails, int most_tries) {
  int tries = 0;
  bool smaller = true;
  while (smaller) {
    smaller = false;
    for (const AttackCase& simpler : simplifications(failing)) {
      AttackCase accepted;
      if (!parse_case(text_of(simpler), accepted).empty()) continue;
      if (++tries > most_tries) return failing;
      if (!fails(accepted)) continue;
      failing = std::move(accepted);
      smaller = true;
      break;
    }
  }
  return failing;
}

}  // namespace ridgeline::sim
