// GPU time: stamps that the driver calls good become times, all others become none.
#include "core/render/gpu_timer.hpp"

#include <gtest/gtest.h>

#include <array>

namespace {

constexpr GLenum gpu_disjoint_ext = 0x8FBB;
GLint disjoint = 0;
std::array<std::uint64_t, 4> answers{};

}  // namespace

// The linker sends what the timer asks here: -Wl,--wrap=glGetIntegerv.
extern "C" void __wrap_glGetIntegerv(GLenum name, GLint* value) {  // NOLINT
  ASSERT_EQ(name, gpu_disjoint_ext);
  *value = disjoint;
}

namespace ridgeline::test {
namespace {

/// A driver whose queries 0 to 3 answer `answers`.
TimerFunctions scripted_driver() {
  TimerFunctions functions;
  functions.gen_queries = [](GLsizei count, GLuint* names) {
    for (GLsizei k = 0; k < count; ++k) names[k] = static_cast<GLuint>(k);
  };
  functions.query_counter = [](GLuint, GLenum) {};
  functions.get_query_object_ui64 = [](GLuint name, GLenum, std::uint64_t* value) {
    *value = answers[name];
  };
  return functions;
}

std::array<double, pass_count> times(const std::array<std::uint64_t, 4>& stamps_ns, bool jumped) {
  GpuTimer timer;
  timer.make(scripted_driver());
  for (int k = 0; k <= pass_count; ++k) timer.stamp(k);
  answers = stamps_ns;
  disjoint = jumped ? 1 : 0;
  return timer.pass_ms();
}

constexpr std::array<double, pass_count> none{};

TEST(GpuTimer, time_of_a_pass_is_from_its_stamp_to_the_next) {
  const auto ms = times({5'000'000, 6'000'000, 6'500'000, 9'500'000}, false);
  EXPECT_EQ(ms, (std::array{1.0, 0.5, 3.0}));
}

TEST(GpuTimer, a_clock_that_jumped_tells_no_time) {
  EXPECT_EQ(times({5'000'000, 6'000'000, 6'500'000, 9'500'000}, true), none);
}

TEST(GpuTimer, stamps_out_of_order_are_no_time_either) {
  EXPECT_EQ(times({5'000'000, 4'000'000, 6'500'000, 9'500'000}, false), none);
}

TEST(GpuTimer, without_the_extension_there_is_none) {
  GpuTimer timer;
  timer.make(TimerFunctions{});
  EXPECT_FALSE(timer.available());
  EXPECT_EQ(timer.pass_ms(), none);
}

}  // namespace
}  // namespace ridgeline::test
