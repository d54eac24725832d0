#pragma once
#include <bit>
#include <cstdint>
#include <initializer_list>
#include <string_view>

#include "config/bus_icd.hpp"
#include "core/bus/bus_frame.hpp"
#include "sim/log/candump_line.hpp"

/// Frames the bus tests are written with.
namespace ridgeline::testing {

inline constexpr std::int64_t ms = 1'000'000;
inline constexpr std::int64_t start_ns = 1'700'000'000'000 * ms;

/// A frame in candump notation, e.g. "137#0102002A40F00000", at a time in milliseconds after the
/// start.
inline BusFrame frame_of(std::string_view text, double time_ms = 0.0) {
  BusFrame frame = candump_line(std::string("(1.0) can0 ").append(text)).frame;
  frame.time_ns = start_ns + static_cast<std::int64_t>(time_ms * 1e6);
  return frame;
}

inline BusFrame raw_frame(std::uint16_t id, CanasType type, std::uint32_t bits, double time_ms,
                          std::uint8_t code = 0, std::uint8_t node = 1) {
  BusFrame frame;
  frame.time_ns = start_ns + static_cast<std::int64_t>(time_ms * 1e6);
  frame.id = id;
  frame.length = 8;
  frame.data = {node,
                static_cast<std::uint8_t>(type),
                0,
                code,
                static_cast<std::uint8_t>(bits >> 24),
                static_cast<std::uint8_t>(bits >> 16),
                static_cast<std::uint8_t>(bits >> 8),
                static_cast<std::uint8_t>(bits)};
  return frame;
}

inline BusFrame float_of(BusParameter parameter, double value, double time_ms,
                         std::uint8_t node = 1) {
  return raw_frame(icd_row(parameter).id, CanasType::float32,
                   std::bit_cast<std::uint32_t>(static_cast<float>(value)), time_ms, 0, node);
}

inline BusFrame long_of(BusParameter parameter, double angle_deg, double time_ms,
                        std::uint8_t node = 1) {
  const double units = angle_deg * 1e7;
  const auto rounded = static_cast<std::int32_t>(units < 0.0 ? units - 0.5 : units + 0.5);
  return raw_frame(icd_row(parameter).id, CanasType::int32, static_cast<std::uint32_t>(rounded),
                   time_ms, 0, node);
}

/// One half of a DOUBLE.
inline BusFrame half_of(BusParameter parameter, double value, bool high, std::uint8_t code,
                        double time_ms, std::uint8_t node = 1) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  return raw_frame(icd_row(parameter).id, high ? CanasType::double_high : CanasType::double_low,
                   static_cast<std::uint32_t>(high ? bits >> 32 : bits), time_ms, code, node);
}

}  // namespace ridgeline::testing
