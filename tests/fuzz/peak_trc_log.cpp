// PEAK TRC logs. An input is the text of a log.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/input_bytes.hpp"
#include "tests/fuzz/log_properties.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const ridgeline::fuzz::InputBytes input(data, size);
  ridgeline::fuzz::check_log(input.text(), ridgeline::LogFormat::peak_trc);
  return 0;
}
