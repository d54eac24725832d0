#include <cstdio>
#include <memory>

#include "sim/commands/commands.hpp"
#include "sim/commands/scene_arguments.hpp"
#include "sim/output/atomic_file.hpp"

namespace ridgeline::sim {
namespace {

struct PoseArguments : SceneArguments {
  GeodeticPosition eye;
  Attitude attitude;
  DisplayState display;
  std::string dump_folder;
};

int run_pose(PoseArguments& arguments) {
  if (const std::string wrong = complete(arguments); !wrong.empty()) {
    return fail(wrong_usage, wrong);
  }
  if (const auto frame = local_frame(arguments.eye); !frame) {
    return fail(wrong_usage, "pose: " + std::string(fault_text(frame.fault())));
  }
  if (const auto made = camera(arguments.attitude, arguments.scene.settings.image); !made) {
    return fail(wrong_usage, "pose: " + std::string(fault_text(made.fault())));
  }
  Session session;
  if (const Outcome opened = session.open(arguments.scene, arguments.eye); !opened.ok()) {
    return fail(bad_input, opened.message);
  }
  FrameInput input;
  input.eye = arguments.eye;
  input.attitude = arguments.attitude;
  input.display = arguments.display;
  const Picture picture = session.draw(input, true);
  tell_problems(session);
  if (!picture.problem.ok()) return fail(bad_input, picture.problem.message);
  if (!arguments.dump_folder.empty()) {
    Outcome written = make_folder(arguments.dump_folder);
    if (written.ok()) written = write_dump(arguments.dump_folder, 0, picture, session.geoid_name());
    if (!written.ok()) return fail(bad_input, written.message);
  }
  const FrameReport& report = picture.report;
  std::printf("%s: ", std::string(mode_word(report.availability.mode)).c_str());
  if (is_own_method(arguments.scene.method)) {
    std::printf("bound %.3f px, %d planes x %d rows", report.bound_px, report.planes, report.rows);
  } else {
    std::printf("%s, no bound, built in %.1f ms", arguments.method.c_str(), session.build_ms());
  }
  std::printf(", %.1f %% of pixels ray cast, %.1f ms", 100.0 * picture.counts.ray_cast_share,
              picture.cpu_ms);
  for (const Reason reason : report.availability.reasons) {
    std::printf(", %s", std::string(reason_text(reason)).c_str());
  }
  std::printf("\n");
  return done;
}

}  // namespace

void add_pose_command(CLI::App& program, int& status) {
  auto arguments = std::make_shared<PoseArguments>();
  CLI::App* command = program.add_subcommand("pose", "render one pose");
  const auto number = [&](const char* name, double& value, const char* text) {
    command->add_option(name, value, text)->required()->check(a_number());
  };
  number("LAT", arguments->eye.latitude_deg, "latitude, degrees");
  number("LON", arguments->eye.longitude_deg, "longitude, degrees");
  number("HEIGHT_HAE", arguments->eye.height_m, "height over the ellipsoid, m");
  number("ROLL", arguments->attitude.roll_deg, "degrees, right wing down +");
  number("PITCH", arguments->attitude.pitch_deg, "degrees, nose up +");
  number("HEADING", arguments->attitude.heading_deg, "degrees true");
  add_scene_options(*command, *arguments);
  add_display_options(*command, arguments->display);
  command->add_option("--dump", arguments->dump_folder, "folder for 000000.json and its files");
  command->callback([arguments, &status] { status = run_pose(*arguments); });
}

}  // namespace ridgeline::sim
