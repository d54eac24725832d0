// Turns a corpus file into the folder of files that libFuzzer works on, and back.
// Usage: ridgeline-corpus unpack CORPUS_FILE FOLDER
//        ridgeline-corpus pack FOLDER CORPUS_FILE    (shortest input first)
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "tests/fuzz/corpus_file.hpp"

namespace {

namespace fs = std::filesystem;

void unpack(const std::string& file, const fs::path& folder) {
  fs::create_directories(folder);
  std::size_t number = 0;
  for (const std::string& input : ridgeline::fuzz::corpus_inputs(file)) {
    std::ofstream out(folder / ("kept_" + std::to_string(++number)), std::ios::binary);
    out << input;
    if (!out.flush()) throw std::runtime_error(folder.string() + ": cannot be written");
  }
  std::printf("%zu inputs in %s\n", number, folder.c_str());
}

void pack(const fs::path& folder, const std::string& file) {
  std::vector<std::string> inputs;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    std::ifstream in(entry.path(), std::ios::binary);
    inputs.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    if (inputs.back().empty()) inputs.pop_back();
  }
  std::sort(inputs.begin(), inputs.end(), [](const std::string& a, const std::string& b) {
    return std::make_tuple(a.size(), std::cref(a)) < std::make_tuple(b.size(), std::cref(b));
  });
  std::ofstream out(file, std::ios::binary);
  for (const std::string& input : inputs) out << ridgeline::fuzz::corpus_line(input) << '\n';
  if (!out.flush()) throw std::runtime_error(file + ": cannot be written");
  std::printf("%zu inputs in %s\n", inputs.size(), file.c_str());
}

}  // namespace

int main(int argument_count, char** arguments) {
  const std::string what = argument_count == 4 ? arguments[1] : "";
  try {
    if (what == "unpack") {
      unpack(arguments[2], arguments[3]);
    } else if (what == "pack") {
      pack(arguments[2], arguments[3]);
    } else {
      std::fprintf(stderr, "usage: %s unpack CORPUS_FILE FOLDER | pack FOLDER CORPUS_FILE\n",
                   arguments[0]);
      return 2;
    }
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "%s\n", fault.what());
    return 3;
  }
  return 0;
}
