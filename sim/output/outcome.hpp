#pragma once
#include <string>

#include "core/base/fault.hpp"

namespace ridgeline::sim {

/// How a desktop step ended: done, or a fault with one sentence that names the file and what is
/// wrong with it.
struct [[nodiscard]] Outcome {
  Fault fault = Fault::none;
  std::string message;  ///< empty when done

  [[nodiscard]] bool ok() const { return fault == Fault::none; }
};

/// The outcome of a fault in `path`: "PATH: text of the fault (detail)".
[[nodiscard]] inline Outcome failed(Fault fault, const std::string& path,
                                    const std::string& detail = {}) {
  std::string message = path + ": " + std::string(fault_text(fault));
  if (!detail.empty()) message += " (" + detail + ")";
  return {fault, message};
}

}  // namespace ridgeline::sim
