#include "sim/bench/bench.hpp"

#include <memory>

#include "sim/commands/commands.hpp"
#include "sim/commands/scene_arguments.hpp"

namespace ridgeline::sim {
namespace {

struct BenchArguments : SceneArguments {
  BenchOptions options;
  std::string methods;
};

int run_bench(BenchArguments& arguments) {
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
  const Outcome measured = bench(arguments.options);
  return measured.ok() ? done : fail(bad_input, measured.message);
}

}  // namespace

void add_bench_command(CLI::App& program, int& status) {
  auto arguments = std::make_shared<BenchArguments>();
  BenchOptions& options = arguments->options;
  CLI::App* command = program.add_subcommand("bench", "measure speed against error");
  add_scene_options(*command, *arguments);
  command->remove_option(command->get_option("--method"));
  command->add_option("--methods", arguments->methods,
                      "what to measure: a,b:setting=value,c; all there are if not given");
  command->add_option("--log", options.log_file, "take the views from a recorded flight");
  command->add_option("--views", options.log_views, "views of the flight, spaced over it")
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
  command->callback([arguments, &status] { status = run_bench(*arguments); });
}

}  // namespace ridgeline::sim
