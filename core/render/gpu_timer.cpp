#include "core/render/gpu_timer.hpp"

#include <algorithm>

namespace ridgeline {
namespace {
constexpr GLenum timestamp_ext = 0x8E28;
constexpr GLenum query_result_ext = 0x8866;
constexpr GLenum gpu_disjoint_ext = 0x8FBB;
}  // namespace

void GpuTimer::make(const TimerFunctions& functions) {
  functions_ = functions;
  if (functions_.available()) {
    functions_.gen_queries(static_cast<GLsizei>(queries_.size()), queries_.data());
  }
}

void GpuTimer::stamp(int index) {
  if (functions_.available()) functions_.query_counter(queries_[index], timestamp_ext);
}

std::array<double, pass_count> GpuTimer::pass_ms() {
  std::array<double, pass_count> result{};
  if (!functions_.available()) return result;
  std::array<std::uint64_t, pass_count + 1> stamps{};
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    functions_.get_query_object_ui64(queries_[i], query_result_ext, &stamps[i]);
  }
  // The clock stopped or jumped since it was asked last (a change of frequency, a suspended GPU):
  // what the stamps say then is no time.
  GLint disjoint = GL_FALSE;
  glGetIntegerv(gpu_disjoint_ext, &disjoint);
  if (disjoint != GL_FALSE || !std::is_sorted(stamps.begin(), stamps.end())) return result;
  for (int i = 0; i < pass_count; ++i) {
    result[i] = static_cast<double>(stamps[i + 1] - stamps[i]) * 1e-6;
  }
  return result;
}

}  // namespace ridgeline
