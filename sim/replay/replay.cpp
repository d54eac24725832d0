#include "sim/replay/replay.hpp"

#include <cmath>
#include <cstdio>

#include "core/frame/frame_input.hpp"
#include "core/state/ownship_pose.hpp"
#include "core/state/ownship_update.hpp"
#include "sim/log/candump_reader.hpp"
#include "sim/output/atomic_file.hpp"
#include "sim/output/image_file.hpp"
#include "sim/replay/replay_report.hpp"

namespace ridgeline::sim {
namespace {

/// The ownship as a log moves it on.
class LogPlayer {
 public:
  LogPlayer(const CandumpLog& log, const BusProfile& profile)
      : frames_(log.frames), profile_(profile), limits_(state_limits(profile)) {}

  OwnshipPose advance(std::int64_t now_ns) {
    const std::size_t before = next_;
    std::size_t end = next_;
    while (end < frames_.size() && frames_[end].time_ns <= now_ns) ++end;
    state_ = update_ownship(state_, frames_.subspan(next_, end - next_), now_ns, profile_);
    next_ = end;
    decoded_ = static_cast<int>(next_ - before);
    return ownship_pose(state_, now_ns, limits_);
  }
  [[nodiscard]] const OwnshipState& state() const { return state_; }
  [[nodiscard]] int decoded() const { return decoded_; }  ///< by the last advance()

 private:
  std::span<const BusFrame> frames_;
  BusProfile profile_;
  StateLimits limits_;
  OwnshipState state_;
  std::size_t next_ = 0;
  int decoded_ = 0;
};

FrameInput input_of(const OwnshipPose& pose, const GroundWatch& ground, std::int64_t time_ns,
                    const ReplayOptions& options, bool derived) {
  FrameInput input = frame_input(pose, ground.radio, ground.air_ground, time_ns);
  if (pose.heading_source == HeadingSource::heading && options.heading_assumed) {
    add_reason(input.availability, Reason::heading_reference_assumed);
  }
  if (derived) add_reason(input.availability, Reason::attitude_derived);
  input.display = options.display;
  return input;
}

/// The first place the log names, for sizing the terrain window.
GeodeticPosition first_position(const CandumpLog& log, const BusProfile& profile) {
  LogPlayer player(log, profile);
  const std::int64_t start_ns = log.frames.front().time_ns, end_ns = log.frames.back().time_ns;
  for (std::int64_t t = start_ns; t <= end_ns; t += 200'000'000) {
    const OwnshipPose pose = player.advance(t);
    if (has_value(pose.latitude_deg)) {
      return {pose.latitude_deg.value, pose.longitude_deg.value, pose.height_m.value};
    }
  }
  return {};
}

bool is_derived(const CandumpLog& log) {
  for (const std::string& label : log.notes.labels) {
    if (label.find("DERIVED") != std::string::npos) return true;
  }
  return false;
}

Outcome make_folders(const ReplayOptions& options) {
  for (const std::string& folder : {options.frames_folder, options.dump_folder}) {
    if (folder.empty()) continue;
    if (Outcome made = make_folder(folder); !made.ok()) return made;
  }
  return {};
}

Outcome write_frame(const ReplayOptions& options, int index, const Picture& picture,
                    const Session& session) {
  if (!options.frames_folder.empty()) {
    char name[32];
    std::snprintf(name, sizeof name, "/%06d.png", index);
    const Camera& camera = picture.report.camera;
    Outcome written =
        write_png(options.frames_folder + name, camera.width_px, camera.height_px, picture.rgb);
    if (!written.ok()) return written;
  }
  if (options.dump_folder.empty() || index % options.dump_every != 0) return {};
  return write_dump(options.dump_folder, index, picture, session.geoid_name());
}

void tell_progress(int index, int count, const Picture& picture) {
  std::fprintf(stderr, "\rframe %d of %d, %-8s %6.1f ms", index + 1, count,
               std::string(mode_word(picture.report.availability.mode)).c_str(), picture.cpu_ms);
  if (index + 1 == count) std::fprintf(stderr, "\n");
}

}  // namespace

Outcome replay(const ReplayOptions& options) {
  CandumpOptions log_options;
  log_options.format = LogFormat::by_content;
  auto read = candump_log(options.log_file, log_options);
  if (!read) {
    return {read.fault(), options.log_file + ": " + std::string(fault_text(read.fault()))};
  }
  const CandumpLog log = std::move(read).value();
  for (const std::string& problem : log.notes.problems) {
    std::fprintf(stderr, "ridgeline: %s\n", problem.c_str());
  }
  Session session;
  if (Outcome opened = session.open(options.scene, first_position(log, options.bus));
      !opened.ok()) {
    return opened;
  }
  if (Outcome made = make_folders(options); !made.ok()) return made;

  const std::int64_t start_ns = log.frames.front().time_ns;
  const double length_s = static_cast<double>(log.frames.back().time_ns - start_ns) * 1e-9;
  const double to_s = std::min(options.to_s.value_or(length_s), length_s);
  const int count =
      to_s < options.from_s
          ? 0
          : static_cast<int>(std::floor((to_s - options.from_s) * options.rate_hz + 1e-9)) + 1;
  if (count == 0) {
    return {Fault::file_malformed, options.log_file + ": --from and --to leave no frame of it"};
  }
  const bool want_pixels = !options.frames_folder.empty() || !options.dump_folder.empty();
  const bool derived = is_derived(log);
  LogPlayer player(log, options.bus);
  ReplayReport report;
  GroundWatch ground;
  ReplayPacing pacing;
  if (Outcome opened = pacing.open(options.pace, options.scene); !opened.ok()) {
    return opened;
  }
  session.settings().pace = pacing.pace();
  for (int index = 0; index < count; ++index) {
    const double at_s = options.from_s + index / options.rate_hz;
    const std::int64_t now_ns = start_ns + static_cast<std::int64_t>(std::llround(at_s * 1e9));
    if (Outcome begun = pacing.begin_frame(index, now_ns, session); !begun.ok()) return begun;
    const OwnshipPose pose = player.advance(now_ns);
    FrameInput input = input_of(pose, ground, now_ns, options, derived);
    input.bus_frames = player.decoded();
    const Picture picture = session.draw(input, want_pixels);
    if (!picture.problem.ok()) return picture.problem;
    if (Outcome ended = pacing.end_frame(index, now_ns, session); !ended.ok()) return ended;
    ground.take(pose, options.air_ground, picture.report.over_ground_m, now_ns);
    for (const std::string& problem : session.new_problems()) {
      std::fprintf(stderr, "\nridgeline: %s\n", problem.c_str());
    }
    report.add(index, picture);
    if (want_pixels) {
      if (Outcome written = write_frame(options, index, picture, session); !written.ok()) {
        return written;
      }
    }
    tell_progress(index, count, picture);
  }
  std::printf("%d frames, %d removed, median %.1f ms a frame, %llu bad lines in the log\n", count,
              report.removed_count(), report.median_cpu_ms(),
              static_cast<unsigned long long>(log.statistics.bad_lines));
  if (Outcome written = pacing.finish(); !written.ok()) return written;
  if (options.report_file.empty()) return {};
  const auto json = report.finished(log, player.state(), ground, session, options.log_file);
  return write_file(options.report_file, json.dump(1) + "\n");
}

}  // namespace ridgeline::sim
