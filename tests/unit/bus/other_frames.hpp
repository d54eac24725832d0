#pragma once
#include <bit>
#include <cmath>
#include <cstdint>
#include <initializer_list>

#include "config/arinc429_icd.hpp"
#include "config/canfix_icd.hpp"
#include "core/bus/bus_frame.hpp"
#include "tests/unit/bus/frames.hpp"

/// Encoders of ARINC 429 words and CAN-FIX frames, written apart from the decoders.
namespace ridgeline::testing {

/// A word of a label (octal number) with bits 29..9 given, sent label, odd parity.
inline std::uint32_t word_of(unsigned label, std::uint32_t bits_29_to_9, unsigned ssm) {
  std::uint32_t word = ssm << 29 | (bits_29_to_9 & 0x1fffffU) << 8;
  for (unsigned bit = 0; bit < 8; ++bit) {
    if ((label & (0x80U >> bit)) != 0) word |= 1U << bit;
  }
  if (std::popcount(word) % 2 == 0) word |= 0x80000000U;
  return word;
}

/// BNR in bits 29..11, nearest code; SDI in bits 10, 9.
inline std::uint32_t bnr_word(unsigned label, double value, double range, unsigned ssm = 3,
                              unsigned sdi = 0) {
  const auto code = static_cast<std::int32_t>(std::lround(value / range * 262144.0));
  return word_of(label, static_cast<std::uint32_t>(code) << 2 | sdi, ssm);
}

/// BNR in bits 29..9: floor, as a coarse word wants it, or the nearest code.
inline std::uint32_t bnr20_word(unsigned label, double value, double range, unsigned ssm = 3) {
  const auto code = static_cast<std::int32_t>(std::lround(value / range * 1048576.0));
  return word_of(label, static_cast<std::uint32_t>(code), ssm);
}

/// Coarse and fine word of a position: 32 bits of 180 / 2^31 degree, cut after the 21st.
struct PositionWords {
  std::uint32_t coarse, fine;
};
inline PositionWords position_words(unsigned coarse_label, unsigned fine_label, double angle_deg) {
  const auto units = static_cast<std::int32_t>(std::lround(angle_deg / 180.0 * 2147483648.0));
  const auto bits = static_cast<std::uint32_t>(units);
  return {word_of(coarse_label, bits >> 11, 3), word_of(fine_label, (bits & 0x7ffU) << 9, 3)};
}

inline BusFrame word_frame(unsigned port, std::uint32_t word, double time_ms = 0.0) {
  BusFrame frame;
  frame.time_ns = start_ns + static_cast<std::int64_t>(time_ms * 1e6);
  frame.id = arinc429_default_id_base + port;
  frame.extended = true;
  frame.length = 4;
  for (unsigned byte = 0; byte < 4; ++byte) {
    frame.data[byte] = static_cast<std::uint8_t>(word >> (24 - 8 * byte));
  }
  return frame;
}

/// A CAN-FIX parameter frame with data bytes as given.
inline BusFrame canfix_frame(std::uint32_t id, std::initializer_list<unsigned> data,
                             double time_ms = 0.0, unsigned function = 0, unsigned node = 2,
                             unsigned index = 0) {
  BusFrame frame;
  frame.time_ns = start_ns + static_cast<std::int64_t>(time_ms * 1e6);
  frame.id = id;
  frame.data = {static_cast<std::uint8_t>(node), static_cast<std::uint8_t>(index),
                static_cast<std::uint8_t>(function)};
  frame.length = 3;
  for (const unsigned byte : data) frame.data[frame.length++] = static_cast<std::uint8_t>(byte);
  return frame;
}

/// A CAN-FIX value in steps of its row, little-endian.
inline BusFrame canfix_steps(const CanfixRow& row, std::int64_t steps, double time_ms = 0.0) {
  const auto bits = static_cast<std::uint32_t>(steps);
  const unsigned a = bits & 0xff, b = bits >> 8 & 0xff, c = bits >> 16 & 0xff, d = bits >> 24;
  if (canfix_size_bytes(row.type) == 2) return canfix_frame(row.id, {a, b}, time_ms);
  return canfix_frame(row.id, {a, b, c, d}, time_ms);
}

}  // namespace ridgeline::testing
