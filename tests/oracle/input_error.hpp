#pragma once
#include <stdexcept>
#include <string>

namespace ridgeline::oracle {

/// Bad or missing input. `what()` is one line: the file, then what is wrong with it.
/// The desktop program prints it on standard error and exits with status 3.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& line) : std::runtime_error(line) {}
  InputError(const std::string& file, const std::string& fault)
      : std::runtime_error(file + ": " + fault) {}
};

}  // namespace ridgeline::oracle
