#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "core/bus/arinc429.hpp"
#include "core/bus/bus_frame.hpp"
#include "core/bus/bus_profile.hpp"
#include "core/bus/bus_value.hpp"
#include "core/bus/double_pairs.hpp"

/// The one way from frames to values, for every protocol: a frame's topic, then its value.
namespace ridgeline {

/// What a frame is about, told before its value is looked at.
struct FrameTopic {
  BusParameter parameter{};
  Source source;
  bool is_read = true;  ///< false: of a channel that is not read
};

/// The topic of a frame by the configured protocol's table; nothing when the display does not read
/// it, or it cannot be told.
/// Cost:   O(1); no allocation.
[[nodiscard]] std::optional<FrameTopic> frame_topic(const BusFrame& frame,
                                                    const BusProfile& profile);

/// What is remembered between frames of values that come in two parts. One memory serves one source
/// at a time. Trivially copyable.
struct DecoderMemory {
  std::array<DoublePairs, 2> halves;  ///< DOUBLE latitude and longitude
  std::array<CoarseWord, 2> coarse;   ///< GNSS latitude and longitude words
};

/// What one more frame led to: a value, a fault, or neither, while the other part is awaited.
struct DecodeStep {
  DecoderMemory memory;
  std::optional<BusValue> value;
  Fault fault = Fault::none;
  bool unpaired = false;  ///< a first part was given up without its second
};

/// Decodes one frame by the configured protocol.
/// Domain: any frame; the fault of the protocol's own decoder (canaerospace.hpp, arinc429.hpp,
/// canfix.hpp), or of checked_value(). Redundancy channels that are not read are decoded as well.
/// Cost:   O(1); no allocation.
[[nodiscard]] DecodeStep decoded_frame(const DecoderMemory& memory, const BusFrame& frame,
                                       const BusProfile& profile);

/// Whether a fault is the sender's word that it has no value: not a number, out of range, no
/// computed data, test, failure, suspect, unreliable digit. Other faults say nothing of the value.
[[nodiscard]] bool disowns_value(Fault fault);

}  // namespace ridgeline
