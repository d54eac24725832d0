// The benchmark from outside: what it measures and writes (not how fast), and methods by name.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/cli/program.hpp"
#include "tests/support/grey_png_writer.hpp"

namespace ridgeline::test {
namespace {

using Json = nlohmann::json;

/// The synthetic island, made once for all tests of this program.
const TemporaryFolder& demo() {
  static const TemporaryFolder folder;
  static const Ended made = ridgeline({"make-demo", folder.path()});
  EXPECT_EQ(made.status, 0) << made.err;
  return folder;
}

std::vector<std::string> small_bench(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"bench", "--terrain", demo().path(), "--size",
                                     "64x48", "--range",   "12000",       "--repeats",
                                     "1",     "--pixels",  "40"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// Rows by spec and view.
std::set<std::pair<std::string, std::string>> places(const Json& rows) {
  std::set<std::pair<std::string, std::string>> result;
  for (const Json& row : rows) result.emplace(row["spec"], row["view"]);
  return result;
}

TEST(Bench, a_flight_gives_a_row_for_every_method_and_view_and_one_over_all) {
  const TemporaryFolder out;
  const std::string json_file = out.file("bench.json"), svg_file = out.file("bench.svg"),
                    table_file = out.file("bench.md");
  const Ended ended =
      ridgeline(small_bench({"--log", demo().path() + "/demo.log", "--views", "3", "--methods",
                             "ridgeline:error=1,planes=4,ridgeline:error=4,raycast,mesh", "--json",
                             json_file, "--svg", svg_file, "--markdown", table_file}));
  ASSERT_EQ(ended.status, 0) << ended.err;
  const Json json = Json::parse(text_of(json_file));
  const Json& rows = json["rows"];
  EXPECT_EQ(rows.size(), 4U * (3 + 1));
  EXPECT_EQ(places(rows).size(), rows.size());
  EXPECT_TRUE(json["absent"].empty());
  for (const Json& row : rows) {
    EXPECT_GT(row["frame_ms_median"], 0.0) << row;
    EXPECT_GE(row["frame_ms_p99"], row["frame_ms_median"]) << row;
    EXPECT_GE(row["frame_ms_max"], row["frame_ms_p99"]) << row;
    EXPECT_GT(row["core_ms"], 0.0) << row;
    EXPECT_GT(row["gpu_bytes"], 0) << row;
    EXPECT_GT(row["heap_bytes"], 0) << row;
    EXPECT_GT(row["build_ms"], 0.0) << row;
    EXPECT_EQ(row["frames"], row["view"] == "all" ? 3 : 1) << row;
    EXPECT_EQ(row["judged_pixels"], row["view"] == "all" ? 120 : 40) << row;
    const bool promises = row["method"] != "mesh";
    EXPECT_EQ(row["bound_px"].is_null(), !promises) << row;
    EXPECT_EQ(row["epsilon_px"].is_null(), !promises) << row;
    if (promises) {
      EXPECT_LE(row["error_px_max"], row["bound_px"]) << row;
    }
    if (row["method"] == "raycast") {
      EXPECT_EQ(row["ray_cast_share"], 1.0) << row;
      EXPECT_GT(row["nodes_per_pixel"], 1.0) << row;
    }
    if (row["method"] == "mesh") {
      EXPECT_EQ(row["ray_cast_share"], 0.0) << row;
    }
    EXPECT_EQ(row["steps_per_pixel"] > 0.0, promises) << row;
  }
  EXPECT_EQ(text_of(table_file), ended.out);
  EXPECT_EQ(text_of(svg_file).rfind("<svg", 0), 0U);
}

TEST(Bench, by_default_draws_every_method_there_is_from_six_fixed_views) {
  const TemporaryFolder out;
  const std::string json_file = out.file("bench.json");
  const Ended ended = ridgeline(small_bench({"--json", json_file}));
  ASSERT_EQ(ended.status, 0) << ended.err;
  const Json json = Json::parse(text_of(json_file));
  std::set<std::string> views, methods;
  for (const Json& row : json["rows"]) {
    views.insert(row["view"]);
    methods.insert(row["method"]);
  }
  EXPECT_EQ(views, (std::set<std::string>{"low", "valley", "high", "steep down", "banked",
                                          "wide horizon", "all"}));
  for (const char* name : {"ridgeline", "raycast", "mesh"}) EXPECT_EQ(methods.count(name), 1U);
  for (const Json& one : json["absent"]) {
    EXPECT_NE(ended.out.find(one["why"].get<std::string>()), std::string::npos);
  }
}

TEST(Bench, gpu_time_is_told_where_the_driver_gives_it_and_a_dash_where_not) {
  const TemporaryFolder out;
  const std::string file = out.file("bench.json");
  const std::vector<std::string> arguments =
      small_bench({"--log", demo().path() + "/demo.log", "--views", "2", "--methods",
                   "ridgeline:error=1,mesh", "--json", file});
  // Mesa's software driver has timer queries; a program that cannot see them has no GPU time.
  const Ended timed = ridgeline(arguments);
  ASSERT_EQ(timed.status, 0) << timed.err;
  for (const Json& row : Json::parse(text_of(file))["rows"]) {
    ASSERT_TRUE(row["gpu_ms"].is_number()) << row;
    EXPECT_GT(row["gpu_ms"], 0.0) << row;
    EXPECT_LE(row["gpu_ms"], row["frame_ms_max"]) << row;
  }
  const Ended untimed =
      ridgeline(arguments, "MESA_EXTENSION_OVERRIDE=-GL_EXT_disjoint_timer_query");
  ASSERT_EQ(untimed.status, 0) << untimed.err;
  for (const Json& row : Json::parse(text_of(file))["rows"]) {
    EXPECT_TRUE(row["gpu_ms"].is_null()) << row;
    EXPECT_GT(row["frame_ms_median"], 0.0) << row;
  }
  EXPECT_NE(untimed.out.find(" | – | 1.0"), std::string::npos) << untimed.out;
}

/// A map that stands for the one of Puget Sound.
std::string small_map(const TemporaryFolder& folder) {
  const std::string map = folder.file("map.png");
  write_grey_png(map, 129, 129, 16, [](int column, int row) {
    return 4000 + 2000 * std::sin(0.7 * column) * std::cos(0.9 * row);
  });
  return map;
}

TEST(Bench, the_map_of_puget_sound_can_be_drawn_by_every_method_from_views_of_its_own) {
  const TemporaryFolder folder;
  const std::string map = small_map(folder), file = folder.file("bench.json");
  const Ended ended = ridgeline({"bench", "--puget", map, "--size", "64x48", "--views", "3",
                                 "--repeats", "1", "--pixels", "60", "--methods",
                                 "ridgeline:error=1,raycast,pgm:grid=64x64", "--json", file});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const Json rows = Json::parse(text_of(file))["rows"];
  EXPECT_EQ(rows.size(), 3U * (3 + 1));
  for (const Json& row : rows) {
    EXPECT_EQ(row["terrain"], map);
    EXPECT_EQ(row["removed_views"], 0) << row;
    EXPECT_EQ(row["range_m"], 50'000.0) << row;
    if (row["method"] != "pgm") {
      EXPECT_LE(row["error_px_max"], row["bound_px"]) << row;
    }
  }
}

TEST(Bench, a_paper_is_redone_over_the_map_beside_its_published_rows) {
  const TemporaryFolder folder;
  const Ended ended = ridgeline({"bench", "--paper", "dachsbacher", "--puget", small_map(folder),
                                 "--views", "1", "--repeats", "1", "--pixels", "20"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.out.find("| 512x512 mesh | 35 | 1.00 | – | warp:grid=512 |"), std::string::npos)
      << ended.out;
  EXPECT_NE(ended.out.find("512 x 512"), std::string::npos);
}

TEST(PaperTables, the_script_changes_what_stands_between_its_marks_alone) {
  const TemporaryFolder folder;
  const std::string document = folder.file("evidence/paper_tables.md");
  const std::string program = folder.file("program"), told = folder.file("told");
  // In place of the benchmark, which has its own tests.
  write_text(
      program,
      "#!/bin/bash\necho \"$@\" >>" + told +
          "\nwhile [ \"$1\" != --markdown ]; do shift; done\n"
          "printf 'driver, 8 x 8, terrain /some/path\\n\\n| new |\\nView by view:\\nno\\n' >$2\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  const std::string words = "# Words\n\n", more = "\nmore\n<!-- livny -->\nkept\n<!-- /livny -->\n";
  const std::string marks =
      "<!-- comparison -->\nold\n<!-- /comparison -->\n<!-- ammann -->\n"
      "<!-- /ammann -->\n";
  const std::string command = "'" PAPER_TABLES "' -p " + program + " -o " +
                              folder.file("evidence") + " -t comparison -t ammann /some/map.png" +
                              " --views 3 2>" + folder.file("log");
  write_text(document, words + marks + more);
  for (int turn = 0; turn < 2; ++turn) {  // again over its own tables
    ASSERT_EQ(std::system(command.c_str()), 0) << text_of(folder.file("log"));
    const std::string text = text_of(document);
    EXPECT_EQ(text.rfind(words + "<!-- comparison -->\nMade on ", 0), 0U) << text;
    EXPECT_EQ(text.substr(text.size() - more.size()), more);
    EXPECT_NE(text.find("bench --puget map.png --views 3\n\ndriver, 8 x 8\n\n| new |\n<!-- /"),
              std::string::npos);
    EXPECT_NE(text.find("bench --puget map.png --paper ammann --views 3\n"), std::string::npos);
    for (const char* gone : {"old", "/some", "View"}) {
      EXPECT_EQ(text.find(gone), std::string::npos) << text;
    }
  }
  EXPECT_NE(text_of(told).find("--svg"), std::string::npos);
  EXPECT_NE(text_of(told).find("--paper ammann"), std::string::npos);
  write_text(document, words);
  EXPECT_NE(std::system(command.c_str()), 0);
  EXPECT_NE(text_of(folder.file("log")).find("no marks of comparison"), std::string::npos);
  EXPECT_EQ(text_of(document), words);
}

TEST(Bench, wrong_usage_is_told_in_one_line) {
  const FlatScene scene;
  const std::string puget = scene.file("puget.png");
  expect_one_line(ridgeline({"bench"}), 2, {"--terrain"});
  expect_one_line(ridgeline({"bench", "--paper", "loffler"}), 2, {"--puget"});
  expect_one_line(ridgeline({"bench", "--paper", "hoppe", "--puget", puget}), 2, {"--paper"});
  expect_one_line(ridgeline({"bench", "--paper", "livny", "--puget", puget, "--terrain", "x"}), 2,
                  {"its own terrain"});
  expect_one_line(ridgeline({"bench", "--paper", "livny", "--puget", puget, "--size", "64x48"}), 2,
                  {"size"});
  expect_one_line(ridgeline({"bench", "--puget", puget, "--terrain", "x"}), 2, {"its own terrain"});
  expect_one_line(ridgeline({"bench", "--puget", puget, "--log", "x"}), 2, {"its own terrain"});
  expect_one_line(ridgeline({"bench", "--puget", puget}), 3, {puget, "no such file"});
  expect_one_line(ridgeline({"bench", "--paper", "livny", "--puget", puget}), 3,
                  {puget, "no such file"});
  for (const char* methods : {"magic", "mesh:fast=1", "mesh,ridgeline:error=x", "mesh,,raycast"}) {
    expect_one_line(ridgeline({"bench", "--terrain", scene.tiles(), "--methods", methods}), 2,
                    {"--methods"});
  }
}

TEST(MethodOption, a_pose_by_another_method_promises_nothing_and_verify_says_so) {
  const FlatScene scene;
  const std::string dump = scene.file("dump");
  const Ended drawn = ridgeline(scene.pose({"--method", "mesh", "--dump", dump}));
  ASSERT_EQ(drawn.status, 0) << drawn.err;
  EXPECT_NE(drawn.out.find("degraded: mesh, no bound"), std::string::npos) << drawn.out;
  const Json json = Json::parse(text_of(dump + "/000000.json"));
  EXPECT_TRUE(json["bound_px"].is_null());
  EXPECT_EQ(json["reasons"][0], "unproven");
  const Ended verified = ridgeline({"verify", dump, "--terrain", scene.tiles()});
  EXPECT_EQ(verified.status, 1);
  EXPECT_NE(verified.out.find("promises none"), std::string::npos) << verified.out;
}

TEST(MethodOption, settings_of_ours_are_those_of_the_frame) {
  const FlatScene scene;
  const Ended drawn = ridgeline(scene.pose({"--method", "ridgeline:error=2.5"}));
  EXPECT_EQ(drawn.status, 0) << drawn.err;
  EXPECT_NE(drawn.out.find("bound 2.500 px"), std::string::npos) << drawn.out;
  for (const char* method : {"magic", "mesh:a=1", "ridgeline:error=1e9", "", ":x=1"}) {
    expect_one_line(ridgeline(scene.pose({"--method", method})), 2, {"--method"});
  }
}

TEST(MethodOption, a_replay_by_another_method_reports_no_bound) {
  const FlatScene scene;
  const std::string report = scene.file("report.json");
  const Ended ended = ridgeline(scene.replay({"--method", "mesh", "--report", report}));
  ASSERT_EQ(ended.status, 0) << ended.err;
  const Json json = Json::parse(text_of(report));
  int drawn = 0;
  for (const Json& frame : json["frames"]) {
    EXPECT_TRUE(frame["bound_px"].is_null()) << frame;
    if (frame["mode"] == "removed") continue;  // nothing was received yet
    ++drawn;
    const Json& reasons = frame["reasons"];
    EXPECT_NE(std::find(reasons.begin(), reasons.end(), "unproven"), reasons.end()) << frame;
  }
  EXPECT_GT(drawn, 5);
  EXPECT_EQ(json["frames_within_error"], 0);
}

}  // namespace
}  // namespace ridgeline::test
