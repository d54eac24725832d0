#include "platform/display/flight_program.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "platform/heap_counter.hpp"

namespace ridgeline {
namespace {

constexpr std::int64_t round_ns = 10 * limits::ms_ns;          ///< of the supervisor
constexpr std::int64_t end_limit_ns = 20 * limits::second_ns;  ///< for a thread to end

std::string told(const char* what, const char* name, Fault fault) {
  return std::string(what) + " '" + name + "': " + std::string(fault_text(fault));
}

sigset_t taken_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGTERM, SIGINT, SIGUSR1}) sigaddset(&signals, signal);
  return signals;
}

}  // namespace

FlightProgram::FlightProgram(const DisplayConfig& config)
    : config_(config),
      supervisor_(config, exchange_),
      bus_(config, exchange_),
      render_(config, exchange_),
      log_(config, exchange_) {
  exchange_.start_ns = monotonic_now_ns();
}

void FlightProgram::hold_signals() {
  const sigset_t signals = taken_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

std::string FlightProgram::open() {
  const char* refused = "";
  if (const Status lines = supervisor_.open(refused); !lines) {
    return told("line", refused, lines.fault());
  }
  if (const Status bus = bus_.open(refused); !bus) return told("bus", refused, bus.fault());
  return {};
}

std::string FlightProgram::start() {
  hold_signals();  // every thread inherits this: signals are this thread's alone
  const auto log = [](void* self) { static_cast<LogThread*>(self)->run(); };
  const auto bus = [](void* self) { static_cast<BusThread*>(self)->run(); };
  const auto render = [](void* self) { static_cast<RenderThread*>(self)->run(); };
  if (!log_thread_.start("log", log, &log_) || !bus_thread_.start("bus", bus, &bus_) ||
      !render_thread_.start("render", render, &render_)) {
    return std::string("threads: ") + std::string(fault_text(Fault::thread_refused));
  }
  return {};
}

void FlightProgram::take_signal(int signal) {
  if (signal == SIGUSR1) exchange_.want_status = true;
  if (signal == SIGTERM || signal == SIGINT) exchange_.stop = true;
}

/// Until the end; false when boot was refused.
bool FlightProgram::fly() {
  touch_stack();
  const int priority = config_.real_time.supervisor_priority;
  exchange_.real_time.supervisor = priority > 0 ? make_real_time(priority) : 0;
  const sigset_t signals = taken_signals();
  const HeapSection after_boot;
  constexpr timespec wait = {0, round_ns};
  while (!exchange_.stop.load(std::memory_order_relaxed)) {
    if (const int signal = sigtimedwait(&signals, nullptr, &wait); signal > 0) take_signal(signal);
    if (render_.boot_state() == RenderThread::Boot::refused) return false;
    supervisor_.round(monotonic_now_ns());
  }
  return true;
}

Exit FlightProgram::refuse(const std::string& problem) {
  exchange_.stop = true;
  supervisor_.let_go();
  const bool bus_ended = bus_thread_.join(end_limit_ns);
  const bool render_ended = render_thread_.join(end_limit_ns);
  log_.end = true;
  const bool log_ended = log_thread_.join(end_limit_ns);
  std::fprintf(stderr, "ridgeline-display: %s\n", problem.c_str());
  if (!bus_ended || !render_ended || !log_ended) {  // what it still uses must stay
    std::fflush(stderr);
    ::_exit(static_cast<int>(Exit::bad_input));
  }
  return Exit::bad_input;
}

Exit FlightProgram::shut_down() {
  supervisor_.let_go();
  const bool bus_ended = bus_thread_.join(end_limit_ns);
  const bool render_ended = render_thread_.join(end_limit_ns);
  log_.end.store(true, std::memory_order_release);
  const auto fatal = static_cast<Fault>(exchange_.fatal.load());
  const bool log_ended = log_thread_.join(end_limit_ns);
  const char* why = fatal != Fault::none        ? fault_id(fatal).data()
                    : render_ended && bus_ended ? "stopped"
                                                : "thread_hung";
  if (log_ended) log_.finish(why);
  if (!render_ended || !bus_ended || !log_ended) {
    std::fprintf(stderr, "ridgeline-display: a thread hangs and was left behind\n");
    std::fflush(stderr);
    ::_exit(static_cast<int>(Exit::failed_in_flight));
  }
  if (!render_.dump_problem().empty()) {
    std::fprintf(stderr, "ridgeline-display: %s\n", render_.dump_problem().c_str());
    return Exit::bad_input;
  }
  if (fatal != Fault::none) {
    std::fprintf(stderr, "ridgeline-display: ended: %s\n", fault_text(fatal).data());
    return Exit::failed_in_flight;
  }
  return Exit::done;
}

Exit FlightProgram::run() {
  std::string problem = open();
  if (!problem.empty()) return refuse(problem);
  problem = start();
  if (!problem.empty()) return refuse(problem);
  if (!fly()) return refuse(render_.boot_problem());
  return shut_down();
}

}  // namespace ridgeline
