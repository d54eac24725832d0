#pragma once
#include <GLES3/gl31.h>

#include <array>
#include <cstdint>

namespace ridgeline {

/// Entry points of EXT_disjoint_timer_query, handed in by whoever owns the context; all null where
/// the extension is missing. The renderer never needs them.
struct TimerFunctions {
  void (*gen_queries)(GLsizei, GLuint*) = nullptr;
  void (*query_counter)(GLuint, GLenum) = nullptr;
  void (*get_query_object_ui64)(GLuint, GLenum, std::uint64_t*) = nullptr;
  [[nodiscard]] bool available() const {
    return gen_queries != nullptr && query_counter != nullptr && get_query_object_ui64 != nullptr;
  }
};

/// The passes that are timed, in the order they run.
enum class Pass : std::uint8_t { grid, ray_cast, shade, count };
inline constexpr int pass_count = static_cast<int>(Pass::count);

/// GPU time of each pass from time stamps at the pass borders.
class GpuTimer {
 public:
  void make(const TimerFunctions& functions);
  [[nodiscard]] bool available() const { return functions_.available(); }
  /// Stamps the border before pass `index`; index pass_count ends the last pass.
  void stamp(int index);
  /// Time of each pass of the last frame, ms. Waits for the GPU: only after a read-back.
  [[nodiscard]] std::array<double, pass_count> pass_ms();

 private:
  TimerFunctions functions_;
  std::array<GLuint, pass_count + 1> queries_{};
};

}  // namespace ridgeline
