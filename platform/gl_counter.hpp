#pragma once
#include <cstdint>

namespace ridgeline {

/// Counts calls that create GL objects or storage, made by our own objects on this thread while a
/// section is open. The program must be linked with the --wrap options of platform/CMakeLists.txt.
class GlSection {
 public:
  GlSection();
  ~GlSection();
  GlSection(const GlSection&) = delete;
  GlSection& operator=(const GlSection&) = delete;
};

/// Creations counted in all sections so far.
[[nodiscard]] std::uint64_t gl_creations_counted();
/// Creations since the program began; shows that counting works.
[[nodiscard]] std::uint64_t gl_creations_seen();

}  // namespace ridgeline
