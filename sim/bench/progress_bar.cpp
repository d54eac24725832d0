#include "sim/bench/progress_bar.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace ridgeline::sim {
namespace {

constexpr int width = 30;
constexpr double redraw_s = 0.2;

double now_s() {
  const auto time = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(time).count();
}

}  // namespace

ProgressBar::ProgressBar(int steps)
    : steps_(std::max(steps, 1)), is_terminal_(isatty(STDERR_FILENO) == 1), start_s_(now_s()) {}

void ProgressBar::step(const std::string& doing) {
  ++done_;
  if (!is_terminal_ || now_s() - drawn_s_ < redraw_s) return;
  draw(doing);
}

void ProgressBar::draw(const std::string& doing) {
  drawn_s_ = now_s();
  const double share = std::min(1.0, static_cast<double>(done_) / steps_);
  const int full = static_cast<int>(share * width);
  const std::string bar = std::string(full, '#') + std::string(width - full, '.');
  const double left_s = share > 0 ? (drawn_s_ - start_s_) * (1.0 - share) / share : 0.0;
  std::fprintf(stderr, "\r[%s] %3.0f %%, %.0f s left, %-40.40s", bar.c_str(), 100.0 * share, left_s,
               doing.c_str());
}

void ProgressBar::end() {
  std::fprintf(stderr, "%s%d steps in %.0f s%s\n", is_terminal_ ? "\r" : "", done_,
               now_s() - start_s_, is_terminal_ ? std::string(70, ' ').c_str() : "");
}

}  // namespace ridgeline::sim
