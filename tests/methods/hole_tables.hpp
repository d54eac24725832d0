#pragma once
#include <string>

namespace ridgeline::test {

/// Prints what docs/evidence/published_holes.md shows of the method over the synthetic island,
/// which is written below `folder`: grids, warp and rays, each judged by the oracle at the bench's
/// fixed views. Result: exit status.
int print_hole_tables(const std::string& folder);

}  // namespace ridgeline::test
