#pragma once
#include <span>
#include <string>

#include "sim/output/outcome.hpp"

namespace ridgeline::sim {

/// Writes a NumPy format 1.0 file: little-endian float32 in C order, data at a multiple of 64
/// bytes. Shape:  (rows, columns), row 0 first. NaN and infinities are kept bit for bit. Domain:
/// values.size() == rows * columns, else RL_ASSERT. Error:  Fault::file_unwritable with the reason.
/// Source: NumPy Enhancement Proposal 1, "A Simple File Format for NumPy Arrays".
[[nodiscard]] Outcome write_npy(const std::string& path, int rows, int columns,
                                std::span<const float> values);

}  // namespace ridgeline::sim
