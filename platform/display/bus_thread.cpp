#include "platform/display/bus_thread.hpp"

#include <poll.h>

#include <algorithm>
#include <array>

#include "core/state/ownship_update.hpp"
#include "platform/heap_counter.hpp"
#include "platform/real_time.hpp"

namespace ridgeline {
namespace {

constexpr int wait_ms = 10;        ///< longest; also how soon a stop is seen
constexpr int most_batches = 128;  ///< a round: more than a receive buffer for 250 ms holds

}  // namespace

BusThread::BusThread(const DisplayConfig& config, Exchange& exchange)
    : config_(config), exchange_(exchange), profile_(bus_profile(config)) {}

Status BusThread::open(const char*& refused) {
  const Result<CanFilters> filters = can_filters(profile_);
  if (!filters) return filters.fault();
  for (const std::string& interface : config_.bus.interfaces) {
    refused = interface.c_str();
    CanSettings settings;
    settings.interface = interface;
    settings.filters = filters.value();
    settings.stall_ns = config_.bus.stall_ms * limits::ms_ns;
    if (const Status opened = buses_.open(settings); !opened) return opened;
  }
  refused = "";
  status_.interface_count = static_cast<std::uint32_t>(buses_.size());
  return {};
}

void BusThread::run() {
  touch_stack();
  const int priority = config_.real_time.bus_priority;
  exchange_.real_time.bus = priority > 0 ? make_real_time(priority) : 0;
  const HeapSection after_boot;
  while (!exchange_.stop.load(std::memory_order_relaxed)) round();
}

void BusThread::round() {
  std::array<pollfd, CanBuses::capacity> waiting{};
  for (std::size_t bus = 0; bus < buses_.size(); ++bus) {
    waiting[bus] = {buses_[bus].descriptor(), POLLIN, 0};
  }
  ::poll(waiting.data(), buses_.size(), wait_ms);
  for (int batch = 0; batch < most_batches; ++batch) {
    const std::span<const ReceivedFrame> received = buses_.receive();
    tell_faults();
    take(received);
    if (received.size() < CanBatch::capacity) break;  // less than a batch: nothing else waits
  }
  publish();
}

void BusThread::take(std::span<const ReceivedFrame> received) {
  std::array<BusFrame, CanBuses::capacity * CanBatch::capacity> frames;
  for (std::size_t i = 0; i < received.size(); ++i) {
    frames[i] = received[i].frame;
    frames[i].time_ns = received[i].monotonic_ns;  // ages are told by the clock that never steps
    status_.newest_frame_ns = std::max(status_.newest_frame_ns, received[i].monotonic_ns);
    answer(received[i]);
  }
  state_ = update_ownship(state_, std::span(frames).first(received.size()), monotonic_now_ns(),
                          profile_);
}

/// Every CANaerospace node owes an answer to an identification request.
void BusThread::answer(const ReceivedFrame& received) {
  if (config_.bus.node_id == 0 || profile_.protocol != BusProtocol::canaerospace) return;
  CanasIdentity self;
  self.node_id = static_cast<std::uint8_t>(config_.bus.node_id);
  const auto reply = ids_reply(received.frame, self);
  if (!reply || reply->interface >= buses_.size()) return;
  if (buses_[reply->interface].send(*reply)) ++status_.answers;
}

void BusThread::tell_faults() {
  for (std::size_t bus = 0; bus < buses_.size(); ++bus) {
    const CanLink link = buses_[bus].link();
    const char* name = config_.bus.interfaces[bus].c_str();
    if (const Fault fault = buses_.fault(bus); fault != Fault::none) {
      exchange_.bus_log.tell(LogLevel::caution, "bus %s: %s", name, fault_text(fault).data());
    } else if (link == CanLink::up && status_.interfaces[bus].link != CanLink::up) {
      exchange_.bus_log.tell(LogLevel::note, "bus %s: up", name);
    }
    status_.interfaces[bus].link = link;
  }
}

void BusThread::publish() {
  for (std::size_t bus = 0; bus < buses_.size(); ++bus) {
    BusStatus::Interface& told = status_.interfaces[bus];
    told = {buses_[bus].link(), buses_[bus].controller(), buses_[bus].counters(),
            buses_[bus].received()};
  }
  status_.updates = state_.counters;
  ++status_.rounds;
  exchange_.ownship.write(state_);
  exchange_.bus_status.write(status_);
  exchange_.bus_report.write(status_);
}

}  // namespace ridgeline
