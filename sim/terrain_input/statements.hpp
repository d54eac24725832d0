#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "platform/file_result.hpp"

namespace ridgeline::sim {

/// One line of an input file that says something.
struct Statement {
  int line = 0;  ///< from 1
  std::string_view text;

  /// The words of the text, split at spaces, tabs and carriage returns.
  [[nodiscard]] std::vector<std::string_view> words() const;
};

/// A text file of statements, one a line: `#` starts a comment, lines without anything else are
/// passed over, a carriage return is a blank, and a byte order mark does not count.
/// Owner: the statements view `text`; move-only.
struct StatementFile {
  std::string path;
  std::vector<char> text;
  std::vector<Statement> statements;

  StatementFile() = default;
  StatementFile(StatementFile&&) = default;
  StatementFile& operator=(StatementFile&&) = default;
  StatementFile(const StatementFile&) = delete;
  StatementFile& operator=(const StatementFile&) = delete;

  /// "PATH:LINE: what is wrong".
  [[nodiscard]] FileProblem problem(Fault fault, int line, const std::string& what) const;
};

/// Larger files are refused: both kinds of input are far below it at their limits.
inline constexpr std::size_t most_statement_bytes = std::size_t{8} << 20U;

/// Reads a file of statements. Domain: a regular file, else Fault::file_unreadable with the
/// system's reason; at most most_statement_bytes, else Fault::capacity_exceeded.
FileResult<StatementFile> statements_of(const std::string& path);

/// The statements in the text of a file named `path`; as statements_of().
FileResult<StatementFile> statements_in(const std::string& path, std::string_view text);

/// A word of the file as it may stand in a message: printable, at most 24 characters, in quotes.
[[nodiscard]] std::string shown(std::string_view word);

}  // namespace ridgeline::sim
