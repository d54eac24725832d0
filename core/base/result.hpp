#pragma once
#include <optional>
#include <utility>

#include "core/base/assert.hpp"
#include "core/base/fault.hpp"

namespace ridgeline {

/// A value, or the fault that prevented it. No exceptions, no allocation of its own.
/// Domain: value() may be called only when ok(), else RL_ASSERT.
template <typename T>
class [[nodiscard]] Result {
 public:
  Result(T value) : value_(std::move(value)) {}  // NOLINT(google-explicit-constructor)
  Result(Fault fault) : fault_(fault) { RL_ASSERT(fault != Fault::none); }  // NOLINT

  [[nodiscard]] bool ok() const { return value_.has_value(); }
  [[nodiscard]] explicit operator bool() const { return ok(); }
  [[nodiscard]] Fault fault() const { return fault_; }
  [[nodiscard]] const T& value() const& {
    RL_ASSERT(ok());
    return *value_;
  }
  [[nodiscard]] T& value() & {
    RL_ASSERT(ok());
    return *value_;
  }
  [[nodiscard]] T&& value() && {
    RL_ASSERT(ok());
    return std::move(*value_);
  }

 private:
  std::optional<T> value_;
  Fault fault_ = Fault::none;
};

/// Success or a fault, for steps that give nothing back.
class [[nodiscard]] Status {
 public:
  Status() = default;
  Status(Fault fault) : fault_(fault) {}  // NOLINT(google-explicit-constructor)
  [[nodiscard]] bool ok() const { return fault_ == Fault::none; }
  [[nodiscard]] explicit operator bool() const { return ok(); }
  [[nodiscard]] Fault fault() const { return fault_; }

 private:
  Fault fault_ = Fault::none;
};

}  // namespace ridgeline
