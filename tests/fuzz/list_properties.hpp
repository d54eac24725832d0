#pragma once
#include <string_view>

#include "sim/terrain_input/statements.hpp"

namespace ridgeline::fuzz {

/// Checks that the statements of a file are whole lines of it, in order, without comments.
void check_statements(const sim::StatementFile& file, std::string_view text);

/// Checks that a problem reads "list:LINE: what", with a line that there is.
void check_problem(const FileProblem& problem, std::string_view text);

}  // namespace ridgeline::fuzz
