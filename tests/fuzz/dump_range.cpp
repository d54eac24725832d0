// The range file of a dumped frame, as the oracle reads it. An input is the frame's size (2 bytes)
// and the bytes of the file.
#include <cstring>
#include <string>
#include <vector>

#include "tests/fuzz/input_bytes.hpp"
#include "tests/fuzz/property.hpp"
#include "tests/oracle/dump.hpp"
#include "tests/oracle/input_error.hpp"

using namespace ridgeline;
using ridgeline::fuzz::must;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::InputBytes input(data, size);
  const int width = 1 + input.u8() % 16;
  const int height = 1 + input.u8() % 16;
  const std::string bytes(input.text());
  try {
    const std::vector<float> range = oracle::range_in("range.npy", bytes, width, height);
    must(range.size() == static_cast<std::size_t>(width * height), "a pixel has a distance");
    const std::size_t range_bytes = 4 * range.size();
    must(bytes.size() >= range_bytes + 10, "distances have a header before them");
    must(std::memcmp(range.data(), bytes.data() + bytes.size() - range_bytes, range_bytes) == 0,
         "distances are what the file ends with");
    must(bytes.find("'<f4'") < bytes.size() - range_bytes, "only floats are read");
  } catch (const oracle::InputError& error) {
    const std::string_view message = error.what();
    must(message.starts_with("range.npy: ") && message.size() > 11, "what is wrong is told");
  }
  return 0;
}
