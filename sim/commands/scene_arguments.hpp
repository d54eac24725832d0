#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include "sim/session/session.hpp"

namespace ridgeline::sim {

/// The options that every drawing command takes, as given on the command line.
struct SceneArguments {
  SceneOptions scene;
  std::string size = "1024x800";
  double field_of_view_deg = 60.0;
  std::string method = "ridgeline";
};

void add_scene_options(CLI::App& command, SceneArguments& arguments);

/// The pilot's switches that change the picture: `pose` and `replay` have them.
void add_display_options(CLI::App& command, DisplayState& display);

/// Checks and completes the options; an error message, or empty.
std::string complete(SceneArguments& arguments);

/// Takes numbers, and nothing that is not one: no empty word either.
CLI::Validator a_number();
/// Takes numbers from `low` to `high`, and unlike CLI::Range nothing that is not a number.
CLI::Validator within(double low, double high);

/// Prints "ridgeline: MESSAGE" as one line on standard error and returns `status`.
int fail(int status, const std::string& message);

/// Prints what went wrong with tiles since the last call, one line each.
void tell_problems(Session& session);

}  // namespace ridgeline::sim
