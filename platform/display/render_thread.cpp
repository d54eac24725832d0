#include "platform/display/render_thread.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "platform/display/frame_dump.hpp"
#include "platform/gl_counter.hpp"
#include "platform/heap_counter.hpp"
#include "platform/real_time.hpp"

namespace ridgeline {
namespace {

void print_shader_log(std::string_view program, std::string_view log) {
  std::fprintf(stderr, "ridgeline-display: shader %.*s: %.*s\n", static_cast<int>(program.size()),
               program.data(), static_cast<int>(log.size()), log.data());
}

std::string told(const char* part, Fault fault, const char* detail) {
  std::string text = std::string(part) + ": " + std::string(fault_text(fault));
  if (*detail != '\0') text += " (" + std::string(detail) + ")";
  return text;
}

/// When the newest of these values was received; 0 when none ever was.
std::int64_t newest_ns(std::initializer_list<PoseValue> values, std::int64_t now_ns) {
  std::int64_t newest = 0;
  for (const PoseValue& value : values) {
    if (has_value(value)) newest = std::max(newest, now_ns - value.age_ns);
  }
  return newest;
}

bool same(const Availability& a, const Availability& b) {
  const auto x = a.reasons.view(), y = b.reasons.view();
  return a.mode == b.mode && std::equal(x.begin(), x.end(), y.begin(), y.end());
}

}  // namespace

RenderThread::RenderThread(const DisplayConfig& config, Exchange& exchange)
    : config_(config),
      exchange_(exchange),
      limits_(pose_limits(config)),
      period_ns_(std::llround(1e9 / config.picture.rate_hz)) {}

/// GL objects are deleted in their own context, on the thread that has it.
void RenderThread::close() {
  if (screen_) screen_->make_current();
  blank_ = Texture();
  scene_.reset();
  screen_.reset();
}

std::string RenderThread::boot() {
  SceneSettings settings;
  settings.terrain_folder = config_.terrain.folder;
  settings.geoid = config_.terrain.geoid;
  settings.frame = frame_settings(config_);
  if (config_.monitor.on) pace_.emplace(budget_settings(config_), clock_);
  settings.frame.pace = pace_ ? &*pace_ : nullptr;
  settings.terrain_gpu_bytes = config_.terrain.gpu_budget_mib * 1024.0 * 1024.0;
  const GeodeticPosition home{config_.terrain.home_latitude_deg, config_.terrain.home_longitude_deg,
                              0.0};
  scene_.emplace();
  if (const FileProblem problem = scene_->open_files(settings, home);
      problem.fault != Fault::none) {
    return problem.message;
  }
  exchange_.render_log.tell(LogLevel::note, "terrain: %d tiles, %d of them refused",
                            static_cast<int>(scene_->folder().usable_count()) +
                                static_cast<int>(scene_->folder().refused().size()),
                            static_cast<int>(scene_->folder().refused().size()));
  ScreenDetail detail;
  auto screen = Screen::make(screen_settings(config_), detail);
  if (!screen) return told("screen", screen.fault(), detail.text);
  screen_ = std::move(screen).value();
  exchange_.render_log.tell(LogLevel::note, "screen: %s", screen_->description());
  if (const Status made = scene_->open_renderer(screen_->timer_functions(), print_shader_log);
      !made) {
    return told("graphics", made.fault(), screen_->gl_description());
  }
  exchange_.render_log.tell(LogLevel::note, "graphics: %s", screen_->gl_description());
  const FrameSettings& frame = scene_->settings();
  auto blank = make_texture(GL_RGBA8, frame.image.width_px, frame.image.height_px, 1, 4);
  if (!blank) return told("graphics", blank.fault(), screen_->gl_description());
  blank_ = std::move(blank).value();
  rgba_.resize(4 * scene_->pixels());
  glBindTexture(GL_TEXTURE_2D, blank_.name());
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, frame.image.width_px, frame.image.height_px, GL_RGBA,
                  GL_UNSIGNED_BYTE, rgba_.data());
  glBindTexture(GL_TEXTURE_2D, 0);
  // A driver compiles what carries a picture to the screen at its first use, which belongs to boot.
  // A screen that refuses it is told in flight.
  static_cast<void>(screen_->present(blank_.name()));
  if (!config_.report.last_frame_folder.empty()) range_m_.resize(scene_->pixels());
  scene_->open_terrain();
  return {};
}

void RenderThread::run() {
  touch_stack();
  boot_problem_ = boot();
  if (!boot_problem_.empty()) {
    close();
    boot_state_.store(Boot::refused, std::memory_order_release);
    return;
  }
  prepare_real_time();
  boot_state_.store(Boot::done, std::memory_order_release);
  loop();
  dump();
  close();
}

/// At the end of boot, so that the threads a driver makes have no such priority: they would keep
/// the bus thread waiting.
void RenderThread::prepare_real_time() {
  exchange_.real_time.memory = config_.real_time.lock_memory ? lock_memory_of_now() : 0;
  const int priority = config_.real_time.render_priority;
  exchange_.real_time.render = priority > 0 ? make_real_time(priority) : 0;
}

void RenderThread::loop() {
  const HeapSection after_boot;
  const GlSection no_new_objects;
  std::int64_t due_ns = monotonic_now_ns();
  while (!exchange_.stop.load(std::memory_order_relaxed)) {
    sleep_until(due_ns);
    draw(due_ns);
    // A frame that was late costs the frames it overran, not the rhythm of those after it.
    const std::int64_t now_ns = monotonic_now_ns();
    due_ns += period_ns_ * std::max<std::int64_t>(1, (now_ns - due_ns) / period_ns_ + 1);
  }
}

FrameInput RenderThread::frame_input_now(std::int64_t now_ns) {
  exchange_.ownship.read(state_);
  const OwnshipPose pose = ownship_pose(state_, now_ns, limits_);
  attitude_ns_ = newest_ns({pose.roll_deg, pose.pitch_deg}, now_ns);
  newest_input_ns_ = newest_ns(
      {pose.latitude_deg, pose.height_m, pose.roll_deg, pose.pitch_deg, pose.heading_deg}, now_ns);
  radio_height_m_ = pose.radio_height_m;
  air_ground_facts_.said = exchange_.air_ground.load(std::memory_order_relaxed);
  air_ground_facts_.ground_speed_mps = pose.ground_speed_mps;
  air_ground_facts_.can_hover = config_.lines.can_hover;
  FrameInput input = frame_input(pose, ground_, air_ground_, now_ns);
  input.bus_frames = newly_decoded();
  input.display = display_now();
  return input;
}

DisplayState RenderThread::display_now() const {
  const bool night = exchange_.night.load(std::memory_order_relaxed);
  return {night ? config_.picture.night_luminance : 1.0,
          exchange_.declutter.load(std::memory_order_relaxed)};
}

/// What a frame shows is judged by the next one: the ground below is known once it is drawn.
void RenderThread::check_ground(std::int64_t started_ns) {
  ground_ = ground_check(ground_, radio_height_m_, report_.over_ground_m, started_ns);
  air_ground_facts_.over_ground_m = report_.over_ground_m;
  air_ground_ = air_ground_check(air_ground_, air_ground_facts_, started_ns);
}

/// Bus frames that became values since the last frame of the display. They are the bus thread's
/// work, but that thread goes first wherever both want one core.
int RenderThread::newly_decoded() {
  const std::uint32_t decoded = state_.counters.decoded;
  const std::uint32_t since = decoded - decoded_told_;  // modulo the counter's range, as it counts
  decoded_told_ = decoded;
  constexpr std::uint32_t most = 1'000'000;  // after a reset of the counters: not a count
  return since <= most ? static_cast<int>(since) : 0;
}

void RenderThread::draw(std::int64_t due_ns) {
  clock_.start_frame();
  const std::int64_t started_ns = monotonic_now_ns();
  const FrameInput input = frame_input_now(started_ns);
  const FrameSettings& settings = scene_->settings();
  const Availability before = fact_.availability;
  report_ = scene_->draw(settings, input);
  static_cast<void>(scene_->finish(report_));
  // Before the screen takes it: to wait for a vertical blank is not work, and no coarser picture
  // would shorten it.
  end_pace(settings, report_);
  check_ground(started_ns);
  fact_.availability = report_.availability;
  const Fault presented = present();
  const std::int64_t finished_ns = monotonic_now_ns();
  fact_.proof.deadline_ns = due_ns + period_ns_;
  judge(started_ns, finished_ns, presented);
  note_shown(finished_ns, presented);
  tell_change(before);
  exchange_.frame_time.add(finished_ns - started_ns);
  exchange_.frame.write(fact_);
  exchange_.frame_status.write(fact_);
}

Fault RenderThread::present() {
  const bool on = exchange_.display_on.load(std::memory_order_relaxed);
  const GLuint picture = on ? scene_->renderer().names().colour : blank_.name();
  const Fault fault = screen_->present(picture).fault();
  if (fault != present_fault_) {
    const char* words = screen_->last_words();
    exchange_.render_log.tell(fault == Fault::none ? LogLevel::note : LogLevel::caution,
                              "screen: %s%s%s", fault_text(fault).data(),
                              *words == '\0' ? "" : ": ", words);
    present_fault_ = fault;
  }
  if (fault == Fault::none) {
    const std::uint64_t number = screen_->health().presented;
    on_the_way_[number % on_the_way_.size()] = {number, attitude_ns_};
  } else if (fault == Fault::gl_context_lost || fault == Fault::screen_lost ||
             fault == Fault::screen_closed) {
    // What is left of the driver is not trusted with another picture: boot is the one way back.
    screen_->show_failed();
    exchange_.end_with(fault);
  }
  return fault;
}

void RenderThread::judge(std::int64_t started_ns, std::int64_t finished_ns, Fault presented) {
  FrameProof& proof = fact_.proof;
  const Mode mode = report_.availability.mode;
  ++proof.frame;
  proof.newest_input_ns = newest_input_ns_;
  proof.finished_ns = finished_ns;
  proof.bound_computed = mode != Mode::removed && report_.bound_px > 0;
  proof.fence_signalled = presented == Fault::none;
  fact_.started_ns = started_ns;
  fact_.bound_px = report_.bound_px;
  fact_.range_km = report_.range_m * 1e-3;
  fact_.ground_disagreements = ground_.disagreements;
  fact_.air_ground_disagreements = air_ground_.disagreements;
  fact_.display = report_.display;
  fact_.air_ground = air_ground_facts_.said;
  if (pace_) {
    fact_.budget = pace_->budget().counters;
    fact_.budget_step = pace_->budget().step;
  }
  if (finished_ns > proof.deadline_ns) ++fact_.late;
  if (presented != Fault::none) ++fact_.present_faults;
  if (mode == Mode::removed) ++fact_.removed;
  if (mode == Mode::degraded) ++fact_.degraded;
  if (fact_.first_frame_ns == 0) fact_.first_frame_ns = finished_ns;
  if (fact_.first_terrain_ns == 0 && mode != Mode::removed) fact_.first_terrain_ns = finished_ns;
}

/// A hidden window takes pictures and shows none. That is no fault, and is not to go unsaid.
void RenderThread::note_shown(std::int64_t now_ns, Fault presented) {
  const ShownStamp stamp = screen_->shown();
  const bool all = stamp.picture == screen_->health().presented;
  if (all || presented != Fault::none || stamp.picture != picture_told_ || seen_ns_ == 0) {
    seen_ns_ = now_ns;
  }
  const bool hidden = now_ns - seen_ns_ > limits::hidden_window_ns;
  if (hidden) ++fact_.hidden;
  if (hidden != hidden_) {
    exchange_.render_log.tell(
        LogLevel::note, "screen: %s",
        hidden ? "the window is hidden: it takes pictures and shows none" : "shows pictures again");
  }
  hidden_ = hidden;
  note_latency(stamp);
}

/// Counts each attitude once: with the picture that shows it first, when that is on the screen.
void RenderThread::note_latency(const ShownStamp& stamp) {
  if (stamp.picture == picture_told_) return;
  picture_told_ = stamp.picture;
  const Shown& shown = on_the_way_[stamp.picture % on_the_way_.size()];
  if (shown.picture != stamp.picture || shown.attitude_ns <= attitude_told_ns_) return;
  attitude_told_ns_ = shown.attitude_ns;
  exchange_.latency.add(stamp.time_ns - shown.attitude_ns);
}

void RenderThread::tell_change(const Availability& before) {
  const Availability& now = fact_.availability;
  if (fact_.proof.frame > 1 && same(before, now)) return;
  exchange_.render_log.tell(now.mode == Mode::svs ? LogLevel::note : LogLevel::caution,
                            "picture: %s", picture_words(now).data());
}

void RenderThread::dump() {
  if (config_.report.last_frame_folder.empty() || fact_.proof.frame == 0) return;
  screen_->make_current();
  const bool drawn = report_.availability.mode != Mode::removed;
  if (drawn) scene_->read_range(range_m_);
  scene_->read_colour(rgba_);
  dump_problem_ =
      write_frame_dump(config_.report.last_frame_folder, report_, scene_->geoid_name(),
                       drawn ? std::span<const float>(range_m_) : std::span<float>(), rgba_);
}

}  // namespace ridgeline
