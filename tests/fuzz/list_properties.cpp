#include "tests/fuzz/list_properties.hpp"

#include <algorithm>
#include <string>

#include "tests/fuzz/property.hpp"

namespace ridgeline::fuzz {

void check_statements(const sim::StatementFile& file, std::string_view text) {
  const auto lines = std::count(text.begin(), text.end(), '\n') + 1;
  int line_before = 0;
  for (const sim::Statement& statement : file.statements) {
    must(statement.line > line_before && statement.line <= lines, "statements are in order");
    line_before = statement.line;
    must(!statement.text.empty() && statement.text.find('#') == std::string_view::npos &&
             statement.text.find('\n') == std::string_view::npos,
         "a statement is what a line says");
    const auto words = statement.words();
    must(!words.empty(), "a statement has words");
    for (const std::string_view word : words) {
      must(!word.empty() && word.find_first_of(" \t\r") == std::string_view::npos,
           "a word has no blanks");
    }
  }
}

void check_problem(const FileProblem& problem, std::string_view text) {
  const std::string& message = problem.message;
  must(message.starts_with("list:"), "a problem names its file");
  const std::size_t colon = message.find(": ", 5);
  must(colon != std::string::npos && colon > 5 && colon + 2 < message.size(),
       "a problem names its line and what is wrong");
  const auto line = std::stol(message.substr(5, colon - 5));
  must(line >= 1 && line <= std::count(text.begin(), text.end(), '\n') + 1,
       "the line of a problem is one of the file");
  must(std::all_of(message.begin(), message.end(), [](char c) { return c >= ' ' && c <= '~'; }),
       "a problem is one printable line");
}

}  // namespace ridgeline::fuzz
