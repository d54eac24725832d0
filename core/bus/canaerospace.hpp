#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "config/bus_icd.hpp"
#include "core/base/result.hpp"
#include "core/bus/bus_frame.hpp"
#include "core/bus/bus_profile.hpp"

namespace ridgeline {

/// Header and data bytes of one CANaerospace message, before its parameter is known.
struct CanasMessage {
  std::uint16_t id = 0;       ///< parameter identifier without the channel, 0..2047
  std::uint16_t channel = 0;  ///< redundancy channel: 0 for 11-bit frames, 1..8191 for 29-bit ones
  std::uint8_t node_id = 0;   ///< sender (normal operation data), 0 = broadcast
  std::uint8_t type = 0;      ///< type code as sent; CanasType where below 32
  std::uint8_t service_code = 0;
  std::uint8_t message_code = 0;  ///< +1 per message of a sender, wraps 255 -> 0
  std::uint8_t data_count = 0;    ///< data bytes that are valid, 0..4
  std::array<std::uint8_t, 4> data{};
};

/// Which part of a value one frame carries.
enum class ValuePart : std::uint8_t { whole, high_half, low_half };

/// One decoded frame.
struct DecodedValue {
  BusParameter parameter{};
  CanasMessage message;                 ///< header, for source and pairing
  CanasType type = CanasType::no_data;  ///< type the data was read as
  ValuePart part = ValuePart::whole;
  double value = 0.0;           ///< engineering value in the row's unit; 0 for halves
  std::uint32_t half_bits = 0;  ///< upper or lower 32 bits of an IEEE double, for halves
};

/// Splits a frame into header and data and checks its form.
/// Domain: classic data frame of 4..8 bytes, else bus_not_data, bus_not_classic or bus_length; id
/// 0..2047, or
///         29 bit with channel n > 0, else bus_id_unknown; type not 32..99, else bus_type_reserved;
///         length 4 + size of the type, else bus_length. User types (100..255) may have 0..4 data
///         bytes. With HeaderRule::field, type 0 may also have four data bytes.
/// Cost:   O(1); no allocation.
/// Source: CANaerospace v1.7, sections 2.2, 3 and 7.1.
[[nodiscard]] Result<CanasMessage> canas_message(const BusFrame& frame, HeaderRule rule);

/// The table row a frame's identifier names, on any channel; nullptr when the display does not read
/// it, or when the frame is no data frame.
[[nodiscard]] const BusIcdRow* icd_row_of(const BusFrame& frame);

/// The same frame with the identifier that the standard would give it, 65536 n above channel 0;
/// nothing where it is on none of the configured channels. With no configured offsets it is the
/// frame itself.
/// Domain: offsets_are_distinct(offsets), else RL_ASSERT.
[[nodiscard]] std::optional<BusFrame> on_standard_channel(const BusFrame& frame,
                                                          const ChannelOffsets& offsets);

/// Redundancy channel of a frame: 0 for 11-bit ids, id / 65536 for 29-bit ones.
[[nodiscard]] std::uint16_t canas_channel(const BusFrame& frame);

/// Decodes one frame into an engineering value by the table in config/bus_icd.hpp.
/// Units:  as the row says; angles wrapped into [-180, 180); UTC in seconds of the day; date in
/// days since 1970-01-01. Domain: canas_message() plus: id in the table, else bus_id_unknown; type
/// accepted by the row, else
///         bus_type_mismatch (bus_resolution for a SHORT2 position, which resolves 611 m); value
///         finite, else bus_value_not_finite; value within the row's range, else
///         bus_value_out_of_range.
/// Cost:   O(1); no allocation. Pure: halves of a DOUBLE are joined by DoublePairs
/// (double_pairs.hpp).
[[nodiscard]] Result<DecodedValue> decode_canaerospace(const BusFrame& frame,
                                                       const BusProfile& profile);

/// Angle brought into [-180, 180) degrees. NaN and infinity give NaN.
[[nodiscard]] double wrapped_deg(double angle_deg);

/// The double whose IEEE 754 bits are `high` and `low`.
[[nodiscard]] double double_of_halves(std::uint32_t high, std::uint32_t low);

/// Range check and wrapping of a value by its row; the last step of decoding, and that of joined
/// halves.
[[nodiscard]] Result<double> checked_value(const BusIcdRow& row, double value);

}  // namespace ridgeline
