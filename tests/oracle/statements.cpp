#include "tests/oracle/statements.hpp"

#include <algorithm>
#include <fstream>
#include <string>

#include "tests/oracle/input_error.hpp"

namespace ridgeline::oracle {
namespace {

constexpr std::size_t longest_file_bytes = std::size_t{16} << 20U;

std::string text_of(const std::filesystem::path& file) {
  std::error_code fault;
  if (std::filesystem::is_directory(file, fault)) throw InputError(file.string(), "is a folder");
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(file.string(), "cannot be opened");
  std::string text(longest_file_bytes + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad()) throw InputError(file.string(), "cannot be read");
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.size() > longest_file_bytes) throw InputError(file.string(), "is longer than 16 MiB");
  return text;
}

std::vector<std::string_view> words_of(std::string_view line) {
  constexpr std::string_view blanks = " \t\r";
  std::vector<std::string_view> words;
  line = line.substr(0, line.find('#'));
  for (std::size_t at = line.find_first_not_of(blanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(blanks, end);
  }
  return words;
}

}  // namespace

void for_each_statement(const std::filesystem::path& file,
                        const std::function<void(const Statement&)>& take) {
  for_each_statement_in(text_of(file), take);
}

void for_each_statement_in(std::string_view rest,
                           const std::function<void(const Statement&)>& take) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (rest.starts_with(byte_order_mark)) rest.remove_prefix(byte_order_mark.size());
  for (int line = 1; !rest.empty(); ++line) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const Statement statement{line, words_of(rest.substr(0, end))};
    if (!statement.words.empty()) take(statement);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
}

void wrong_statement(const std::filesystem::path& file, int line, const std::string& fault) {
  throw InputError(file.string(), "line " + std::to_string(line) + ": " + fault);
}

}  // namespace ridgeline::oracle
