#include "tests/fuzz/bus_input.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "config/canfix_icd.hpp"

namespace ridgeline::fuzz {
namespace {

/// Bits of the byte that a frame begins with.
enum FrameBit : unsigned {
  any_identifier = 0x01,
  any_length = 0x02,
  wide_identifier = 0x04,
  other_interface = 0x08,
  wrong_parity = 0x10,  ///< ARINC 429; every other word gets the parity that it needs
  not_data = 0xc0,      ///< all of them: remote, error or CAN FD
};

void take_offsets(InputBytes& input, ChannelOffsets& offsets) {
  offsets.count = static_cast<std::uint8_t>(input.below(5));
  for (std::size_t index = 0; index < offsets.count; ++index) {
    offsets.offset[index] = std::uint32_t{input.u16()} << 13U;
  }
  if (!offsets_are_distinct(offsets)) offsets = {};
}

void take_ports(InputBytes& input, Arinc429Profile& profile) {
  constexpr std::array<std::uint16_t, 8> equipment = {0x00b, 0x004, 0x005, 0x006,
                                                      0x038, 0x055, 0x000, 0x123};
  for (std::size_t port = 0; port < 4; ++port) {
    const std::uint8_t what = input.u8();
    profile.ports[port].equipment = equipment[what & 7U];
    if ((what & 0x80U) != 0) profile.ports[port].sdi = static_cast<std::uint8_t>(what >> 3U & 3U);
  }
  const std::uint8_t rules = input.u8();
  profile.label_order = (rules & 1U) != 0 ? LabelOrder::octal_number : LabelOrder::as_sent;
  profile.fine_rule = static_cast<FineRule>((rules >> 1U & 3U) % 3U);
  if ((rules & 8U) != 0) profile.id_base = 0x1ffffff0;
}

/// The identifier that a table of the protocol has at `index`.
std::uint32_t known_identifier(std::uint8_t index, const BusProfile& profile, BusFrame& frame) {
  switch (profile.protocol) {
    case BusProtocol::canfix:
      return canfix_icd[index % canfix_icd.size()].id;
    case BusProtocol::arinc429:
      frame.extended = true;
      return profile.arinc429.id_base + index % 4U;
    case BusProtocol::canaerospace:
      break;
  }
  const std::uint32_t id = bus_icd[index % bus_icd.size()].id;
  const std::uint32_t channel = index / static_cast<std::uint32_t>(bus_icd.size()) % 4U;
  const ChannelOffsets& offsets = profile.channel_offsets;
  const std::uint32_t offset = offsets.count > channel ? offsets.offset[channel] : channel << 16U;
  frame.extended = offset != 0;
  return id + offset;
}

/// Puts a label of the table into a word and sets its parity bit.
void finish_word(std::uint8_t row, bool is_parity_wrong, const BusProfile& profile,
                 BusFrame& frame) {
  std::uint32_t label = arinc429_icd[row % arinc429_icd.size()].label;
  if (profile.arinc429.label_order == LabelOrder::as_sent) {
    std::uint32_t turned = 0;
    for (unsigned bit = 0; bit < 8; ++bit) turned |= (label >> bit & 1U) << (7U - bit);
    label = turned;
  }
  frame.data[3] = static_cast<std::uint8_t>(label);
  int ones = is_parity_wrong ? 1 : 0;
  for (std::size_t byte = 0; byte < 4; ++byte) ones += std::popcount(frame.data[byte]);
  if (ones % 2 == 0) frame.data[0] ^= 0x80U;
}

void take_kind(std::uint8_t kind, BusFrame& frame) {
  frame.remote = kind % 3U == 0;
  frame.error = kind % 3U == 1;
  frame.fd = kind % 3U == 2;
  if (frame.error) frame.extended = false;
}

}  // namespace

BusProfile profile_from(InputBytes& input, BusProtocol protocol) {
  BusProfile profile;
  profile.protocol = protocol;
  const std::uint8_t rules = input.u8();
  profile.header_rule = (rules & 1U) != 0 ? HeaderRule::field : HeaderRule::strict;
  profile.heading_reference = static_cast<HeadingReference>((rules >> 1U & 3U) % 3U);
  profile.variation_east_positive = (rules & 8U) == 0;
  profile.canfix_height_is_ellipsoidal = (rules & 16U) != 0;
  profile.double_order = static_cast<DoubleOrder>((rules >> 5U & 3U) % 3U);
  if ((rules & 0x80U) != 0) profile.fixed_variation_deg = input.u8() - 128.0;
  const std::uint8_t channels = input.u8();
  profile.channel = channels & 3U;
  profile.channel_count = static_cast<std::uint16_t>(1U + (channels >> 2U & 3U));
  if (protocol == BusProtocol::canaerospace && (channels & 0x80U) != 0) {
    take_offsets(input, profile.channel_offsets);
  }
  if (protocol == BusProtocol::arinc429) take_ports(input, profile.arinc429);
  return profile;
}

std::int64_t time_from(InputBytes& input, std::int64_t before_ns) {
  constexpr std::int64_t last_ns = 9'223'372'035'999'999'999;
  constexpr std::array<std::int64_t, 16> steps_us = {
      0,       100,     1'000,     5'000,     12'500,     20'000, 50'000,  100'000,
      250'000, 400'000, 1'100'000, 2'500'000, 70'000'000, -1'000, -30'000, -20'000'000};
  const std::uint8_t choice = input.u8();
  if (choice == 0xff) return (std::int64_t{input.u32()} << 31U) + input.u8();
  const std::int64_t step_ns = steps_us[choice & 15U] * 1000 + (choice >> 4U);
  if (step_ns > 0 && before_ns > last_ns - step_ns) return last_ns;
  return std::max<std::int64_t>(0, before_ns + step_ns);
}

BusFrame frame_from(InputBytes& input, const BusProfile& profile, std::int64_t time_ns) {
  BusFrame frame;
  frame.time_ns = time_ns;
  const std::uint8_t form = input.u8();
  const std::uint8_t which = input.u8();
  const bool is_known = (form & any_identifier) == 0;
  const bool is_word = profile.protocol == BusProtocol::arinc429;
  if (is_known) {
    frame.id = known_identifier(which, profile, frame);
  } else {
    frame.extended = (form & wide_identifier) != 0;
    frame.id = input.u32() & (frame.extended ? 0x1fffffffU : 0x7ffU);
  }
  if ((form & not_data) == not_data) take_kind(which, frame);
  frame.interface = (form & other_interface) != 0 ? 1 : 0;
  std::size_t length = is_word ? 4 : 8;
  if (profile.protocol == BusProtocol::canfix && is_known) {
    length = 3U + canfix_size_bytes(canfix_icd[which % canfix_icd.size()].type);
  }
  if ((form & any_length) != 0) length = input.below(frame.fd ? 65 : 9);
  frame.length = static_cast<std::uint8_t>(length);
  if (!frame.remote) {
    const auto bytes = input.bytes(length);
    std::copy(bytes.begin(), bytes.end(), frame.data.begin());
  }
  const bool is_whole_word = is_word && is_known && length == 4 && !frame.remote;
  if (is_whole_word) finish_word(which / 4, (form & wrong_parity) != 0, profile, frame);
  return frame;
}

}  // namespace ridgeline::fuzz
