#include "sim/synthetic/bus_log_writer.hpp"

#include <array>
#include <bit>
#include <cstdint>

namespace ridgeline::sim {
namespace {

constexpr std::int64_t start_us = 1'700'000'000'000'000;  // 2023-11-14 22:13:20 UTC
constexpr std::int64_t frame_us = 125;                    // one frame on a 1 Mbit/s bus
constexpr std::uint32_t node_id = 1;

enum class DataType : std::uint32_t { float32 = 2, char4 = 15, double_high = 30, double_low = 31 };

/// Appends frames to the text and keeps the message code of every identifier.
class LogText {
 public:
  explicit LogText(std::string& text) : text_(text) {}

  void start_tick(std::int64_t time_us) { time_us_ = time_us; }

  void add_float(std::uint32_t id, double value) {
    add(id, DataType::float32, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
  }

  void add_double(std::uint32_t id, double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    add(id, DataType::double_high, static_cast<std::uint32_t>(bits >> 32));
    add(id, DataType::double_low, static_cast<std::uint32_t>(bits));
  }

  void add(std::uint32_t id, DataType type, std::uint32_t data) {
    text_ += '(';
    append_decimal(time_us_ / 1'000'000, 10);
    text_ += '.';
    append_decimal(time_us_ % 1'000'000, 6);
    text_ += ") can0 ";
    append_hex(id, 3);
    text_ += '#';
    append_hex(node_id << 24 | static_cast<std::uint32_t>(type) << 16 | message_codes_[id]++, 8);
    append_hex(data, 8);
    text_ += '\n';
    time_us_ += frame_us;
  }

 private:
  void append_decimal(std::int64_t value, int digits) {
    std::int64_t unit = 1;
    for (int digit = 1; digit < digits; ++digit) unit *= 10;
    for (; unit > 0; unit /= 10) text_ += static_cast<char>('0' + value / unit % 10);
  }

  void append_hex(std::uint32_t value, int digits) {
    for (int digit = digits - 1; digit >= 0; --digit)
      text_ += "0123456789ABCDEF"[value >> (4 * digit) & 15];
  }

  std::string& text_;
  std::int64_t time_us_ = 0;
  std::array<std::uint8_t, 2048> message_codes_{};
};

/// Hours, minutes and seconds of the day as bytes, the fourth one zero.
std::uint32_t utc_bytes(std::int64_t time_us) {
  const std::int64_t second = time_us / 1'000'000 % 86'400;
  return static_cast<std::uint32_t>(second / 3600 << 24 | second / 60 % 60 << 16 |
                                    second % 60 << 8);
}

void add_position(LogText& log, const FlightSample& sample) {
  log.add_double(1036, sample.latitude_deg);
  log.add_double(1037, sample.longitude_deg);
  log.add_float(1038, sample.height_m);
  log.add_float(1039, sample.ground_speed_mps);
  log.add_float(1040, sample.track_deg);
}

}  // namespace

std::string bus_log(std::span<const FlightSample> flight, const BusGaps& gaps,
                    std::string_view comments) {
  std::string text(comments);
  text.reserve(flight.size() * 170);
  LogText log(text);
  for (std::size_t tick = 0; tick < flight.size(); ++tick) {
    const FlightSample& sample = flight[tick];
    const auto since_us = static_cast<std::int64_t>(tick) * 1'000'000 / flight_ticks_per_second;
    const bool position_lost =
        sample.time_s >= gaps.position_from_s && sample.time_s < gaps.position_to_s;
    const bool attitude_lost =
        sample.time_s >= gaps.attitude_from_s && sample.time_s < gaps.attitude_to_s;
    log.start_tick(start_us + since_us);
    if (!attitude_lost) {
      log.add_float(311, sample.pitch_deg);
      log.add_float(312, sample.roll_deg);
      log.add_float(1133, sample.heading_deg);
    }
    if (tick % 8 == 0) {
      if (!position_lost) add_position(log, sample);
      log.add_float(314, sample.climb_mps);
    }
    if (tick % flight_ticks_per_second == 0)
      log.add(1200, DataType::char4, utc_bytes(start_us + since_us));
  }
  return text;
}

}  // namespace ridgeline::sim
