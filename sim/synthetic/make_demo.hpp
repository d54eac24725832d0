#pragma once
#include <string>

#include "sim/output/outcome.hpp"

namespace ridgeline::sim {

/// Writes the embedded default into `folder`: four one-degree tiles of the synthetic island (3",
/// 1201 posts a side), `demo.log` with the scripted flight over it, and README.txt that says it is
/// SYNTHETIC. The same bytes every time, on every machine with IEEE-754 doubles. The folder is made
/// where missing. Error:  Fault::file_unwritable, the message names the file. Files of the same
/// names are replaced. Cost:   about three seconds and 50 MB.
[[nodiscard]] Outcome make_demo(const std::string& folder);

}  // namespace ridgeline::sim
