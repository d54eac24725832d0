#pragma once
#include <cstddef>
#include <cstdint>

#include "core/bus/bus_profile.hpp"

namespace ridgeline::fuzz {

/// Decodes the frames of an input by one protocol and checks what holds of every decoder: a frame
/// gives a value, a fault or half a value, never two of them; values are finite, within the range
/// of the interface table, of the frame's own parameter, source and time; what is no data frame
/// gives none; the memory of one coordinate is no other's; what is read passes the socket's
/// filters.
void check_decoder(const std::uint8_t* data, std::size_t size, BusProtocol protocol);

}  // namespace ridgeline::fuzz
