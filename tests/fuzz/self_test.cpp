// A target whose property fails for one input: shows that a failing property is seen.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/input_bytes.hpp"
#include "tests/fuzz/property.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const ridgeline::fuzz::InputBytes input(data, size);
  ridgeline::fuzz::must(input.text() != "false", "the input is not false");
  return 0;
}
