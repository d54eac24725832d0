#include "core/base/assert.hpp"

#include <cstdlib>

namespace ridgeline {
namespace {
SafeStateHook safe_state_hook = nullptr;
}

void install_safe_state_hook(SafeStateHook hook) {
  safe_state_hook = hook;
}

void enter_safe_state(const char* expression, const char* file, int line) {
  if (safe_state_hook != nullptr) safe_state_hook(expression, file, line);
  std::abort();
}

}  // namespace ridgeline
