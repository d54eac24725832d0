#include "tests/fuzz/property.hpp"

#include <cstdio>
#include <cstdlib>

namespace ridgeline::fuzz {

void fail(const char* property, const char* file, int line) {
  std::fprintf(stderr, "property does not hold: %s (%s:%d)\n", property, file, line);
  std::abort();
}

}  // namespace ridgeline::fuzz
