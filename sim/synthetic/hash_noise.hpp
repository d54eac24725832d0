#pragma once
#include <cstdint>

namespace ridgeline::sim {

/// A well-mixed 64-bit value from a lattice point and a seed. Integer arithmetic only.
[[nodiscard]] std::uint64_t lattice_hash(std::int64_t column, std::int64_t row, std::uint64_t seed);

/// Smooth noise with zero mean, one feature per unit of `x` and `y`; within -1..1.
/// Error:  the same bits on every machine with IEEE-754 doubles: only + - * and floor are used,
///         which the standard rounds exactly, and no function of the C library's libm.
/// Cost:   O(1); no allocation.
[[nodiscard]] double gradient_noise(double x, double y, std::uint64_t seed);

/// Sum of `octaves` of gradient_noise(), each with twice the frequency and half the amplitude.
[[nodiscard]] double fractal_noise(double x, double y, int octaves, std::uint64_t seed);

/// Sharp crests (1) between round hollows (towards 0): octaves of 1 - |noise|, each weighted by the
/// one before. The weighting keeps hollows smooth and makes crests rough, as eroded rock is.
[[nodiscard]] double ridged_noise(double x, double y, int octaves, std::uint64_t seed);

}  // namespace ridgeline::sim
