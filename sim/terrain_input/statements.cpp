#include "sim/terrain_input/statements.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "platform/mapped_file.hpp"

namespace ridgeline::sim {
namespace {

constexpr std::size_t longest_shown = 24;
constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
constexpr std::string_view blanks = " \t\r";

std::string_view without_comment(std::string_view line) {
  line = line.substr(0, line.find('#'));
  const std::size_t first = line.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return line.substr(first, line.find_last_not_of(blanks) - first + 1);
}

}  // namespace

std::vector<std::string_view> Statement::words() const {
  std::vector<std::string_view> list;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t first = text.find_first_not_of(blanks, at);
    if (first == std::string_view::npos) break;
    at = std::min(text.find_first_of(blanks, first), text.size());
    list.push_back(text.substr(first, at - first));
  }
  return list;
}

FileProblem StatementFile::problem(Fault fault, int line, const std::string& what) const {
  return {fault, path, path + ":" + std::to_string(line) + ": " + what};
}

FileResult<StatementFile> statements_of(const std::string& path) {
  const Result<MappedFile> mapping = MappedFile::open(path.c_str());
  if (!mapping.ok()) return file_problem(path, Fault::file_unreadable, std::strerror(errno));
  const auto bytes = mapping.value().bytes();
  return statements_in(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

FileResult<StatementFile> statements_in(const std::string& path, std::string_view text) {
  if (text.size() > most_statement_bytes) {
    return file_problem(path, Fault::capacity_exceeded,
                        "more than " + std::to_string(most_statement_bytes) + " bytes");
  }
  StatementFile file;
  file.path = path;
  file.text.assign(text.begin(), text.end());
  std::string_view rest(file.text.data(), file.text.size());
  if (rest.starts_with(byte_order_mark)) rest.remove_prefix(byte_order_mark.size());
  for (int line = 1; !rest.empty(); ++line) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view said = without_comment(rest.substr(0, end));
    if (!said.empty()) file.statements.push_back({line, said});
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return file;
}

std::string shown(std::string_view word) {
  std::string text = "'";
  for (const char c : word.substr(0, longest_shown)) text += c >= ' ' && c <= '~' ? c : '?';
  return text + (word.size() > longest_shown ? "...'" : "'");
}

}  // namespace ridgeline::sim
