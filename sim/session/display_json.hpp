#pragma once
#include <nlohmann/json.hpp>

#include "core/frame/display_state.hpp"

namespace ridgeline::sim {

/// What the pilot's switches made of a picture, for dumps and reports; null for the plain day, of
/// which nothing is said.
[[nodiscard]] nlohmann::ordered_json display_json(const DisplayState& display);

}  // namespace ridgeline::sim
