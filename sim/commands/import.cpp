#include <cstdio>
#include <memory>

#include "platform/geoid_file.hpp"
#include "sim/commands/commands.hpp"
#include "sim/commands/scene_arguments.hpp"
#include "sim/import_igc/import_igc.hpp"

namespace ridgeline::sim {
namespace {

constexpr double longest_track_s = 1e6;

struct ImportArguments {
  std::string track_file, log_file, geoid = "none", altitude = "header";
  IgcImportOptions options;
};

int run_import(ImportArguments& arguments) {
  IgcImportOptions& options = arguments.options;
  options.altitude = arguments.altitude == "hae"   ? IgcAltitude::hae
                     : arguments.altitude == "msl" ? IgcAltitude::msl
                                                   : IgcAltitude::header;
  if (arguments.geoid != "none") {
    auto geoid = load_geoid(arguments.geoid);
    if (!geoid) return fail(bad_input, geoid.problem().message);
    auto file = std::make_shared<GeoidFile>(std::move(geoid).value());
    options.geoid = [file](double latitude_deg, double longitude_deg) {
      return undulation_m(file->grid(), latitude_deg, longitude_deg);
    };
  }
  const auto imported = import_igc(arguments.track_file, arguments.log_file, options);
  if (!imported) {
    const std::string& file =
        imported.fault() == Fault::file_unwritable ? arguments.log_file : arguments.track_file;
    return fail(bad_input, file + ": " + std::string(fault_text(imported.fault())));
  }
  const IgcImportReport& report = imported.value();
  for (const std::string& problem : report.problems) {
    std::fprintf(stderr, "ridgeline: %s\n", problem.c_str());
  }
  for (const std::string& label : report.labels) std::printf("%s\n", label.c_str());
  std::printf("%llu frames, %.0f s, %.0f s of gaps\n",
              static_cast<unsigned long long>(report.frames_written), report.duration_s,
              report.gap_s);
  return done;
}

}  // namespace

void add_import_command(CLI::App& program, int& status) {
  auto arguments = std::make_shared<ImportArguments>();
  CLI::App* import = program.add_subcommand("import", "make a bus log from a recorded track");
  import->require_subcommand(1);
  CLI::App* command = import->add_subcommand("igc", "from an IGC track of a glider");
  command->add_option("TRACK", arguments->track_file, "IGC file")->required();
  command->add_option("OUT", arguments->log_file, "log to write")->required();
  command->add_option("--altitude", arguments->altitude, "what the GNSS altitude counts from")
      ->check(CLI::IsMember({"header", "hae", "msl"}))
      ->capture_default_str();
  command->add_option("--geoid", arguments->geoid, "geoid that turns MSL into ellipsoidal heights")
      ->capture_default_str();
  command->add_option("--from", arguments->options.from_s, "first second of the track")
      ->check(within(0.0, longest_track_s));
  command->add_option("--to", arguments->options.to_s, "last second of the track")
      ->check(within(0.0, longest_track_s));
  command->callback([arguments, &status] { status = run_import(*arguments); });
}

}  // namespace ridgeline::sim
