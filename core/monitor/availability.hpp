#pragma once
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string_view>

#include "core/base/fixed_vector.hpp"
#include "core/monitor/air_ground_check.hpp"
#include "core/monitor/ground_check.hpp"
#include "core/state/ownship_pose.hpp"

namespace ridgeline {

/// What may be drawn: synthetic terrain, terrain with a caution, or none at all. Ordered from good
/// to bad.
enum class Mode : std::uint8_t { svs, degraded, removed };

/// Every reason why a frame is not a plain one, from the one list config/reasons.def.
enum class Reason : std::uint8_t {
#define RL_REASON(word, mode, text) word,
#include "config/reasons.def"
#undef RL_REASON
};
inline constexpr std::size_t reason_count =
    std::initializer_list<Reason>{
#define RL_REASON(word, mode, text) Reason::word,
#include "config/reasons.def"
#undef RL_REASON
    }
        .size();

/// The stable word of a reason, as written in reports and dumps.
[[nodiscard]] std::string_view reason_word(Reason reason);
/// One clause for people.
[[nodiscard]] std::string_view reason_text(Reason reason);
/// What this reason makes of the picture.
[[nodiscard]] Mode reason_mode(Reason reason);
/// The stable word of a mode.
[[nodiscard]] std::string_view mode_word(Mode mode);

/// Mode of a frame and every reason for it, without repetition.
struct Availability {
  Mode mode = Mode::svs;
  FixedVector<Reason, reason_count> reasons;
};

/// Adds a reason (once) and lets the mode get as bad as it demands; modes never get better.
void add_reason(Availability& availability, Reason reason);

/// What the ownship data alone allows; terrain, bound and label reasons are added with
/// add_reason(). One reason per value: missing, stale, implausible, invalid, frozen, disagrees;
/// attitude stands for roll and pitch. Sources left out, rates not believed and recent events
/// degrade. Airspeed, rates and clock are not needed to draw terrain and never remove it.
/// Cost:   O(1); no allocation.
[[nodiscard]] Availability availability(const OwnshipPose& pose);

/// The same, with what the radio height and the air/ground switch said of the ground that was
/// drawn.
[[nodiscard]] Availability availability(const OwnshipPose& pose, const GroundCheck& ground,
                                        const AirGroundCheck& air_ground = {});

/// The same for the pose at `now_ns`.
[[nodiscard]] Availability availability(const OwnshipState& state, std::int64_t now_ns,
                                        const StateLimits& limits);

}  // namespace ridgeline
