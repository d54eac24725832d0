#include "platform/file_result.hpp"

namespace ridgeline {

FileProblem file_problem(std::string file, Fault fault, const std::string& detail) {
  std::string message = file + ": " + std::string(fault_text(fault));
  if (!detail.empty()) message += " (" + detail + ")";
  return {fault, std::move(file), std::move(message)};
}

}  // namespace ridgeline
