#include <cstdio>
#include <ctime>

#include "platform/screen_output.hpp"

namespace ridgeline {
namespace {

/// No screen: a picture counts as shown when it is finished.
class SurfacelessOutput final : public ScreenOutput {
 public:
  SurfacelessOutput(int width_px, int height_px) : width_px_(width_px), height_px_(height_px) {
    std::snprintf(description_, sizeof description_, "surfaceless %dx%d", width_px, height_px);
  }
  [[nodiscard]] EglPlace place() const override { return {}; }
  [[nodiscard]] Status attach(EglContext& /*context*/, ScreenDetail& /*detail*/) override {
    return {};
  }
  void detach() override {}
  [[nodiscard]] Result<PictureTarget> begin() override { return PictureTarget{.none = true}; }
  [[nodiscard]] Status show(std::uint64_t picture) override {
    shown_ = {picture, screen_time_ns(), 0};
    return {};
  }
  [[nodiscard]] Status wait_shown() override { return {}; }
  [[nodiscard]] ShownStamp shown() override { return shown_; }
  void show_failed() override {}
  [[nodiscard]] int width_px() const override { return width_px_; }
  [[nodiscard]] int height_px() const override { return height_px_; }
  [[nodiscard]] const char* description() const override { return description_; }

 private:
  int width_px_, height_px_;
  ShownStamp shown_;
  char description_[64] = {};
};

}  // namespace

std::int64_t screen_time_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::int64_t>(now.tv_sec) * 1'000'000'000 + now.tv_nsec;
}

ScreenMade make_surfaceless_output(const ScreenSettings& settings) {
  return {std::make_unique<SurfacelessOutput>(settings.width_px, settings.height_px)};
}

}  // namespace ridgeline
