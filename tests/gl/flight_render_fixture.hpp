#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "platform/display/render_thread.hpp"
#include "platform/display/status_report.hpp"
#include "sim/synthetic/tile_writer.hpp"
#include "tests/support/scratch_folder.hpp"

namespace ridgeline {

inline double hills(double latitude_deg, double longitude_deg) {
  return 800.0 + 300.0 * std::sin(latitude_deg * 400.0) * std::cos(longitude_deg * 300.0);
}

/// The flight program's drawing part with a state put in by hand, on this thread.
class FlightRender : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_.file("tiles"));
    constexpr int posts = 1201;  // 3"
    ASSERT_TRUE(sim::write_tile_with(folder_.file("tiles"), 46, 8, posts, hills).ok());
    config_.picture.width_px = 64;
    config_.picture.height_px = 48;
    config_.picture.rate_hz = 0.1;
    config_.picture.range_km = 8;
    config_.terrain.folder = folder_.file("tiles");
    config_.terrain.home_latitude_deg = 46.5;
    config_.terrain.home_longitude_deg = 8.5;
    config_.report.last_frame_folder = folder_.file("last");
  }
  void boot() {
    render_ = std::make_unique<RenderThread>(config_, *exchange_);
    const std::string problem = render_->boot();
    ASSERT_EQ(problem, "");
  }
  void receive(std::int64_t now_ns) {
    const auto put = [&](BusParameter parameter, double value) {
      Sample& sample = state_.samples[static_cast<std::size_t>(parameter)];
      sample = {value, now_ns, Validity::valid, {}};
    };
    put(BusParameter::roll, 5.0);
    put(BusParameter::pitch, 0.0);
    put(BusParameter::true_heading, 30.0);
    put(BusParameter::gps_latitude, 46.5);
    put(BusParameter::gps_longitude, 8.5);
    put(BusParameter::gps_height, 1500.0);
    if (speed_mps_ > 0) put(BusParameter::gps_ground_speed, speed_mps_);
    state_.now_ns = now_ns;
    exchange_->ownship.write(state_);
  }
  /// A frame of a value just received.
  void fly() {
    receive(monotonic_now_ns());
    render_->draw(monotonic_now_ns());
  }
  /// Frames until terrain is drawn and all of it has arrived.
  void fly_until_drawn() {
    for (int i = 0; i < 200; ++i) {
      fly();
      if (render_->fact().availability.mode == Mode::svs) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    FAIL() << "no terrain";
  }

  nlohmann::json status_now() {
    StatusSources sources;
    read_sources(*exchange_, sources);
    const auto json = std::make_unique<JsonText>();
    write_status(*json, config_, *exchange_, sources, monotonic_now_ns(), "running");
    EXPECT_TRUE(json->complete());
    return nlohmann::json::parse(json->text(), nullptr, false);
  }

  test::ScratchFolder folder_{"flight_render"};
  DisplayConfig config_;
  std::unique_ptr<Exchange> exchange_ = std::make_unique<Exchange>();
  std::unique_ptr<RenderThread> render_;
  OwnshipState state_;
  double speed_mps_ = 0;  ///< 0: the bus says none
};

}  // namespace ridgeline
