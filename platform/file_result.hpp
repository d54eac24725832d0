#pragma once
#include <string>
#include <utility>
#include <variant>

#include "core/base/assert.hpp"
#include "core/base/fault.hpp"

namespace ridgeline {

/// What is wrong with a file, for the one line on standard error: `message` starts with its path.
struct FileProblem {
  Fault fault = Fault::none;
  std::string file;
  std::string message;
};

/// `FILE: what the fault list says about the fault (detail)`. Allocates: boot time only.
[[nodiscard]] FileProblem file_problem(std::string file, Fault fault, const std::string& detail);

/// What was read from a file, or the problem that prevented it: Result with a message.
/// Domain: value() only when ok(), problem() only when not, else RL_ASSERT.
template <typename T>
class [[nodiscard]] FileResult {
 public:
  FileResult(T value) : outcome_(std::move(value)) {}  // NOLINT(google-explicit-constructor)
  FileResult(FileProblem problem) : outcome_(std::move(problem)) {}  // NOLINT

  [[nodiscard]] bool ok() const { return std::holds_alternative<T>(outcome_); }
  [[nodiscard]] explicit operator bool() const { return ok(); }
  [[nodiscard]] const T& value() const& {
    RL_ASSERT(ok());
    return *std::get_if<T>(&outcome_);
  }
  [[nodiscard]] T& value() & {
    RL_ASSERT(ok());
    return *std::get_if<T>(&outcome_);
  }
  [[nodiscard]] T&& value() && {
    RL_ASSERT(ok());
    return std::move(*std::get_if<T>(&outcome_));
  }
  [[nodiscard]] const FileProblem& problem() const {
    RL_ASSERT(!ok());
    return *std::get_if<FileProblem>(&outcome_);
  }

 private:
  std::variant<T, FileProblem> outcome_;
};

}  // namespace ridgeline
