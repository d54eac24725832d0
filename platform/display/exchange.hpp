#pragma once
#include <array>
#include <atomic>
#include <cstdint>

#include "core/frame/display_state.hpp"
#include "core/monitor/availability.hpp"
#include "core/monitor/discretes.hpp"
#include "core/monitor/frame_budget.hpp"
#include "core/monitor/heartbeat.hpp"
#include "core/state/ownship_state.hpp"
#include "platform/can_buses.hpp"
#include "platform/display/duration_histogram.hpp"
#include "platform/display/flight_log.hpp"
#include "platform/latest_value.hpp"

namespace ridgeline {

/// What the bus thread says about the interfaces.
struct BusStatus {
  struct Interface {
    CanLink link = CanLink::absent;
    CanController controller{};
    CanCounters counters;
    BatchCounters received;
  };
  std::array<Interface, CanBuses::capacity> interfaces{};
  std::uint32_t interface_count = 0;
  UpdateCounters updates;
  std::int64_t newest_frame_ns = 0;  ///< kernel time of the newest frame, monotonic
  std::uint64_t rounds = 0;          ///< of the thread; stands still with it
  std::uint64_t answers = 0;         ///< to identification requests
};

/// What the render thread says about the frame just finished.
struct FrameFact {
  FrameProof proof;
  Availability availability;
  double bound_px = 0;
  double range_km = 0;
  std::int64_t started_ns = 0;
  std::uint64_t late = 0;            ///< frames finished after their deadline
  std::uint64_t present_faults = 0;  ///< pictures that the screen did not take
  std::uint64_t hidden = 0;          ///< pictures that a hidden window took
  std::uint64_t removed = 0;
  std::uint64_t degraded = 0;
  std::uint64_t ground_disagreements = 0;  ///< times the radio height began to contradict
  std::uint64_t air_ground_disagreements = 0;
  DisplayState display;  ///< as the frame was drawn
  AirGround air_ground = AirGround::unknown;
  BudgetCounters budget;              ///< of the frame-budget monitor; none without one
  int budget_step = 0;                ///< that the next frame is drawn at
  std::int64_t first_frame_ns = 0;    ///< when it was finished; 0: none yet
  std::int64_t first_terrain_ns = 0;  ///< the first one with terrain
};

/// What the supervisor says about the lines.
struct LineStatus {
  Heartbeat heartbeat;
  OutputLevels outputs = boot_levels;
  std::array<bool, discrete_input_count> inputs{};
  bool line_lost = false;
  std::uint64_t stalls = 0;  ///< times that frames stopped coming
};

/// How a thread got its scheduling and the program its memory; errno, 0 where granted.
struct RealTimeStatus {
  std::atomic<int> memory{-1}, bus{-1}, supervisor{-1}, render{-1};
};

/// Everything that passes between the threads of the flight program. No lock: each member has one
/// writer and one reader, or is one atomic number.
struct Exchange {
  LatestValue<OwnshipState> ownship;    ///< bus thread to render thread
  LatestValue<BusStatus> bus_status;    ///< bus thread to supervisor
  LatestValue<FrameFact> frame;         ///< render thread to supervisor
  LatestValue<FrameFact> frame_status;  ///< render thread to log thread
  LatestValue<BusStatus> bus_report;    ///< bus thread to log thread
  LatestValue<LineStatus> line_status;  ///< supervisor to log thread
  std::atomic<bool> display_on{true};   ///< supervisor to render thread, debounced inputs
  std::atomic<bool> declutter{false}, night{false};
  std::atomic<AirGround> air_ground{AirGround::unknown};
  std::atomic<bool> stop{false};         ///< supervisor to all
  std::atomic<bool> want_status{false};  ///< supervisor to log thread
  std::atomic<std::uint32_t> fatal{0};   ///< a Fault that ends the program; the first one stays
  LogRing bus_log, render_log, supervisor_log;
  DurationHistogram latency;     ///< kernel time of an attitude to the frame that shows it
  DurationHistogram frame_time;  ///< start of a frame until it is finished
  RealTimeStatus real_time;
  std::int64_t start_ns = 0;  ///< of the program

  void end_with(Fault fault) {
    std::uint32_t none = 0;
    fatal.compare_exchange_strong(none, static_cast<std::uint32_t>(fault));
    stop.store(true);
  }
};

}  // namespace ridgeline
