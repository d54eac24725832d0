#include "core/bus/bus_decoder.hpp"

#include "core/bus/canaerospace.hpp"
#include "core/bus/canfix.hpp"

namespace ridgeline {
namespace {

/// Which of the two remembered coordinates a parameter is.
std::size_t coordinate_of(BusParameter parameter) {
  return parameter == BusParameter::gps_latitude ? 0 : 1;
}

std::uint8_t first_byte(const BusFrame& frame) {
  return frame.length > 0 ? frame.data[0] : std::uint8_t{0};
}

/// The value of a step in the range of its parameter, or why not.
void finish(DecodeStep& step, BusParameter parameter, double value, const Source& source,
            std::int64_t time_ns) {
  const Result<double> checked = checked_value(icd_row(parameter), value);
  if (!checked) {
    step.fault = checked.fault();
    return;
  }
  step.value = BusValue{parameter, checked.value(), time_ns, source};
}

Source canas_source(const BusFrame& frame) {
  return {frame.interface, first_byte(frame), canas_channel(frame)};
}

std::optional<FrameTopic> canas_topic(const BusFrame& frame, const BusProfile& profile) {
  const std::optional<BusFrame> standard = on_standard_channel(frame, profile.channel_offsets);
  const BusIcdRow* row = standard ? icd_row_of(*standard) : nullptr;
  if (row == nullptr) return std::nullopt;
  const Source source = canas_source(*standard);
  return FrameTopic{row->parameter, source, reads_channel(profile, source.channel)};
}

DecodeStep canas_step(const DecoderMemory& memory, const BusFrame& frame,
                      const BusProfile& profile) {
  DecodeStep step{memory, std::nullopt, Fault::none, false};
  const std::optional<BusFrame> standard = on_standard_channel(frame, profile.channel_offsets);
  if (!standard) {
    const bool is_data = !frame.error && !frame.remote && !frame.fd;
    step.fault = is_data ? Fault::bus_id_unknown : Fault::bus_not_data;
    return step;
  }
  const Result<DecodedValue> decoded = decode_canaerospace(*standard, profile);
  if (!decoded) {
    step.fault = decoded.fault();
    return step;
  }
  const DecodedValue& value = decoded.value();
  const Source source = canas_source(*standard);
  if (value.part == ValuePart::whole) {
    step.value = BusValue{value.parameter, value.value, frame.time_ns, source};
    return step;
  }
  DoublePairs& halves = step.memory.halves[coordinate_of(value.parameter)];
  const DoublePairStep pair = paired_double(halves, value, *standard, profile);
  halves = pair.next;
  step.unpaired = pair.unpaired;
  if (pair.value) finish(step, value.parameter, *pair.value, source, frame.time_ns);
  return step;
}

std::optional<FrameTopic> arinc429_topic(const BusFrame& frame, const BusProfile& profile) {
  const Result<Arinc429Reading> reading = arinc429_reading(frame, profile.arinc429);
  if (!reading) return std::nullopt;
  return FrameTopic{reading.value().row->parameter, reading.value().source, true};
}

DecodeStep arinc429_step(const DecoderMemory& memory, const BusFrame& frame,
                         const BusProfile& profile) {
  DecodeStep step{memory, std::nullopt, Fault::none, false};
  const Result<Arinc429Reading> reading = arinc429_reading(frame, profile.arinc429);
  if (!reading) {
    step.fault = reading.fault();
    return step;
  }
  const BusParameter parameter = reading.value().row->parameter;
  // Only the two GNSS coordinates have a memory; other words leave it as it is.
  CoarseWord& coarse = step.memory.coarse[coordinate_of(parameter)];
  const Arinc429Step word =
      arinc429_value(coarse, reading.value(), frame.time_ns, profile.arinc429);
  coarse = word.next;
  step.unpaired = word.unpaired;
  step.fault = word.fault;
  if (word.value) finish(step, parameter, *word.value, reading.value().source, frame.time_ns);
  return step;
}

std::optional<FrameTopic> canfix_topic(const BusFrame& frame, const BusProfile& profile) {
  const CanfixRow* row = canfix_row_of(frame);
  if (row == nullptr) return std::nullopt;
  const std::uint8_t index = frame.length > 1 ? frame.data[1] : std::uint8_t{0};
  const Source source{frame.interface, first_byte(frame), index};
  return FrameTopic{row->parameter, source, reads_channel(profile, index)};
}

DecodeStep canfix_step(const DecoderMemory& memory, const BusFrame& frame,
                       const BusProfile& profile) {
  DecodeStep step{memory, std::nullopt, Fault::none, false};
  const Result<double> value = canfix_value(frame, profile);
  if (!value) {
    step.fault = value.fault();
    return step;
  }
  const FrameTopic topic = *canfix_topic(frame, profile);
  finish(step, topic.parameter, value.value(), topic.source, frame.time_ns);
  return step;
}

}  // namespace

std::optional<FrameTopic> frame_topic(const BusFrame& frame, const BusProfile& profile) {
  switch (profile.protocol) {
    case BusProtocol::canaerospace:
      return canas_topic(frame, profile);
    case BusProtocol::arinc429:
      return arinc429_topic(frame, profile);
    case BusProtocol::canfix:
      return canfix_topic(frame, profile);
  }
  return std::nullopt;
}

DecodeStep decoded_frame(const DecoderMemory& memory, const BusFrame& frame,
                         const BusProfile& profile) {
  switch (profile.protocol) {
    case BusProtocol::arinc429:
      return arinc429_step(memory, frame, profile);
    case BusProtocol::canfix:
      return canfix_step(memory, frame, profile);
    case BusProtocol::canaerospace:
      break;
  }
  return canas_step(memory, frame, profile);
}

bool disowns_value(Fault fault) {
  switch (fault) {
    case Fault::bus_value_not_finite:
    case Fault::bus_value_out_of_range:
    case Fault::bus_no_computed_data:
    case Fault::bus_functional_test:
    case Fault::bus_failure_warning:
    case Fault::bus_quality:
    case Fault::bus_digit:
      return true;
    default:
      return false;
  }
}

}  // namespace ridgeline
