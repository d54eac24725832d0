#pragma once
#include <string>
#include <vector>

namespace ridgeline::fuzz {

/// A corpus is one text file: an input a line, `#` lines and blank ones aside. Inside an input
/// `\n`, `\t`, `\r`, `\\` and `\xNN` stand for bytes, everything else for itself.
/// Errors: std::runtime_error naming file and line, also where there is no input at all.
[[nodiscard]] std::vector<std::string> corpus_inputs(const std::string& path);

/// An input as a line of such a file.
[[nodiscard]] std::string corpus_line(const std::string& input);

}  // namespace ridgeline::fuzz
