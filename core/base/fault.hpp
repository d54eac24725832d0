#pragma once
#include <cstdint>
#include <string_view>

namespace ridgeline {

/// Every expected failure of the module, from the one list config/faults.def.
enum class Fault : std::uint16_t {
#define RL_FAULT(id, severity, text) id,
#include "config/faults.def"
#undef RL_FAULT
};

/// How far a fault reaches: a note changes nothing, a caution degrades, a fatal one ends the
/// program.
enum class Severity : std::uint8_t { note, caution, fatal };

/// The stable identifier of a fault, as written in reports.
[[nodiscard]] constexpr std::string_view fault_id(Fault fault) {
  constexpr std::string_view ids[] = {
#define RL_FAULT(id, severity, text) #id,
#include "config/faults.def"
#undef RL_FAULT
  };
  return ids[static_cast<std::uint16_t>(fault)];
}

/// One sentence for people; says what is wrong, not where (the caller knows the file or frame).
[[nodiscard]] constexpr std::string_view fault_text(Fault fault) {
  constexpr std::string_view texts[] = {
#define RL_FAULT(id, severity, text) text,
#include "config/faults.def"
#undef RL_FAULT
  };
  return texts[static_cast<std::uint16_t>(fault)];
}

/// The severity the fault list gives this fault.
[[nodiscard]] constexpr Severity fault_severity(Fault fault) {
  constexpr Severity severities[] = {
#define RL_FAULT(id, severity, text) Severity::severity,
#include "config/faults.def"
#undef RL_FAULT
  };
  return severities[static_cast<std::uint16_t>(fault)];
}

}  // namespace ridgeline
