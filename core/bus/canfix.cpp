#include "core/bus/canfix.hpp"

#include <bit>

#include "core/bus/clock_value.hpp"

namespace ridgeline {
namespace {

constexpr std::uint8_t header_bytes = 3;

/// Little-endian number of `count` data bytes, from byte `first` of the data on.
std::uint32_t u_le(const BusFrame& frame, std::size_t first, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t index = 0; index < count; ++index) {
    value |= std::uint32_t{frame.data[header_bytes + first + index]} << (8 * index);
  }
  return value;
}

/// What the function code says against the value, or none.
Fault fault_of_function(std::uint8_t function) {
  if ((function & canfix_metadata_mask) != 0) return Fault::bus_not_value;
  if ((function & canfix_failure_bit) != 0) return Fault::bus_failure_warning;
  if ((function & canfix_quality_bit) != 0) return Fault::bus_quality;
  if ((function & canfix_reserved_bit) != 0) return Fault::bus_type_reserved;
  return Fault::none;
}

Result<double> raw_value(const BusFrame& frame, CanfixType type) {
  switch (type) {
    case CanfixType::int16:
      return static_cast<double>(static_cast<std::int16_t>(u_le(frame, 0, 2)));
    case CanfixType::uint16:
      return static_cast<double>(u_le(frame, 0, 2));
    case CanfixType::int32:
      return static_cast<double>(static_cast<std::int32_t>(u_le(frame, 0, 4)));
    case CanfixType::float32:
      return static_cast<double>(std::bit_cast<float>(u_le(frame, 0, 4)));
    case CanfixType::time: {
      const Result<double> second =
          second_of_day(u_le(frame, 0, 1), u_le(frame, 1, 1), u_le(frame, 2, 1));
      const std::uint32_t ms = u_le(frame, 3, 2);
      if (!second) return second.fault();
      if (ms > 999) return Fault::bus_value_out_of_range;
      return second.value() + ms / 1000.0;
    }
  }
  return Fault::bus_type_mismatch;
}

}  // namespace

const CanfixRow* canfix_row_of(const BusFrame& frame) {
  if (frame.error || frame.remote || frame.fd || frame.extended) return nullptr;
  return canfix_row(frame.id);
}

Result<double> canfix_value(const BusFrame& frame, const BusProfile& profile) {
  if (frame.error || frame.remote) return Fault::bus_not_data;
  if (frame.fd) return Fault::bus_not_classic;
  const CanfixRow* row = canfix_row_of(frame);
  if (row == nullptr) return Fault::bus_id_unknown;
  if (frame.length < header_bytes) return Fault::bus_length;
  const Fault fault = fault_of_function(frame.data[2]);
  if (fault != Fault::none) return fault;
  if (frame.length != header_bytes + canfix_size_bytes(row->type)) return Fault::bus_length;
  if (row->parameter == BusParameter::gps_height && !profile.canfix_height_is_ellipsoidal) {
    return Fault::bus_datum_unknown;
  }
  const Result<double> raw = raw_value(frame, row->type);
  if (!raw) return raw.fault();
  return raw.value() * row->unit_per_step;
}

}  // namespace ridgeline
