#pragma once
#include <cstdint>

#include "sim/attack/attack_case.hpp"
#include "sim/attack/land.hpp"
#include "sim/attack/random.hpp"

namespace ridgeline::sim {

/// Case number `number` of a seed: a function of both, and one that parse_case() accepts.
[[nodiscard]] AttackCase random_case(std::uint64_t seed, std::uint64_t number);

// --- its parts --------------------------------------------------------------------------------

/// How hard the heights of a case may be: where coarser levels or a polar chart are drawn, rough
/// ground allows no bound and the frame is removed.
enum class Roughness : std::uint8_t { any, gentle };

/// Chooses the layers of the land. Domain: the place and the tiles are chosen.
void choose_land(Random& random, Roughness roughness, AttackCase& attack_case);

/// The same for a picture in which pixels share rays: mostly ground about as steep as lets them.
void choose_shared_land(Random& random, AttackCase& attack_case);

/// Chooses the poses, of which the hard ones are the most. Domain: all but the edits is chosen.
void choose_poses(Random& random, const CaseLand& land, AttackCase& attack_case);

}  // namespace ridgeline::sim
