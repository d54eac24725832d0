#include "core/bus/canaerospace.hpp"

#include <bit>
#include <cmath>
#include <cstddef>

#include "core/bus/clock_value.hpp"

namespace ridgeline {
namespace {

constexpr std::uint32_t id_count = 2048;
constexpr std::uint8_t no_row = 0xff;
constexpr std::uint8_t header_bytes = 4;
/// Angles further out than this are not angles that were left unwrapped, they are garbage.
constexpr double wrap_domain_deg = 720.0;
/// LONG positions count 1e-7 degree; dividing rounds once, multiplying by 1e-7 would round twice.
constexpr double position_units_per_deg = 1e7;

constexpr std::array<std::uint8_t, id_count> make_row_index() {
  std::array<std::uint8_t, id_count> index{};
  for (auto& entry : index) entry = no_row;
  for (std::size_t row = 0; row < bus_icd.size(); ++row) {
    index[bus_icd[row].id] = static_cast<std::uint8_t>(row);
  }
  return index;
}
constexpr std::array<std::uint8_t, id_count> row_index = make_row_index();

/// A 29-bit frame of channel 0 does not exist in the standard: such an id belongs to another
/// protocol.
bool id_has_canas_form(const BusFrame& frame) {
  const std::uint32_t base = frame.extended ? frame.id & 0xffffU : frame.id;
  return base < id_count && (!frame.extended || frame.id >> 16 != 0);
}

std::uint32_t u32_be(const std::array<std::uint8_t, 4>& data) {
  return std::uint32_t{data[0]} << 24 | std::uint32_t{data[1]} << 16 | std::uint32_t{data[2]} << 8 |
         std::uint32_t{data[3]};
}

std::int16_t i16_be(std::uint8_t high, std::uint8_t low) {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(high << 8 | low));
}

/// UTC is h, m, s as decimal bytes, date is day, month, century, year of century.
Result<double> clock_value(const BusIcdRow& row, const std::array<std::uint8_t, 4>& data) {
  if (row.parameter == BusParameter::utc) return second_of_day(data[0], data[1], data[2]);
  if (data[3] > 99) return Fault::bus_value_out_of_range;
  return days_since_1970(data[2] * 100U + data[3], data[1], data[0]);
}

/// SHORT2 {value, full scale}: value * scale / 32767 (section 5). A scale of zero or less says
/// nothing.
Result<double> analogue_value(const std::array<std::uint8_t, 4>& data) {
  const double value = i16_be(data[0], data[1]);
  const double scale = i16_be(data[2], data[3]);
  if (scale <= 0.0) return Fault::bus_value_out_of_range;
  return value * scale / 32767.0;
}

bool is_position_angle(const BusIcdRow& row) {
  return row.parameter == BusParameter::gps_latitude ||
         row.parameter == BusParameter::gps_longitude ||
         row.parameter == BusParameter::ins_latitude ||
         row.parameter == BusParameter::ins_longitude;
}

/// The type the data is to be read as, or why it cannot be.
Result<CanasType> accepted_type(const BusIcdRow& row, const CanasMessage& message) {
  const bool headerless = message.type == 0 && message.data_count == 4;
  const auto type = headerless ? row.quantity.field_type : static_cast<CanasType>(message.type);
  if (message.type >= canas_type_size_bytes.size()) return Fault::bus_type_mismatch;
  if (type == CanasType::short2 && is_position_angle(row)) return Fault::bus_resolution;
  if ((row.quantity.types & type_bit(type)) == 0) return Fault::bus_type_mismatch;
  return type;
}

Result<double> raw_value(const BusIcdRow& row, CanasType type, const CanasMessage& message) {
  switch (type) {
    case CanasType::float32:
      return static_cast<double>(std::bit_cast<float>(u32_be(message.data)));
    case CanasType::int32:
      return static_cast<double>(static_cast<std::int32_t>(u32_be(message.data))) /
             position_units_per_deg;
    case CanasType::short2:
      return analogue_value(message.data);
    case CanasType::char4:
      return clock_value(row, message.data);
    default:
      return Fault::bus_type_mismatch;
  }
}

}  // namespace

Result<CanasMessage> canas_message(const BusFrame& frame, HeaderRule rule) {
  if (frame.error || frame.remote) return Fault::bus_not_data;
  if (frame.fd) return Fault::bus_not_classic;
  if (!id_has_canas_form(frame)) return Fault::bus_id_unknown;
  if (frame.length < header_bytes || frame.length > header_bytes + 4) return Fault::bus_length;

  CanasMessage message;
  message.id = static_cast<std::uint16_t>(frame.id & 0x7ffU);
  message.channel = canas_channel(frame);
  message.node_id = frame.data[0];
  message.type = frame.data[1];
  message.service_code = frame.data[2];
  message.message_code = frame.data[3];
  message.data_count = static_cast<std::uint8_t>(frame.length - header_bytes);
  for (std::size_t index = 0; index < message.data_count; ++index) {
    message.data[index] = frame.data[header_bytes + index];
  }
  if (message.type >= canas_first_user_type) return message;
  if (message.type >= canas_type_size_bytes.size()) return Fault::bus_type_reserved;
  const bool headerless = rule == HeaderRule::field && message.type == 0 && message.data_count == 4;
  if (!headerless && message.data_count != canas_type_size_bytes[message.type]) {
    // NODATA with data is no length error: it is what senders without a header look like.
    return message.type == 0 ? Fault::bus_type_mismatch : Fault::bus_length;
  }
  return message;
}

std::optional<BusFrame> on_standard_channel(const BusFrame& frame, const ChannelOffsets& offsets) {
  if (offsets.count == 0) return frame;
  RL_ASSERT(offsets_are_distinct(offsets));
  for (std::uint32_t channel = 0; channel < offsets.count; ++channel) {
    const std::uint32_t offset = offsets.offset[channel];
    const bool is_mine =
        frame.extended == (offset != 0) && frame.id >= offset && frame.id - offset < id_count;
    if (!is_mine) continue;
    BusFrame moved = frame;
    moved.id = frame.id - offset + (channel << 16);
    moved.extended = channel != 0;
    return moved;
  }
  return std::nullopt;
}

std::uint16_t canas_channel(const BusFrame& frame) {
  return frame.extended ? static_cast<std::uint16_t>(frame.id >> 16) : std::uint16_t{0};
}

const BusIcdRow* icd_row_of(const BusFrame& frame) {
  if (frame.error || frame.remote || frame.fd || !id_has_canas_form(frame)) return nullptr;
  const std::uint8_t row = row_index[frame.id & 0x7ffU];
  return row == no_row ? nullptr : &bus_icd[row];
}

Result<DecodedValue> decode_canaerospace(const BusFrame& frame, const BusProfile& profile) {
  // An unknown id is not this display's business: whether its form is right is not judged.
  if (!frame.error && !frame.remote && !frame.fd && icd_row_of(frame) == nullptr) {
    return Fault::bus_id_unknown;
  }
  const Result<CanasMessage> message = canas_message(frame, profile.header_rule);
  if (!message) return message.fault();
  const BusIcdRow& row = *icd_row_of(frame);
  const Result<CanasType> type = accepted_type(row, message.value());
  if (!type) return type.fault();

  DecodedValue decoded;
  decoded.parameter = row.parameter;
  decoded.message = message.value();
  decoded.type = type.value();
  if (decoded.type == CanasType::double_high || decoded.type == CanasType::double_low) {
    decoded.part =
        decoded.type == CanasType::double_high ? ValuePart::high_half : ValuePart::low_half;
    decoded.half_bits = u32_be(decoded.message.data);
    return decoded;
  }
  const Result<double> raw = raw_value(row, decoded.type, decoded.message);
  if (!raw) return raw.fault();
  const Result<double> value = checked_value(row, raw.value());
  if (!value) return value.fault();
  decoded.value = value.value();
  return decoded;
}

double wrapped_deg(double angle_deg) {
  const double wrapped = std::remainder(angle_deg, 360.0);
  return wrapped >= 180.0 ? wrapped - 360.0 : wrapped;
}

double double_of_halves(std::uint32_t high, std::uint32_t low) {
  return std::bit_cast<double>(std::uint64_t{high} << 32 | low);
}

Result<double> checked_value(const BusIcdRow& row, double value) {
  if (!std::isfinite(value)) return Fault::bus_value_not_finite;
  if (row.quantity.wraps) {
    if (std::abs(value) > wrap_domain_deg) return Fault::bus_value_out_of_range;
    value = wrapped_deg(value);
  }
  if (value < row.quantity.minimum || value > row.quantity.maximum)
    return Fault::bus_value_out_of_range;
  return value;
}

}  // namespace ridgeline
