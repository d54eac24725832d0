#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "sim/output/outcome.hpp"

namespace ridgeline::sim {

/// Writes a whole file so that `path` holds either the old contents or all of the new ones, never a
/// part. A neighbour file is written and flushed, then renamed over `path`. Error:
/// Fault::file_unwritable with the system's reason; nothing is left behind.
[[nodiscard]] Outcome write_file(const std::string& path, std::span<const std::byte> bytes);

/// The same for text.
[[nodiscard]] Outcome write_file(const std::string& path, std::string_view text);

/// Makes the folder and its parents where they are missing; an existing folder is fine.
/// Error:  Fault::file_unwritable with the system's reason.
[[nodiscard]] Outcome make_folder(const std::string& path);

}  // namespace ridgeline::sim
