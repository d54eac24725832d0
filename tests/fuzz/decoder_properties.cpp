#include "tests/fuzz/decoder_properties.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/bus/bus_decoder.hpp"
#include "core/bus/can_filters.hpp"
#include "core/bus/canaerospace.hpp"
#include "tests/fuzz/bus_input.hpp"
#include "tests/fuzz/log_properties.hpp"
#include "tests/fuzz/property.hpp"

namespace ridgeline::fuzz {
namespace {

bool is_same(const DoublePairs& a, const DoublePairs& b) {
  return a.pending == b.pending && a.part == b.part && a.half_bits == b.half_bits &&
         a.message_code == b.message_code && a.node_id == b.node_id && a.interface == b.interface &&
         a.time_ns == b.time_ns && a.order == b.order && a.against_order == b.against_order;
}

bool is_same(const CoarseWord& a, const CoarseWord& b) {
  return a.pending == b.pending && a.changed == b.changed && a.bits == b.bits &&
         a.time_ns == b.time_ns && a.source == b.source;
}

/// Which of the two remembered coordinates a topic is, or neither.
std::optional<std::size_t> coordinate_of(const std::optional<FrameTopic>& topic) {
  if (topic && topic->parameter == BusParameter::gps_latitude) return 0;
  if (topic && topic->parameter == BusParameter::gps_longitude) return 1;
  return std::nullopt;
}

void check_value(const BusValue& value, const FrameTopic& topic, const BusFrame& frame) {
  const BusQuantity& quantity = icd_row(value.parameter).quantity;
  must(std::isfinite(value.value), "a value is finite");
  must(value.value >= quantity.minimum && value.value <= quantity.maximum,
       "a value is within the range of its row");
  must(!quantity.wraps || value.value < 180.0, "an angle is below 180 degrees");
  must(value.parameter == topic.parameter, "a value is of the frame's parameter");
  must(value.source == topic.source, "a value is of the frame's source");
  must(value.time_ns == frame.time_ns, "a value has the frame's time");
}

/// A value of two frames: its first half was there, from the same sender, not long ago.
void check_pair(const DecoderMemory& before, std::size_t coordinate, const BusFrame& frame,
                const BusProfile& profile) {
  const DoublePairs& half = before.halves[coordinate];
  const CoarseWord& coarse = before.coarse[coordinate];
  if (half.pending && profile.protocol == BusProtocol::canaerospace) {
    const bool is_half = frame.data[1] == static_cast<std::uint8_t>(CanasType::double_high) ||
                         frame.data[1] == static_cast<std::uint8_t>(CanasType::double_low);
    const std::int64_t gap_ns = frame.time_ns - half.time_ns;
    must(!is_half || (gap_ns >= 0 && gap_ns <= profile.double_pair_limit_ns &&
                      half.node_id == frame.data[0] && half.interface == frame.interface),
         "halves are of one sender and close in time");
  }
  if (profile.protocol == BusProtocol::arinc429 &&
      profile.arinc429.fine_rule != FineRule::coarse_alone) {
    const std::int64_t gap_ns = frame.time_ns - coarse.time_ns;
    must(coarse.pending && !coarse.changed && gap_ns >= 0 &&
             gap_ns <= profile.arinc429.fine_pair_limit_ns &&
             coarse.source.interface == frame.interface,
         "a fine word has its coarse word");
  }
}

void check_memory(const DecoderMemory& before, const DecodeStep& step,
                  std::optional<std::size_t> coordinate) {
  for (std::size_t other = 0; other < 2; ++other) {
    if (coordinate == other) continue;
    must(is_same(before.halves[other], step.memory.halves[other]) &&
             is_same(before.coarse[other], step.memory.coarse[other]),
         "a frame changes no other coordinate's memory");
  }
  if (step.value || step.fault != Fault::none) return;
  must(coordinate &&
           (step.memory.halves[*coordinate].pending || step.memory.coarse[*coordinate].pending),
       "a frame without value and fault is half a value");
}

void check_step(const DecoderMemory& before, const DecodeStep& step, const BusFrame& frame,
                const BusProfile& profile) {
  const std::optional<FrameTopic> topic = frame_topic(frame, profile);
  const bool is_data = !frame.error && !frame.remote && !frame.fd;
  must(!step.value || step.fault == Fault::none, "a fault gives no value");
  must(is_data || (!topic && !step.value && step.fault != Fault::none),
       "what is no data frame says nothing");
  must(topic || !step.value, "a value has a topic");
  must(topic || !disowns_value(step.fault), "a disowned value has a topic");
  const std::optional<std::size_t> coordinate = coordinate_of(topic);
  check_memory(before, step, coordinate);
  if (!step.value) return;
  check_value(*step.value, *topic, frame);
  if (coordinate) check_pair(before, *coordinate, frame, profile);
}

void check_filters(const CanFilters& filters, const BusFrame& frame, const BusProfile& profile) {
  const std::optional<FrameTopic> topic = frame_topic(frame, profile);
  if (!topic || !topic->is_read) return;
  const bool passes =
      std::any_of(filters.begin(), filters.end(), [&frame](const CanFilter& filter) {
        return filter.id == frame.id && filter.extended == frame.extended;
      });
  must(passes, "what is read passes the filters");
}

}  // namespace

void check_decoder(const std::uint8_t* data, std::size_t size, BusProtocol protocol) {
  InputBytes input(data, size);
  const BusProfile profile = profile_from(input, protocol);
  const Result<CanFilters> filters = can_filters(profile);
  must(filters.ok(), "a profile's identifiers fit");
  DecoderMemory memory;
  std::int64_t time_ns = 1'700'000'000'000'000'000;
  while (!input.empty()) {
    time_ns = time_from(input, time_ns);
    const BusFrame frame = frame_from(input, profile, time_ns);
    const DecodeStep step = decoded_frame(memory, frame, profile);
    check_step(memory, step, frame, profile);
    check_filters(filters.value(), frame, profile);
    memory = step.memory;
  }
}

}  // namespace ridgeline::fuzz
