#include "sim/commands/scene_arguments.hpp"

#include <cmath>
#include <cstdio>

#include "config/limits_display.hpp"

namespace ridgeline::sim {

void add_scene_options(CLI::App& command, SceneArguments& arguments) {
  command.add_option("--terrain", arguments.scene.terrain_folder, "folder of raw elevation tiles")
      ->required();
  command.add_option("--geoid", arguments.scene.geoid, "geoid file (.pgm, .gtx) or `none`")
      ->capture_default_str();
  command.add_option("--coverage", arguments.scene.coverage_file,
                     "list of cells that are sea where no tile is");
  command.add_option("--size", arguments.size, "picture size, WxH")->capture_default_str();
  command.add_option("--hfov", arguments.field_of_view_deg, "horizontal field of view, degrees")
      ->check(a_number())
      ->capture_default_str();
  command.add_option("--error", arguments.scene.settings.error_px, "error bound, pixels")
      ->check(a_number())
      ->capture_default_str();
  command.add_option("--range", arguments.scene.settings.range_m, "display range, metres")
      ->check(a_number())
      ->capture_default_str();
  command
      .add_option("--method", arguments.method,
                  "what draws, NAME or NAME:setting=value,...; docs/commands.md lists them")
      ->capture_default_str();
}

void add_display_options(CLI::App& command, DisplayState& display) {
  command
      .add_option("--night", display.luminance,
                  "by night: share of the luminance of the day, in linear light")
      ->check(within(limits::least_night_luminance, 1.0));
  command.add_flag("--declutter", display.declutter,
                   "neither contours nor ground grid, and fewer words");
}

namespace {

/// Checks the method and puts it into the scene; an error message, or empty.
std::string take_method(SceneArguments& arguments) {
  MethodSpec spec;
  if (const Outcome parsed = parse_method(arguments.method, spec); !parsed.ok()) {
    return parsed.message;
  }
  std::string problem;
  if (is_own_method(spec)) {
    problem = apply_own_method(spec, arguments.scene.settings);
  } else {
    static_cast<void>(make_method(spec, problem));
  }
  if (problem.empty()) arguments.scene.method = spec;
  return problem;
}

}  // namespace

std::string complete(SceneArguments& arguments) {
  FrameSettings& settings = arguments.scene.settings;
  int width = 0, height = 0;
  char rest = 0;
  if (std::sscanf(arguments.size.c_str(), "%dx%d%c", &width, &height, &rest) != 2) {
    return "--size " + arguments.size + ": not of the form WxH";
  }
  settings.image = {width, height, arguments.field_of_view_deg};
  if (std::string wrong = take_method(arguments); !wrong.empty()) return "--method: " + wrong;
  const auto made = camera({}, settings.image);
  if (!made) return "--size or --hfov: " + std::string(fault_text(made.fault()));
  const double least_px = smallest_error_px(made.value());
  if (!(settings.error_px >= least_px && settings.error_px <= limits::max_error_px)) {
    char text[160];
    std::snprintf(text, sizeof text,
                  "--error %g: %s; the smallest for this picture is %.4f px, the largest %g px",
                  settings.error_px,
                  std::string(fault_text(Fault::error_bound_out_of_range)).c_str(),
                  std::ceil(least_px * 1e4) * 1e-4, limits::max_error_px);
    return text;
  }
  if (!(settings.range_m >= limits::min_range_m && settings.range_m <= limits::max_range_m)) {
    return "--range: " + std::string(fault_text(Fault::range_out_of_range));
  }
  return {};
}

CLI::Validator within(double low, double high) {
  const auto check = [low, high](std::string& text) -> std::string {
    double value = 0;
    if (!text.empty() && CLI::detail::lexical_cast(text, value) && value >= low && value <= high)
      return {};
    return text + " is not a number from " + CLI::detail::to_string(low) + " to " +
           CLI::detail::to_string(high);
  };
  return {check, "NUMBER"};
}

CLI::Validator a_number() {
  const auto check = [](std::string& text) -> std::string {
    double value = 0;
    if (!text.empty() && CLI::detail::lexical_cast(text, value)) return {};
    return "'" + text + "' is not a number";
  };
  return {check, "NUMBER"};
}

int fail(int status, const std::string& message) {
  std::fprintf(stderr, "ridgeline: %s\n", message.c_str());
  return status;
}

void tell_problems(Session& session) {
  for (const std::string& message : session.new_problems()) {
    std::fprintf(stderr, "ridgeline: %s\n", message.c_str());
  }
}

}  // namespace ridgeline::sim
