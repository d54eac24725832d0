#pragma once
#include <functional>

#include "sim/attack/attack_case.hpp"

namespace ridgeline::sim {

/// Whether a case fails.
using Fails = std::function<bool(const AttackCase&)>;

/// A smaller case that fails as well, found by trying one simplification after the other: fewer
/// poses, layers, tiles, edits; a plain window and arrival; a smaller picture, range and terrain;
/// rounder numbers. Every case tried is one that parse_case() accepts.
/// Result: a case that fails and of which no simplification tried fails, or what was reached after
///         `most_tries` calls of `fails`.
/// Cost:   the calls of `fails`; the result depends on its answers alone.
[[nodiscard]] AttackCase shrunk(AttackCase failing, const Fails& fails, int most_tries);

}  // namespace ridgeline::sim
