#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "sim/output/atomic_file.hpp"
#include "tests/fine_tiles/fine_tile.hpp"
#include "tests/fine_tiles/straight_flight.hpp"

// The test tool `ridgeline-fine-tiles`: generated terrain finer than what was measured, and long
// flights over it. Exit statuses are those of the desktop program: 0, 2 wrong usage, 3 bad input.
namespace ridgeline::fine {
namespace {

constexpr int done = 0, wrong_usage = 2, bad_input = 3;

int fail(int status, const std::string& message) {
  std::fprintf(stderr, "ridgeline-fine-tiles: %s\n", message.c_str());
  return status;
}

struct TileArguments {
  std::vector<std::string> folders;
  bool synthetic = false;
  int factor = 3;
  std::string place;
  std::uint64_t seed = 1;
};

/// S,W,ROWS,COLUMNS; a block of no rows where the text is not of this form.
Place place_of(const std::string& text) {
  Place place;
  char rest = 0;
  const int read = std::sscanf(text.c_str(), "%d,%d,%d,%d%c", &place.south_deg, &place.west_deg,
                               &place.rows, &place.columns, &rest);
  if (read != 4) place.rows = 0;
  return place;
}

int make_tiles(const TileArguments& arguments) {
  if (arguments.folders.size() != (arguments.synthetic ? 1U : 2U)) {
    return fail(wrong_usage, "give SOURCE_DIR and TARGET_DIR, or --synthetic and TARGET_DIR");
  }
  const Place place = place_of(arguments.place);
  if (const std::string wrong = wrong_with(place); !wrong.empty()) {
    return fail(wrong_usage, "--place " + arguments.place + ": " + wrong);
  }
  const std::string& target = arguments.folders.back();
  std::error_code missing;
  if (std::filesystem::equivalent(arguments.folders.front(), target, missing) &&
      !arguments.synthetic) {
    return fail(wrong_usage, "SOURCE_DIR and TARGET_DIR are the same folder");
  }
  auto mosaic = arguments.synthetic ? FileResult<SourceMosaic>(synthetic_mosaic(source_intervals))
                                    : mosaic_of_folder(arguments.folders.front());
  if (!mosaic.ok()) return fail(bad_input, mosaic.problem().message);
  const sim::Outcome written =
      write_fine_block(target, mosaic.value(), place, arguments.factor, arguments.seed);
  if (!written.ok()) return fail(bad_input, written.message);
  std::printf("GENERATED, not measured: %d tiles of %d posts a side in %s, from %s\n",
              place.rows * place.columns, source_intervals * arguments.factor + 1, target.c_str(),
              mosaic.value().made_from.c_str());
  return done;
}

struct FlightArguments {
  std::string file, from;
  FlightPlan plan;
  Jump jump;
  Turn turn;
};

int make_flight(FlightArguments& arguments, bool jumps, bool turns) {
  FlightPlan& plan = arguments.plan;
  char rest = 0;
  if (std::sscanf(arguments.from.c_str(), "%lf,%lf%c", &plan.latitude_deg, &plan.longitude_deg,
                  &rest) != 2) {
    return fail(wrong_usage, "--from " + arguments.from + ": not of the form LAT,LON");
  }
  if (jumps) plan.jump = arguments.jump;
  if (turns) plan.turn = arguments.turn;
  if (const std::string wrong = wrong_with(plan); !wrong.empty()) return fail(wrong_usage, wrong);
  const sim::Outcome written = sim::write_file(arguments.file, flight_log(plan));
  if (!written.ok()) return fail(bad_input, written.message);
  std::printf("SYNTHETIC flight: %.0f s in %s\n", plan.duration_s, arguments.file.c_str());
  return done;
}

void add_tile_options(CLI::App& program, TileArguments& arguments) {
  program.add_option("FOLDERS", arguments.folders, "SOURCE_DIR (3\" .hgt tiles) and TARGET_DIR")
      ->required();
  program.add_flag("--synthetic", arguments.synthetic,
                   "the synthetic island instead of SOURCE_DIR");
  program.add_option("--factor", arguments.factor, "steps for one of the source: 3 or 9")
      ->check(CLI::IsMember({3, 9}))
      ->required();
  program.add_option("--place", arguments.place, "block to fill: S,W,ROWS,COLUMNS")->required();
  program.add_option("--seed", arguments.seed, "seed of the noise")->capture_default_str();
}

void add_flight_options(CLI::App& program, FlightArguments& arguments) {
  FlightPlan& plan = arguments.plan;
  program.add_option("FILE", arguments.file, "log to write")->required();
  program.add_option("--from", arguments.from, "start: LAT,LON, degrees")->required();
  program.add_option("--heading", plan.heading_deg, "true heading at the start")->required();
  program.add_option("--speed", plan.speed_mps, "ground speed, m/s")->required();
  program.add_option("--height", plan.height_m, "metres above the ellipsoid")->required();
  program.add_option("--seconds", plan.duration_s, "length of the flight")->required();
  auto* at = program.add_option("--jump-at", arguments.jump.at_s, "second of a position reset");
  auto* by = program.add_option_function<double>(
      "--jump-km", [&](double km) { arguments.jump.along_m = 1000 * km; }, "how far, along track");
  at->needs(by);
  by->needs(at);
  auto* start = program.add_option("--turn-at", arguments.turn.at_s, "second a turn begins");
  auto* bank = program.add_option("--bank", arguments.turn.bank_deg, "right is positive");
  auto* length = program.add_option("--turn-seconds", arguments.turn.duration_s, "its length");
  start->needs(bank)->needs(length);
  bank->needs(start);
  length->needs(start);
}

int run(int argc, char** argv) {
  const bool flight = argc > 1 && std::string_view(argv[1]) == "flight";
  CLI::App program{flight ? "A scripted flight as a bus log, for tests."
                          : "GENERATED terrain finer than its source, for tests; with `flight` as "
                            "first word a scripted flight (see flight --help)."};
  program.name(flight ? "ridgeline-fine-tiles flight" : "ridgeline-fine-tiles");
  TileArguments tiles;
  FlightArguments plan;
  if (flight) {
    add_flight_options(program, plan);
  } else {
    add_tile_options(program, tiles);
  }
  try {
    program.parse(argc - (flight ? 1 : 0), argv + (flight ? 1 : 0));
  } catch (const CLI::Success& help) {
    return program.exit(help);
  } catch (const CLI::ParseError& error) {
    return fail(wrong_usage, std::string(error.what()) + " (see --help)");
  }
  if (!flight) return make_tiles(tiles);
  return make_flight(plan, program.count("--jump-at") > 0, program.count("--turn-at") > 0);
}

}  // namespace
}  // namespace ridgeline::fine

int main(int argc, char** argv) {
  return ridgeline::fine::run(argc, argv);
}
