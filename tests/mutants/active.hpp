#pragma once
#include <string_view>

namespace ridgeline::test {

inline constexpr int no_mutant = -1;

/// Chooses the mutant of everything built from now on: an index of mutants(), or no_mutant.
void set_active_mutant(int index);
/// What the switches in the copied sources ask.
[[nodiscard]] bool mutant_is_on(int index);
/// The source of a shader as the active mutant has it. The result lives until the next call with
/// the same text.
[[nodiscard]] std::string_view mutated_shader(std::string_view source);

}  // namespace ridgeline::test
