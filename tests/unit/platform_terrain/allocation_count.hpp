#pragma once
#include <cstddef>

namespace ridgeline::test {

/// How often this test program has called operator new so far.
std::size_t allocation_count();

}  // namespace ridgeline::test
