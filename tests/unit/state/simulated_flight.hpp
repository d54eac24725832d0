#pragma once
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "core/monitor/availability.hpp"
#include "tests/unit/state/ownship_fixture.hpp"

/// A random flight that obeys the laws of motion, and the bus frames several senders make of it.
namespace ridgeline::testing {

/// Where the aircraft truly is.
struct Truth {
  double time_s = 0.0;
  double latitude_deg = 46.5, longitude_deg = 8.0, height_m = 3000.0;
  double roll_deg = 0.0, pitch_deg = 3.0, heading_deg = 0.0, magnetic_deg = 0.0;
  double speed_mps = 55.0, track_deg = 0.0, climb_mps = 0.0;
};

/// What a sender says in place of the truth; changed by a fault.
using Falsifier = std::function<void(Truth&)>;

struct Equipment {
  int attitude_nodes = 1;
  int gps_nodes = 1;
  bool ins = false;
  bool barometer = false;
  bool magnetic = false;  ///< magnetic heading and variation
  bool utc = true;
};

/// Ticks of 20 ms: attitude each, fixes and heights every fifth; message codes count.
class SimulatedFlight {
 public:
  SimulatedFlight(unsigned seed, const Equipment& equipment)
      : random_(seed), equipment_(equipment) {
    own_.profile.heading_reference = HeadingReference::true_north;
    for (double& phase : phases_) phase = uniform(0.0, 2.0 * std::numbers::pi);
    truth_.heading_deg = truth_.track_deg = uniform(-180.0, 180.0);
    baro_offset_m_ = uniform(-200.0, 200.0);
    ins_offset_deg_ = uniform(-0.01, 0.01);
  }

  /// Falsifies what one node says from now on. Node 1 is the first of each kind, 9 the INS, 8 the
  /// barometer.
  void falsify(int node, Falsifier how) { faults_[static_cast<std::size_t>(node)] = how; }

  [[nodiscard]] double now_ms() const { return 1000.0 * truth_.time_s; }
  [[nodiscard]] const Truth& truth() const { return truth_; }
  [[nodiscard]] Ownship& own() { return own_; }
  [[nodiscard]] const std::vector<BusFrame>& last_frames() const { return frames_; }

  /// Flies one tick and feeds its frames.
  void step() {
    make_frames();
    own_.feed(frames_, now_ms() + 19.0);
  }
  /// Flies one tick; the frames are left to the caller.
  std::vector<BusFrame> make_frames() {
    move();
    frames_.clear();
    for (int node = 1; node <= equipment_.attitude_nodes; ++node) attitude(node);
    if (tick_ % 5 == 0) {
      for (int node = 1; node <= equipment_.gps_nodes; ++node) gps(node);
      if (equipment_.ins) ins();
      if (equipment_.barometer) {
        put(8, BusParameter::standard_altitude, told(8).height_m + baro_offset_m_ + noise(1.0));
      }
    }
    if (equipment_.utc && tick_ % 50 == 0) utc();
    ++tick_;
    return frames_;
  }
  [[nodiscard]] std::vector<std::string> words() {
    std::vector<std::string> list;
    const Availability said =
        availability(own_.state, at_ms(now_ms() + 19.0), state_limits(own_.profile));
    for (const Reason reason : said.reasons) list.emplace_back(reason_word(reason));
    return list;
  }
  [[nodiscard]] bool says(const std::string& word) {
    for (const std::string& said : words()) {
      if (said == word) return true;
    }
    return false;
  }
  [[nodiscard]] double uniform(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }
  double utc_ahead_s = 0.0;  ///< what the bus' clock is set forward by

 private:
  static constexpr double dt_s_ = 0.02;

  double noise(double sigma) { return std::normal_distribution<double>(0.0, sigma)(random_); }

  void move() {
    Truth& t = truth_;
    if (tick_ > 0) t.time_s += dt_s_;
    const double rad = std::numbers::pi / 180.0;
    t.roll_deg =
        18.0 * std::sin(t.time_s * 0.45 + phases_[0]) + 8.0 * std::sin(t.time_s * 0.9 + phases_[1]);
    t.climb_mps = 9.0 * std::sin(t.time_s * 0.3 + phases_[2]);
    t.speed_mps = 55.0 + 5.0 * std::sin(t.time_s * 0.1 + phases_[3]);
    if (tick_ > 0) {
      t.track_deg += 9.80665 * std::tan(t.roll_deg * rad) / t.speed_mps / rad * dt_s_;
      t.height_m += t.climb_mps * dt_s_;
      const double north_m = t.speed_mps * std::cos(t.track_deg * rad) * dt_s_;
      const double east_m = t.speed_mps * std::sin(t.track_deg * rad) * dt_s_;
      t.latitude_deg += north_m / 111195.0;
      t.longitude_deg += east_m / (111195.0 * std::cos(t.latitude_deg * rad));
    }
    t.track_deg = std::remainder(t.track_deg, 360.0);
    t.heading_deg = std::remainder(t.track_deg + 7.0, 360.0);  // wind from the right
    t.magnetic_deg = std::remainder(t.heading_deg - 2.0, 360.0);
    t.pitch_deg = 3.0 + std::atan2(t.climb_mps, t.speed_mps) / rad;
  }

  Truth told(int node) {
    Truth said = truth_;
    if (faults_[static_cast<std::size_t>(node)]) faults_[static_cast<std::size_t>(node)](said);
    return said;
  }

  void put(int node, BusParameter parameter, double value) {
    add(node, parameter, CanasType::float32,
        std::bit_cast<std::uint32_t>(static_cast<float>(value)));
  }
  void put_angle(int node, BusParameter parameter, double angle_deg) {
    add(node, parameter, CanasType::int32,
        static_cast<std::uint32_t>(static_cast<std::int32_t>(std::lround(angle_deg * 1e7))));
  }
  void add(int node, BusParameter parameter, CanasType type, std::uint32_t bits) {
    std::uint8_t& code =
        codes_[static_cast<std::size_t>(node)][static_cast<std::size_t>(parameter)];
    const double offset_ms = 0.1 * static_cast<double>(frames_.size());
    frames_.push_back(raw_frame(icd_row(parameter).id, type, bits, now_ms() + offset_ms, code++,
                                static_cast<std::uint8_t>(node)));
  }

  void attitude(int node) {
    const Truth t = told(node);
    const bool honest = !faults_[static_cast<std::size_t>(node)];
    const double shake = honest ? 0.05 : 0.0;  // a fault may want the very same bits again
    put(node, BusParameter::roll, t.roll_deg + noise(shake));
    put(node, BusParameter::pitch, t.pitch_deg + noise(shake));
    put(node, BusParameter::true_heading, std::remainder(t.heading_deg + noise(shake), 360.0));
    if (equipment_.magnetic) {
      put(node, BusParameter::magnetic_heading, t.magnetic_deg);
      put(node, BusParameter::magnetic_variation, 2.0);
    }
  }
  void gps(int node) {
    const Truth t = told(node);
    const bool honest = !faults_[static_cast<std::size_t>(node)];
    const double wander_m = honest ? 3.0 * std::sin(0.05 * t.time_s + node) : 0.0;
    put_angle(node, BusParameter::gps_latitude, t.latitude_deg + wander_m / 111195.0);
    put_angle(node, BusParameter::gps_longitude, t.longitude_deg);
    put(node, BusParameter::gps_height, t.height_m + wander_m);
    put(node, BusParameter::gps_ground_speed, t.speed_mps + noise(0.2));
    put(node, BusParameter::gps_true_track, std::remainder(t.track_deg + noise(0.3), 360.0));
    if (node == 1) put(node, BusParameter::altitude_rate, t.climb_mps + noise(0.2));
  }
  void ins() {
    const Truth t = told(9);
    put_angle(9, BusParameter::ins_latitude,
              t.latitude_deg + ins_offset_deg_ + t.time_s * 1.0 / 111195.0);  // drifts 1 m/s
    put_angle(9, BusParameter::ins_longitude, t.longitude_deg);
    put(9, BusParameter::ins_height, t.height_m + noise(1.0));
    put(9, BusParameter::ins_ground_speed, t.speed_mps + noise(0.3));
    put(9, BusParameter::ins_true_track, std::remainder(t.track_deg + noise(0.3), 360.0));
  }
  void utc() {
    const auto second = static_cast<std::uint32_t>(
        std::fmod(80000.0 + std::floor(truth_.time_s) + utc_ahead_s, 86400.0));
    add(1, BusParameter::utc, CanasType::char4,
        second / 3600 << 24 | second / 60 % 60 << 16 | second % 60 << 8);
  }

  std::mt19937 random_;
  Equipment equipment_;
  Ownship own_;
  Truth truth_;
  std::array<double, 4> phases_{};
  double baro_offset_m_ = 0.0, ins_offset_deg_ = 0.0;
  std::array<Falsifier, 10> faults_{};
  std::array<std::array<std::uint8_t, bus_parameter_count>, 10> codes_{};
  std::vector<BusFrame> frames_;
  int tick_ = 0;
};

}  // namespace ridgeline::testing
