#pragma once

namespace ridgeline::fuzz {

/// Names a property that does not hold and its place, and ends the program.
[[noreturn]] void fail(const char* property, const char* file, int line);

/// Checks a property: the fuzzer keeps an input for which one does not hold, and a replay fails.
inline void must(bool holds, const char* property, const char* file = __builtin_FILE(),
                 int line = __builtin_LINE()) {
  if (!holds) fail(property, file, line);
}

}  // namespace ridgeline::fuzz
