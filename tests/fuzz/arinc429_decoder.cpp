// ARINC 429 words in CAN frames, decoded one after the other. An input is a profile and frames
// (bus_input.hpp).
#include "tests/fuzz/decoder_properties.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ridgeline::fuzz::check_decoder(data, size, ridgeline::BusProtocol::arinc429);
  return 0;
}
