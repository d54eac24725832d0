#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace ridgeline::oracle {

/// The words of one line of a text file.
struct Statement {
  int line = 0;  ///< from 1
  std::vector<std::string_view> words;
};

/// Reads a text file of one statement a line: `#` starts a comment, lines without a word are left
/// out, words end at spaces, tabs and carriage returns; a byte order mark is no word.
/// Domain: at most 16 MiB.
/// Owner:  the words are valid inside `take` only.
/// Errors: InputError naming the file.
void for_each_statement(const std::filesystem::path& file,
                        const std::function<void(const Statement&)>& take);

/// The same for the text of a file, of any length.
void for_each_statement_in(std::string_view text,
                           const std::function<void(const Statement&)>& take);

/// Throws the InputError `FILE: line N: FAULT`.
[[noreturn]] void wrong_statement(const std::filesystem::path& file, int line,
                                  const std::string& fault);

}  // namespace ridgeline::oracle
