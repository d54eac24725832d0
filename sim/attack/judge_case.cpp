#include "sim/attack/judge_case.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "sim/attack/tile_files.hpp"
#include "sim/output/atomic_file.hpp"
#include "tests/oracle/input_error.hpp"
#include "tests/oracle/verify.hpp"

namespace ridgeline::sim {
namespace {

namespace fs = std::filesystem;

/// A new folder under the system's temporary folder, removed with all it holds; or one to keep.
class CaseFolder {
 public:
  explicit CaseFolder(const std::string& kept) : path_(kept), kept_(!kept.empty()) {
    std::error_code fault;
    if (kept_) return;
    std::string path = (fs::temp_directory_path(fault) / "ridgeline_attack_XXXXXX").string();
    if (!fault && ::mkdtemp(path.data()) != nullptr) path_ = path;
  }
  CaseFolder(const CaseFolder&) = delete;
  CaseFolder& operator=(const CaseFolder&) = delete;
  ~CaseFolder() {
    std::error_code ignored;
    if (!kept_ && !path_.empty()) fs::remove_all(path_, ignored);
  }
  [[nodiscard]] const std::string& path() const { return path_; }  ///< empty: none could be made

 private:
  std::string path_;
  bool kept_;
};

SceneOptions scene_of(const AttackCase& c, const CaseFiles& files) {
  SceneOptions scene;
  scene.terrain_folder = files.terrain_folder;
  scene.coverage_file = files.coverage_file;
  scene.edit_file = files.edit_file;
  if (!files.geoid_file.empty()) scene.geoid = files.geoid_file;
  scene.settings.image = c.image;
  scene.settings.error_px = c.error_px;
  scene.settings.range_m = c.range_m;
  scene.arrival = c.arrival;
  scene.terrain_gpu_bytes = c.window_mib * 1024 * 1024;
  return scene;
}

bool is_graphics(Fault fault) {
  return fault == Fault::egl_unavailable || fault == Fault::gl_limit_too_small ||
         fault == Fault::gl_shader || fault == Fault::gl_error;
}

/// Draws and dumps every pose. Result: whether there is something to judge.
bool draw_poses(const AttackCase& c, const CaseFiles& files, const std::string& dumps,
                const JudgeOptions& options, CaseResult& result) {
  Session session;
  const AttackPose& start = c.poses.front();
  const Outcome opened =
      session.open(scene_of(c, files), {start.latitude_deg, start.longitude_deg, start.height_m});
  if (!opened.ok()) {
    (is_graphics(opened.fault) ? result.unusable : result.fault) = opened.message;
    return false;
  }
  result.levels = session.window().levels;
  for (std::size_t k = 0; k < c.poses.size(); ++k) {
    const AttackPose& pose = c.poses[k];
    FrameInput input;
    input.time_ns = std::llround(pose.time_s * 1e9);
    input.eye = {pose.latitude_deg, pose.longitude_deg, pose.height_m};
    input.attitude = {pose.roll_deg, pose.pitch_deg, pose.heading_deg};
    Picture picture = session.draw(input, true);
    const Availability& availability = picture.report.availability;
    if (availability.mode == Mode::removed) {
      for (const Reason reason : availability.reasons) {
        if (reason_mode(reason) == Mode::removed) {
          ++result.reasons[std::string(reason_word(reason))];
        }
      }
    } else if (options.spoil) {
      options.spoil(picture);
    }
    const Outcome written = write_dump(dumps, static_cast<int>(k), picture, session.geoid_name());
    if (!written.ok()) {
      result.unusable = written.message;
      return false;
    }
  }
  const std::vector<std::string> problems = session.new_problems();
  if (!problems.empty()) result.fault = problems.front();
  return true;
}

void judge_dump(const CaseFiles& files, const std::string& dumps, const JudgeOptions& options,
                CaseResult& result) {
  oracle::VerifyOptions told;
  told.dump_folder = dumps;
  told.terrain_folder = files.terrain_folder;
  if (!files.geoid_file.empty()) told.geoid = files.geoid_file;
  if (!files.coverage_file.empty()) told.coverage_file = files.coverage_file;
  if (!files.edit_file.empty()) told.edit_file = files.edit_file;
  told.pixels_per_frame = options.pixels_per_frame;
  told.threads = options.threads;
  std::ostringstream progress;
  const oracle::VerifySummary summary = oracle::run_verify(told, progress);
  result.frames = summary.frames;
  result.removed = summary.removed_frames;
  result.pixels = summary.pixels;
  result.violations = summary.violations();
  result.undecided = summary.undecided;
  result.details = summary.details;
  if (!summary.refused_tiles.empty()) result.fault = "oracle: " + summary.refused_tiles.front();
}

CaseResult judged_here(const AttackCase& c, const std::string& folder,
                       const JudgeOptions& options) {
  CaseResult result;
  CaseFiles files;
  const std::string dumps = folder + "/dumps";
  Outcome written = write_case(folder, c, files);
  if (written.ok()) written = make_folder(dumps);
  if (!written.ok()) {
    result.unusable = written.message;
    return result;
  }
  try {
    if (draw_poses(c, files, dumps, options, result)) judge_dump(files, dumps, options, result);
  } catch (const oracle::InputError& error) {
    result.fault = std::string("oracle: ") + error.what();
  }
  return result;
}

// --- from the process of the case to the one that asked ----------------------------------------

std::string as_text(const CaseResult& r) {
  std::ostringstream text;
  text << r.frames << ' ' << r.removed << ' ' << r.pixels << ' ' << r.violations << ' '
       << r.undecided << ' ' << r.levels << '\n';
  for (const auto& [word, count] : r.reasons) text << "reason " << count << ' ' << word << '\n';
  for (const std::string& line : r.details) text << "detail " << line << '\n';
  if (!r.fault.empty()) text << "fault " << r.fault << '\n';
  if (!r.unusable.empty()) text << "unusable " << r.unusable << '\n';
  text << "end\n";
  return text.str();
}

/// False where the text is not complete: its writer died.
bool from_text(const std::string& text, CaseResult& r) {
  std::istringstream lines(text);
  lines >> r.frames >> r.removed >> r.pixels >> r.violations >> r.undecided >> r.levels;
  std::string key;
  while (lines >> key) {
    if (key == "end") return true;
    std::size_t count = 0;
    if (key == "reason") lines >> count;
    lines.ignore(1);
    std::string rest;
    std::getline(lines, rest);
    if (key == "reason") r.reasons[rest] = count;
    if (key == "detail") r.details.push_back(rest);
    if (key == "fault") r.fault = rest;
    if (key == "unusable") r.unusable = rest;
  }
  return false;
}

void send(int pipe, const std::string& text) {
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t count = ::write(pipe, text.data() + sent, text.size() - sent);
    if (count < 0 && errno != EINTR) return;
    if (count > 0) sent += static_cast<std::size_t>(count);
  }
}

/// All that comes out of the pipe until it is closed. Result: false after `longest_s`.
bool receive(int pipe, double longest_s, std::string& text) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(longest_s);
  for (;;) {
    const auto left = std::chrono::duration<double, std::milli>(end - Clock::now()).count();
    if (left <= 0) return false;
    pollfd ready{pipe, POLLIN, 0};
    if (::poll(&ready, 1, static_cast<int>(std::min(left + 1, 1e6))) <= 0) continue;
    char buffer[4096];
    const ssize_t count = ::read(pipe, buffer, sizeof buffer);
    if (count == 0) return true;
    if (count > 0) text.append(buffer, static_cast<std::size_t>(count));
  }
}

}  // namespace

CaseResult judge_case(const AttackCase& c, const JudgeOptions& options) {
  CaseResult result;
  const CaseFolder folder(options.keep_folder);
  int ends[2] = {-1, -1};
  std::fflush(nullptr);
  if (folder.path().empty() || ::pipe(ends) != 0) {
    result.unusable = "temporary folder: " + std::string(std::strerror(errno));
    return result;
  }
  const pid_t child = ::fork();
  if (child == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // nobody is left to tell
    ::close(ends[0]);
    send(ends[1], as_text(judged_here(c, folder.path(), options)));
    ::_exit(0);
  }
  ::close(ends[1]);
  std::string text;
  const bool in_time = child > 0 && receive(ends[0], options.longest_s, text);
  ::close(ends[0]);
  if (child < 0) {
    result.unusable = "no process for a case: " + std::string(std::strerror(errno));
    return result;
  }
  if (!in_time) ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (in_time && from_text(text, result)) return result;
  result = {};
  result.fault = !in_time              ? "did not end in time"
                 : WIFSIGNALED(status) ? "ended by signal " + std::to_string(WTERMSIG(status))
                                       : "ended with status " + std::to_string(status);
  return result;
}

}  // namespace ridgeline::sim
