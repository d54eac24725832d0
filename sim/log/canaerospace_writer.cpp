#include "sim/log/canaerospace_writer.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace ridgeline {
namespace {

BusFrame frame_of(BusParameter parameter, CanasType type, std::uint32_t bits, std::int64_t time_ns,
                  const CanasHeader& header) {
  BusFrame frame;
  frame.time_ns = time_ns;
  frame.id = icd_row(parameter).id;
  frame.length = 8;
  frame.data[0] = header.node_id;
  frame.data[1] = static_cast<std::uint8_t>(type);
  frame.data[2] = header.service_code;
  frame.data[3] = header.message_code;
  for (std::size_t index = 0; index < 4; ++index) {
    frame.data[4 + index] = static_cast<std::uint8_t>(bits >> (24 - 8 * index));
  }
  return frame;
}

std::chrono::sys_days day_of(std::int64_t time_ns) {
  return std::chrono::floor<std::chrono::days>(
      std::chrono::sys_time<std::chrono::nanoseconds>(std::chrono::nanoseconds(time_ns)));
}

std::uint32_t packed(unsigned a, unsigned b, unsigned c, unsigned d) {
  return a << 24 | b << 16 | c << 8 | d;
}

}  // namespace

BusFrame float_frame(BusParameter parameter, double value, std::int64_t time_ns,
                     const CanasHeader& header) {
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
  return frame_of(parameter, CanasType::float32, bits, time_ns, header);
}

BusFrame position_frame(BusParameter parameter, double angle_deg, std::int64_t time_ns,
                        const CanasHeader& header) {
  const double clamped_deg = std::clamp(angle_deg, -180.0, 180.0);
  const auto units = static_cast<std::int32_t>(std::llround(clamped_deg * 1e7));
  return frame_of(parameter, CanasType::int32, static_cast<std::uint32_t>(units), time_ns, header);
}

BusFrame utc_frame(std::int64_t time_ns, const CanasHeader& header) {
  const std::chrono::nanoseconds of_day =
      std::chrono::nanoseconds(time_ns) - day_of(time_ns).time_since_epoch();
  const std::chrono::hh_mm_ss clock(std::chrono::floor<std::chrono::seconds>(of_day));
  return frame_of(BusParameter::utc, CanasType::char4,
                  packed(static_cast<unsigned>(clock.hours().count()),
                         static_cast<unsigned>(clock.minutes().count()),
                         static_cast<unsigned>(clock.seconds().count()), 0),
                  time_ns, header);
}

BusFrame date_frame(std::int64_t time_ns, const CanasHeader& header) {
  const std::chrono::year_month_day date(day_of(time_ns));
  const auto year = static_cast<unsigned>(static_cast<int>(date.year()));
  return frame_of(BusParameter::date, CanasType::char4,
                  packed(static_cast<unsigned>(date.day()), static_cast<unsigned>(date.month()),
                         year / 100, year % 100),
                  time_ns, header);
}

std::string candump_text(const BusFrame& frame, std::string_view interface) {
  constexpr std::int64_t second_ns = 1'000'000'000;
  char text[64];
  std::snprintf(text, sizeof text, "(%010lld.%06lld) ",
                static_cast<long long>(frame.time_ns / second_ns),
                static_cast<long long>(frame.time_ns % second_ns / 1000));
  std::string line = text;
  line.append(interface);
  std::snprintf(text, sizeof text, frame.extended ? " %08X#" : " %03X#", frame.id);
  line.append(text);
  constexpr std::string_view digits = "0123456789ABCDEF";
  for (std::size_t index = 0; index < frame.length && index < 8; ++index) {
    line += digits[frame.data[index] >> 4U];
    line += digits[frame.data[index] & 15U];
  }
  return line;
}

}  // namespace ridgeline
