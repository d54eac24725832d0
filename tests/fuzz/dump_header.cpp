// What a dumped frame says of itself, as the oracle reads it. An input is the text of its JSON.
#include <cmath>
#include <string>
#include <vector>

#include "tests/fuzz/input_bytes.hpp"
#include "tests/fuzz/property.hpp"
#include "tests/oracle/dump.hpp"
#include "tests/oracle/input_error.hpp"

using namespace ridgeline;
using ridgeline::fuzz::must;

namespace {

void check_frame(const oracle::Frame& frame) {
  must(frame.name == "000042", "a frame has the name of its file");
  must(frame.width >= 1 && frame.height >= 1 && frame.width <= 65536 && frame.height <= 65536,
       "a frame has a size");
  must(std::isfinite(frame.time_s), "a frame has a time");
  must(!frame.bound_px || *frame.bound_px <= 1024, "a bound says something");
  must(frame.range.empty(), "a header holds no distances");
  const std::vector<std::string> faults = oracle::frame_faults(frame);
  must(!faults.empty(), "a frame without its picture has a fault");
  for (const std::string& fault : faults) must(!fault.empty(), "a fault is told");
  if (frame.mode == oracle::Mode::removed) return;
  must(std::abs(frame.eye.lat_deg) <= 90 && std::abs(frame.eye.lon_deg) <= 360,
       "an eye is on the Earth");
  must(frame.fx > 0 && frame.fy > 0 && frame.range_m > 0 && frame.range_m <= 2e6,
       "a camera has a focal length and a range");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(fuzz::InputBytes(data, size).text());
  try {
    check_frame(oracle::frame_header_in("dump/000042.json", text, size % 2 == 0));
  } catch (const oracle::InputError& error) {
    const std::string_view message = error.what();
    must(message.starts_with("dump/000042.json: ") && message.find('\n') == message.npos,
         "what is wrong is one line that names the file");
  }
  return 0;
}
