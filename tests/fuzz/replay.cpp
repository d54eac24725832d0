// Feeds every input of a corpus to the fuzz target it is linked with, so that every build replays
// it, whatever its compiler. Usage: ridgeline-replay-TARGET CORPUS_FILE
// Exit status: 0 done; 1 a property does not hold; 2 wrong usage; 3 no corpus.
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>

#include "tests/fuzz/corpus_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

volatile std::sig_atomic_t current = 0;  ///< which input is replayed, from 1

}  // namespace

int main(int argument_count, char** arguments) {
  if (argument_count != 2) {
    std::fprintf(stderr, "usage: %s CORPUS_FILE\n", arguments[0]);
    return 2;
  }
  // A failed test, not a crash of it.
  std::signal(SIGABRT, [](int) {
    std::fprintf(stderr, "input %d of the corpus\n", static_cast<int>(current));
    std::_Exit(1);
  });
  try {
    const auto inputs = ridgeline::fuzz::corpus_inputs(arguments[1]);
    for (std::size_t index = 0; index < inputs.size(); ++index) {
      const std::string& input = inputs[index];
      // Its own memory of exactly this size: a sanitizer then sees one byte too many.
      const auto bytes = std::make_unique<std::uint8_t[]>(input.size());
      std::memcpy(bytes.get(), input.data(), input.size());
      current = static_cast<std::sig_atomic_t>(index + 1);
      LLVMFuzzerTestOneInput(bytes.get(), input.size());
    }
    std::printf("%zu inputs replayed\n", inputs.size());
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "%s\n", fault.what());
    return 3;
  }
  return 0;
}
