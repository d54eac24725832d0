// Requests of CANaerospace node services. An input is what this node is (3 bytes) and frames.
#include <algorithm>
#include <optional>

#include "core/bus/canas_services.hpp"
#include "tests/fuzz/input_bytes.hpp"
#include "tests/fuzz/log_properties.hpp"
#include "tests/fuzz/property.hpp"

using ridgeline::BusFrame;
using ridgeline::CanasIdentity;
using ridgeline::Fault;
using ridgeline::Result;
using ridgeline::fuzz::InputBytes;
using ridgeline::fuzz::must;

namespace {

BusFrame request_from(InputBytes& input) {
  BusFrame frame;
  const std::uint8_t form = input.u8();
  frame.remote = (form & 0x07U) == 0x07U;
  frame.error = (form & 0x0fU) == 0x0bU;
  frame.fd = (form & 0x0fU) == 0x0dU;
  frame.extended = !frame.error && (form & 0xf0U) == 0xf0U;
  frame.id = (form & 0x10U) != 0 ? input.u16() & 0x7ffU : 128U;
  frame.interface = form >> 7U;
  frame.length = static_cast<std::uint8_t>((form & 0x20U) != 0 ? input.below(9) : 4);
  if ((form & 0x40U) != 0) frame.length = 8;
  if (frame.remote) return frame;
  const auto bytes = input.bytes(frame.length);
  std::copy(bytes.begin(), bytes.end(), frame.data.begin());
  return frame;
}

void check_reply(const BusFrame& request, const BusFrame& reply, const CanasIdentity& self) {
  must(!request.remote && !request.error && !request.fd && !request.extended,
       "only classic data frames are answered");
  must(request.id == 128 && request.length == 4 && request.data[1] == 0 && request.data[2] == 0,
       "only identification requests are answered");
  must(request.data[0] == 0 || request.data[0] == self.node_id,
       "only what is sent to this node or to all is answered");
  ridgeline::fuzz::check_frame(reply);
  must(reply.id == 129 && reply.length == 8 && reply.data[0] == self.node_id &&
           reply.data[3] == request.data[3] && reply.data[4] == self.hardware_revision &&
           reply.data[5] == self.software_revision,
       "an answer says who this is, to the request");
  must(reply.time_ns == request.time_ns && reply.interface == request.interface,
       "an answer goes where the request came from");
  must(!ridgeline::ids_reply(reply, self), "an answer is not answered");
}

void check_stamp(const BusFrame& frame) {
  const Result<std::uint32_t> stamp = ridgeline::nss_time_stamp(frame);
  const bool is_data = !frame.remote && !frame.error && !frame.fd;
  if (!stamp) {
    must(is_data || stamp.fault() == Fault::bus_not_data || stamp.fault() == Fault::bus_not_classic,
         "what is no data frame is told");
    return;
  }
  must(is_data && !frame.extended && frame.length == 8 && frame.data[1] == 4 && frame.data[2] == 1,
       "a time stamp comes in a synchronisation frame");
  must(frame.id % 2 == 0 &&
           ((frame.id >= 128 && frame.id < 200) || (frame.id >= 2000 && frame.id < 2032)),
       "a time stamp comes on a request channel");
  std::uint32_t bits = 0;
  for (std::size_t byte = 4; byte < 8; ++byte) bits = bits << 8U | frame.data[byte];
  must(stamp.value() == bits, "a time stamp is the last four bytes");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  InputBytes input(data, size);
  CanasIdentity self;
  self.node_id = std::max<std::uint8_t>(1, input.u8());
  self.hardware_revision = input.u8();
  self.software_revision = input.u8();
  while (!input.empty()) {
    const BusFrame frame = request_from(input);
    const std::optional<BusFrame> reply = ridgeline::ids_reply(frame, self);
    if (reply) check_reply(frame, *reply, self);
    check_stamp(frame);
    must(!reply || !ridgeline::nss_time_stamp(frame), "a frame is of one service");
  }
  return 0;
}
