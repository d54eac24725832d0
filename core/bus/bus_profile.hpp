#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "config/arinc429_icd.hpp"
#include "config/bus_icd.hpp"
#include "config/limits_bus.hpp"

namespace ridgeline {

/// How far a frame's header is believed.
/// strict: the type byte must name an accepted type and its size must fit the length.
/// field:  as strict, and besides a type byte of 0 (NODATA) in front of four data bytes is read as
/// the
///         type the table gives the parameter; published recordings have all four header bytes
///         zero.
enum class HeaderRule : std::uint8_t { strict, field };

/// What id 321 refers to: the standard does not say, so the installer must.
enum class HeadingReference : std::uint8_t { unknown, true_north, magnetic_north };

/// Which half of a DOUBLE a sender puts first; `learned` accepts either, then holds to what it saw.
enum class DoubleOrder : std::uint8_t { learned, high_first, low_first };

/// What is added to a CANaerospace identifier on redundancy channel 0, 1, ...; all of them 29-bit
/// identifiers but offset 0, which is the 11-bit one. With `count` 0 channel n has the standard's
/// offset, 65536 n.
struct ChannelOffsets {
  std::array<std::uint32_t, 4> offset{};
  std::uint8_t count = 0;
};

/// Whether no identifier can belong to two channels: offsets at most 1FFFF800 hex, and 2048 or more
/// apart.
[[nodiscard]] constexpr bool offsets_are_distinct(const ChannelOffsets& offsets) {
  constexpr std::uint32_t ids = 2048, largest = 0x20000000 - ids;
  if (offsets.count > offsets.offset.size()) return false;
  for (std::size_t index = 0; index < offsets.count; ++index) {
    const std::uint32_t mine = offsets.offset[index];
    if (mine > largest) return false;
    for (std::size_t before = 0; before < index; ++before) {
      const std::uint32_t other = offsets.offset[before];
      if ((mine > other ? mine - other : other - mine) < ids) return false;
    }
  }
  return true;
}

/// How the adapter puts the label into the low byte of a word: as it is sent (bit 1, the label's
/// most significant, in the lowest place), or turned round into the octal number.
enum class LabelOrder : std::uint8_t { as_sent, octal_number };

/// What a GNSS fine word means. The coarse word is a floor, so fine is added on either side of the
/// equator; one maker's units are read by others as sign and magnitude. The two differ by up to 38
/// m on southern and western positions.
enum class FineRule : std::uint8_t {
  always_add,      ///< coarse + fine
  by_coarse_sign,  ///< away from zero: coarse - fine where coarse is negative
  coarse_alone,    ///< the source sends no fine word: 19 m steps
};

/// One receiver input of the gateway and what is connected to it.
struct Arinc429Port {
  std::uint16_t equipment = 0;      ///< equipment id of the sender; 0: nothing is read
  std::optional<std::uint8_t> sdi;  ///< the one SDI that is read; none: each is a source of its own
};

/// What an installer says about ARINC 429 words in CAN frames.
struct Arinc429Profile {
  std::array<Arinc429Port, arinc429_port_count> ports{};
  std::uint32_t id_base = arinc429_default_id_base;  ///< 29-bit identifier of port 0
  LabelOrder label_order = LabelOrder::as_sent;
  FineRule fine_rule = FineRule::always_add;
  std::int64_t fine_pair_limit_ns = limits::fine_pair_limit_ns;
};

/// What an installer says about one bus. Never guessed from the traffic: 11-bit ids of other
/// protocols collide (0x141 is a heading here and a latitude elsewhere).
struct BusProfile {
  BusProtocol protocol = BusProtocol::canaerospace;
  HeaderRule header_rule = HeaderRule::strict;
  HeadingReference heading_reference = HeadingReference::unknown;  ///< of id 321
  bool variation_east_positive = true;  ///< sign of id 1121; the standard gives none
  std::uint16_t channel = 0;        ///< first redundancy channel (or CAN-FIX index) that is read
  std::uint16_t channel_count = 1;  ///< how many from there on; others are counted
  ChannelOffsets channel_offsets;   ///< obeys offsets_are_distinct()
  DoubleOrder double_order = DoubleOrder::learned;
  std::int64_t double_pair_limit_ns = limits::double_pair_limit_ns;
  std::int64_t fix_pair_limit_ns = limits::fix_pair_limit_ns;
  Arinc429Profile arinc429;
  /// What CAN-FIX parameter 1034 counts from is not said: above the ellipsoid, or it is not read.
  bool canfix_height_is_ellipsoidal = false;
  /// Magnetic variation, east positive, where no parameter ever gives it (CAN-FIX has none).
  std::optional<double> fixed_variation_deg;
};

/// Whether a redundancy channel is one that is read.
[[nodiscard]] constexpr bool reads_channel(const BusProfile& profile, std::uint32_t channel) {
  return channel >= profile.channel && channel - profile.channel < profile.channel_count;
}

}  // namespace ridgeline
