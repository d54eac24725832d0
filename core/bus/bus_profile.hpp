#pragma once
#include <cstdint>

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

/// What an installer says about one CANaerospace bus. Never guessed from the traffic: 11-bit ids of
/// other protocols collide (0x141 is a heading here and a latitude elsewhere).
struct BusProfile {
  HeaderRule header_rule = HeaderRule::strict;
  HeadingReference heading_reference = HeadingReference::unknown;  ///< of id 321
  bool variation_east_positive = true;  ///< sign of id 1121; the standard gives none
  std::uint16_t channel = 0;            ///< redundancy channel that is read; others are counted
  DoubleOrder double_order = DoubleOrder::learned;
  std::int64_t double_pair_limit_ns = limits::double_pair_limit_ns;
  std::int64_t fix_pair_limit_ns = limits::fix_pair_limit_ns;
};

}  // namespace ridgeline
