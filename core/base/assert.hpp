#pragma once

namespace ridgeline {

/// Called when RL_ASSERT fails; must not return. Installed once at boot; the default aborts.
using SafeStateHook = void (*)(const char* expression, const char* file, int line);

/// Installs the hook that brings the display to its safe state (blank picture, discrete set).
void install_safe_state_hook(SafeStateHook hook);

/// Runs the hook, then aborts. Never returns.
[[noreturn]] void enter_safe_state(const char* expression, const char* file, int line);

}  // namespace ridgeline

/// Programmer error, checked in every build. Bus, file and GPIO input may never reach one.
#define RL_ASSERT(expression)          \
  ((expression) ? static_cast<void>(0) \
                : ::ridgeline::enter_safe_state(#expression, __FILE__, __LINE__))
