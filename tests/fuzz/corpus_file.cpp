#include "tests/fuzz/corpus_file.hpp"

#include <fstream>
#include <stdexcept>
#include <string_view>

namespace ridgeline::fuzz {
namespace {

int hex_digit(char c) {
  constexpr std::string_view digits = "0123456789abcdef";
  const std::size_t at = digits.find(c);
  return at == std::string_view::npos ? -1 : static_cast<int>(at);
}

/// The input that a line stands for; false where an escape is none.
bool take_line(std::string_view line, std::string& input) {
  for (std::size_t at = 0; at < line.size(); ++at) {
    if (line[at] != '\\') {
      input += line[at];
      continue;
    }
    if (++at == line.size()) return false;
    constexpr std::string_view names = "ntr\\", bytes = "\n\t\r\\";
    if (const std::size_t name = names.find(line[at]); name != std::string_view::npos) {
      input += bytes[name];
      continue;
    }
    if (line[at] != 'x' || line.size() < at + 3) return false;
    const int high = hex_digit(line[at + 1]), low = hex_digit(line[at + 2]);
    if (high < 0 || low < 0) return false;
    input += static_cast<char>(high * 16 + low);
    at += 2;
  }
  return true;
}

}  // namespace

std::vector<std::string> corpus_inputs(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path + ": cannot be opened");
  std::vector<std::string> inputs;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.empty() || line.front() == '#') continue;
    std::string input;
    if (!take_line(line, input)) {
      throw std::runtime_error(path + ":" + std::to_string(number) + ": an escape is none");
    }
    inputs.push_back(std::move(input));
  }
  if (inputs.empty()) throw std::runtime_error(path + ": holds no input");
  return inputs;
}

std::string corpus_line(const std::string& input) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string line;
  for (const char c : input) {
    const auto byte = static_cast<unsigned char>(c);
    const bool opens_comment = line.empty() && c == '#';
    if (c == '\n') {
      line += "\\n";
    } else if (c == '\t') {
      line += "\\t";
    } else if (c == '\r') {
      line += "\\r";
    } else if (c == '\\') {
      line += "\\\\";
    } else if (byte < ' ' || byte > '~' || opens_comment) {
      line += "\\x";
      line += digits[byte >> 4U];
      line += digits[byte & 15U];
    } else {
      line += c;
    }
  }
  return line;
}

}  // namespace ridgeline::fuzz
