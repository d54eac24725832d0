#pragma once
#include <functional>
#include <string>

#include "sim/output/outcome.hpp"

namespace ridgeline::sim {

/// Height in m at a latitude and longitude in degrees; NaN = no data.
using HeightFunction = std::function<double(double latitude_deg, double longitude_deg)>;

/// The usual name of the one-degree tile with this south-west corner: "S49W124.hgt".
[[nodiscard]] std::string tile_name(int south_deg, int west_deg);

/// The height a tile stores: rounded to whole metres, half away from zero; -32768 for NaN.
[[nodiscard]] int stored_height_m(double height_m);

/// Writes `folder`/NAME.hgt for one one-degree tile of `posts` x `posts` heights (1201 = 3", 3601 =
/// 1"). Post (row r from the south, column c) stands at south + r/(posts-1), west + c/(posts-1)
/// degrees, so neighbouring tiles ask for their common edge at the same coordinates, bit for bit.
/// Domain: posts >= 2; heights within the int16 range, others are stored as no data.
/// Error:  Fault::file_unwritable with the reason.
[[nodiscard]] Outcome write_tile_with(const std::string& folder, int south_deg, int west_deg,
                                      int posts, const HeightFunction& height_m);

/// A round mountain for tests: `peak_m` at the given place, falling by `slope` (rise over run) to
/// `foot_m`.
[[nodiscard]] HeightFunction cone_peak(double latitude_deg, double longitude_deg, double peak_m,
                                       double slope, double foot_m);

}  // namespace ridgeline::sim
