#pragma once
#include <cstdint>

#include "config/canfix_icd.hpp"
#include "core/base/result.hpp"
#include "core/bus/bus_frame.hpp"
#include "core/bus/bus_profile.hpp"
#include "core/bus/bus_value.hpp"

namespace ridgeline {

/// The table row a frame's identifier names; nullptr when the display does not read it, or when the
/// frame is no classic data frame with an 11-bit identifier.
[[nodiscard]] const CanfixRow* canfix_row_of(const BusFrame& frame);

/// The value of a parameter frame, in the unit of its row in bus_icd, not yet range-checked.
/// Domain: classic data frame, else bus_not_data or bus_not_classic; id in the table, else
/// bus_id_unknown; three bytes and the data of its type, neither more nor less, else bus_length.
/// The function code: metadata, a limit or mark of the parameter, is bus_not_value; failure bit
/// bus_failure_warning; quality bit bus_quality; the reserved bit bus_type_reserved. Parameter 1034
/// where its datum is not configured: bus_datum_unknown.
/// Cost:   O(1); no allocation.
/// Source: CAN-FIX specification (MakerPlane), frame definition and parameter list.
[[nodiscard]] Result<double> canfix_value(const BusFrame& frame, const BusProfile& profile);

}  // namespace ridgeline
