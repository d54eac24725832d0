#include "sim/bench/bench.hpp"

#include <memory>

#include "sim/commands/commands.hpp"
#include "sim/commands/scene_arguments.hpp"

namespace ridgeline::sim {
namespace {

struct BenchArguments : SceneArguments {
  BenchOptions options;
  std::string methods, paper, puget_file;
  bool own_size = false, own_range = false;  ///< given
  bool monitor = false;
  double deadline_ms = 1e-6 * static_cast<double>(limits::default_deadline_ns);
};

/// What is missing or too much; empty when nothing is.
std::string wrong_combination(const BenchArguments& arguments) {
  if (arguments.monitor && arguments.options.log_file.empty()) return "--monitor needs --log";
  if (arguments.monitor && !(arguments.methods.empty() && arguments.paper.empty())) {
    return "--monitor measures the module's own passes alone";
  }
  if (arguments.paper.empty()) {
    const bool own_views =
        !arguments.scene.terrain_folder.empty() || !arguments.options.log_file.empty();
    if (!arguments.puget_file.empty()) {
      return own_views ? "--puget brings its own terrain and views: no --terrain, no --log" : "";
    }
    return arguments.scene.terrain_folder.empty() ? "--terrain is required (see --help)" : "";
  }
  if (arguments.puget_file.empty()) return "--paper needs --puget FILE";
  const bool own_scene = arguments.scene.terrain_folder.empty() && arguments.methods.empty() &&
                         arguments.options.log_file.empty() && !arguments.own_size &&
                         !arguments.own_range;
  return own_scene ? "" : "--paper brings its own terrain, views, methods, size and range";
}

Outcome measure(BenchArguments& arguments) {
  BenchOptions& options = arguments.options;
  if (!arguments.paper.empty()) return bench_paper(options, arguments.paper, arguments.puget_file);
  if (arguments.puget_file.empty()) return bench(options);
  if (!arguments.own_range) options.scene.settings.range_m = puget_range_m;
  return bench_puget(options, arguments.puget_file);
}

int run_bench(BenchArguments& arguments) {
  if (const std::string wrong = wrong_combination(arguments); !wrong.empty()) {
    return fail(wrong_usage, "bench: " + wrong);
  }
  if (const std::string wrong = complete(arguments); !wrong.empty()) {
    return fail(wrong_usage, wrong);
  }
  if (!arguments.methods.empty()) {
    const Outcome parsed = parse_methods(arguments.methods, arguments.options.methods);
    if (!parsed.ok()) return fail(wrong_usage, "--methods: " + parsed.message);
    for (const MethodSpec& spec : arguments.options.methods) {
      if (const std::string wrong = method_problem(spec); !wrong.empty()) {
        return fail(wrong_usage, "--methods: " + wrong);
      }
    }
  }
  arguments.options.scene = arguments.scene;
  if (arguments.monitor) {
    const Outcome measured = bench_monitor(arguments.options, arguments.deadline_ms);
    return measured.ok() ? done : fail(bad_input, measured.message);
  }
  const Outcome measured = measure(arguments);
  return measured.ok() ? done : fail(bad_input, measured.message);
}

}  // namespace

void add_bench_command(CLI::App& program, int& status) {
  auto arguments = std::make_shared<BenchArguments>();
  BenchOptions& options = arguments->options;
  CLI::App* command = program.add_subcommand("bench", "measure speed against error");
  add_scene_options(*command, *arguments);
  command->remove_option(command->get_option("--method"));
  command->get_option("--terrain")->required(false);
  command
      ->add_option("--paper", arguments->paper,
                   "redo a paper's table over the map of Puget Sound: its size, grids, settings")
      ->check(CLI::IsMember({"loffler", "livny", "ammann", "dachsbacher"}));
  command->add_option(
      "--puget", arguments->puget_file,
      "that map, a square 16-bit grey PNG, 0.1 m a unit; alone: all methods over it");
  command->add_option("--methods", arguments->methods,
                      "what to measure: a,b:setting=value,c; all there are if not given");
  command->add_option("--log", options.log_file, "take the views from a recorded flight");
  command
      ->add_option("--views", options.log_views, "views of the flight or the map, spaced over it")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  command->add_option("--json", options.json_file, "file for the rows");
  command->add_option("--markdown", options.markdown_file, "file for the table");
  command->add_option("--svg", options.svg_file, "file for a plot of speed against error");
  command->add_option("--repeats", options.repeats, "counted frames a view and method")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--pixels", options.judged_pixels, "pixels the oracle judges a picture")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  command->add_flag("--monitor", arguments->monitor,
                    "frame times against the deadline, with the frame-budget monitor and without");
  command->add_option("--deadline-ms", arguments->deadline_ms, "with --monitor: time of a frame")
      ->check(within(1e-6 * static_cast<double>(limits::min_deadline_ns),
                     1e-6 * static_cast<double>(limits::max_deadline_ns)))
      ->capture_default_str();
  command->callback([arguments, command, &status] {
    arguments->own_size = command->count("--size") > 0;
    arguments->own_range = command->count("--range") > 0;
    status = run_bench(*arguments);
  });
}

}  // namespace ridgeline::sim
