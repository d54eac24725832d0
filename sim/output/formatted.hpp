#pragma once
#include <string>

namespace ridgeline::sim {

/// Text as printf writes it, of any length.
[[gnu::format(printf, 1, 2)]] [[nodiscard]] std::string formatted(const char* format, ...);

}  // namespace ridgeline::sim
