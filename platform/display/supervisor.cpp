#include "platform/display/supervisor.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

namespace ridgeline {
namespace {

constexpr std::size_t index(DiscreteOutput output) {
  return static_cast<std::size_t>(output);
}

}  // namespace

const char* refusal_word(HeartbeatRefusal refusal) {
  constexpr std::array<const char*, heartbeat_refusal_count> words = {
      "none",          "frame_not_new", "fence_missing", "bound_missing",
      "finished_late", "input_not_new", "input_stale"};
  return words[static_cast<std::size_t>(refusal)];
}

Supervisor::Supervisor(const DisplayConfig& config, Exchange& exchange)
    : config_(config), exchange_(exchange) {}

Status Supervisor::open(const char*& refused) {
  auto lines = GpioLines::open(gpio_settings(config_), monotonic_now_ns(), refused);
  if (!lines) return lines.fault();
  lines_ = std::move(lines).value();
  pass_switches();
  for (std::size_t i = 0; i < discrete_input_count; ++i) status_.inputs[i] = level(i);
  return {};
}

bool Supervisor::level(std::size_t input) const {
  return lines_->level(static_cast<DiscreteInput>(input));
}

/// What the render thread acts on. An air/ground switch that cannot be read any more says nothing.
void Supervisor::pass_switches() {
  exchange_.display_on = lines_->level(DiscreteInput::display_on);
  exchange_.declutter = lines_->level(DiscreteInput::declutter);
  exchange_.night = lines_->level(DiscreteInput::night);
  const auto& line = config_.lines.inputs[static_cast<std::size_t>(DiscreteInput::on_ground)];
  const bool readable = !line.name.empty() && !lines_->line_lost();
  const bool on_ground = lines_->level(DiscreteInput::on_ground);
  exchange_.air_ground = !readable   ? AirGround::unknown
                         : on_ground ? AirGround::ground
                                     : AirGround::air;
}

void Supervisor::tell_lost(const Status& status) {
  if (!status) {
    exchange_.supervisor_log.tell(LogLevel::error, "lines: %s", fault_text(status.fault()).data());
  }
}

void Supervisor::round(std::int64_t now_ns) {
  read_lines(now_ns);
  if (exchange_.frame.read(frame_)) take_frame(now_ns);
  exchange_.bus_status.read(bus_);
  write_lines(now_ns);
  keep_service();
  exchange_.line_status.write(status_);
}

void Supervisor::read_lines(std::int64_t now_ns) {
  tell_lost(lines_->read(now_ns));
  constexpr std::array<const char*, discrete_input_count> names = {"display", "declutter", "night",
                                                                   "on ground"};
  for (std::size_t i = 0; i < discrete_input_count; ++i) {
    if (level(i) == status_.inputs[i]) continue;
    status_.inputs[i] = level(i);
    exchange_.supervisor_log.tell(LogLevel::note, "%s: switched %s", names[i],
                                  level(i) ? "on" : "off");
  }
  pass_switches();
}

void Supervisor::take_frame(std::int64_t now_ns) {
  const std::int64_t limit_ns = config_.timeouts.heartbeat_input_ms * limits::ms_ns;
  // It may have been finished after this round began; it is judged now, not then.
  const std::int64_t judged_ns = std::max(now_ns, frame_.proof.finished_ns);
  const HeartbeatStep step = next_heartbeat(status_.heartbeat, frame_.proof, judged_ns, limit_ns);
  status_.heartbeat = step.next;
  // Frames come faster than values of some buses: no input newer is no change worth a line.
  const bool quiet = step.refusal == HeartbeatRefusal::input_not_new;
  if (step.refusal != refusal_ && !quiet) {
    exchange_.supervisor_log.tell(
        step.refusal == HeartbeatRefusal::none ? LogLevel::note : LogLevel::caution,
        "heartbeat: %s",
        step.refusal == HeartbeatRefusal::none ? "beats" : refusal_word(step.refusal));
    refusal_ = step.refusal;
  }
}

void Supervisor::write_lines(std::int64_t now_ns) {
  const std::int64_t limit_ns = config_.timeouts.picture_ms * limits::ms_ns;
  const bool any = frame_.proof.frame > 0;
  const bool stalled = any && now_ns - frame_.proof.finished_ns > limit_ns;
  if (stalled && !stalled_) {
    ++status_.stalls;
    exchange_.supervisor_log.tell(LogLevel::error, "picture: no new frame for %d ms",
                                  config_.timeouts.picture_ms);
  } else if (!stalled && stalled_) {
    exchange_.supervisor_log.tell(LogLevel::note, "picture: frames come again");
  }
  stalled_ = stalled;
  const bool on = lines_->level(DiscreteInput::display_on);
  const bool good =
      any && !stalled && frame_.availability.mode != Mode::removed && frame_.proof.fence_signalled;
  OutputLevels wanted{};
  wanted[index(DiscreteOutput::heartbeat)] = status_.heartbeat.level;
  wanted[index(DiscreteOutput::svs_valid)] = good && on;
  wanted[index(DiscreteOutput::svs_fail)] = !good && (on || stalled || !any);
  tell_lost(lines_->write(wanted));
  status_.outputs = driven_levels(wanted, status_.outputs, lines_->line_lost());
  status_.line_lost = lines_->line_lost();
}

void Supervisor::keep_service() {
  if (!booted_ && frame_.proof.frame > 0) {
    booted_ = true;
    service_.tell("READY=1");
  }
  if (booted_) tell_state();
  const bool alive = frame_.proof.frame > frame_kept_ && bus_.rounds > rounds_kept_;
  if (!alive || stalled_) return;
  frame_kept_ = frame_.proof.frame;
  rounds_kept_ = bus_.rounds;
  service_.tell("WATCHDOG=1");
}

/// What a person reads who asks the service manager: the same words as in the log.
void Supervisor::tell_state() {
  std::array<char, 160> state{};
  if (stalled_) {
    std::snprintf(state.data(), state.size(), "STATUS=picture: no new frame for %d ms",
                  config_.timeouts.picture_ms);
  } else {
    std::snprintf(state.data(), state.size(), "STATUS=picture: %s",
                  picture_words(frame_.availability).data());
  }
  if (state != state_told_ && service_.tell(state.data())) state_told_ = state;
}

void Supervisor::let_go() {
  service_.tell("STOPPING=1");
  if (!lines_) return;
  static_cast<void>(lines_->write(boot_levels));
  status_.outputs = boot_levels;
  exchange_.line_status.write(status_);
}

}  // namespace ridgeline
