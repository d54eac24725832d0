// The pilot's switches in deterministic runs: what they change is said, and nothing else changes.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "sim/synthetic/make_demo.hpp"
#include "tests/cli/program.hpp"

namespace ridgeline::test {
namespace {

using Json = nlohmann::json;

class Switches : public testing::Test {
 protected:
  static const TemporaryFolder& folder() {
    static const TemporaryFolder made;
    static const bool done = sim::make_demo(made.path()).ok();
    EXPECT_TRUE(done);
    return made;
  }
  static std::string file(const std::string& name) { return folder().file(name); }
  /// Arguments of a small replay of the demo flight.
  static std::vector<std::string> replay(const std::vector<std::string>& more) {
    std::vector<std::string> all{
        "replay",   file("demo.log"),   "--terrain", folder().path(), "--size",
        "96x72",    "--range",          "15000",     "--from",        "10",
        "--report", file("report.json")};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  static Json report(const std::vector<std::string>& more) {
    const Ended ended = ridgeline(replay(more));
    EXPECT_EQ(ended.status, 0) << ended.err;
    return Json::parse(text_of(file("report.json")));
  }
};

TEST_F(Switches, a_pose_by_night_says_so_and_shows_the_same_ground) {
  const FlatScene scene;
  const auto dumped = [&](const std::string& name, std::vector<std::string> more) {
    more.insert(more.end(), {"--dump", scene.file(name)});
    const Ended ended = ridgeline(scene.pose(more));
    EXPECT_EQ(ended.status, 0) << ended.err;
    return scene.file(name) + "/000000";
  };
  const std::string day = dumped("day", {});
  const std::string night = dumped("night", {"--night", "0.07", "--declutter"});
  const Json said = Json::parse(text_of(night + ".json"));
  EXPECT_EQ(said["display"], Json::parse(R"({"luminance": 0.07, "words_luminance": 0.1,
                                             "declutter": true})"));
  EXPECT_EQ(text_of(day + "_range.npy"), text_of(night + "_range.npy"));
  EXPECT_NE(text_of(day + "_color.png"), text_of(night + "_color.png"));
  EXPECT_FALSE(Json::parse(text_of(day + ".json")).contains("display"));
  const Ended judged = ridgeline({"verify", scene.file("night"), "--terrain", scene.tiles()});
  EXPECT_EQ(judged.status, 0) << judged.out << judged.err;
  // At full light, and with nothing taken away, every byte is that of a plain run.
  const std::string full = dumped("full", {"--night", "1"});
  for (const char* part : {".json", "_range.npy", "_color.png"}) {
    EXPECT_EQ(text_of(day + part), text_of(full + part)) << part;
  }
}

TEST_F(Switches, levels_out_of_range_are_wrong_usage) {
  const FlatScene scene;
  for (const char* level : {"0", "0.049", "1.01", "-0.5", "nan", "dark"}) {
    expect_one_line(ridgeline(scene.pose({"--night", level})), 2, {"--night"});
    expect_one_line(ridgeline(scene.replay({"--night", level})), 2, {"--night"});
  }
  expect_one_line(ridgeline(scene.replay({"--air-ground", "maybe"})), 2, {"--air-ground"});
}

TEST_F(Switches, every_frame_of_a_replay_says_how_it_was_drawn) {
  for (const Json& frame : report({"--to", "10.3", "--night", "0.2"})["frames"]) {
    EXPECT_EQ(frame["display"]["luminance"], 0.2);
    EXPECT_EQ(frame["display"]["declutter"], false);
    EXPECT_EQ(frame["mode"], "svs");
  }
  for (const Json& frame : report({"--to", "10.3"})["frames"]) {
    EXPECT_FALSE(frame.contains("display"));
  }
}

/// The pilot takes lines away, the monitor sheds them: neither must be taken for the other, and
/// what the monitor has learnt must not depend on a switch.
TEST_F(Switches, decluttering_changes_no_decision_of_the_monitor) {
  const auto decided = [&](const std::string& name, std::vector<std::string> more) {
    more.insert(more.end(), {"--to", "12", "--rate", "30", "--monitor", "work", "--cost-scale",
                             "40", "--record-decisions", file(name)});
    const Json json = report(more);
    return std::pair(text_of(file(name)), json["reason_counts"]);
  };
  const auto [all, all_reasons] = decided("all", {});
  const auto [fewer, fewer_reasons] = decided("fewer", {"--declutter"});
  EXPECT_EQ(all, fewer);
  EXPECT_EQ(all_reasons, fewer_reasons);
  EXPECT_GT(all_reasons.value("detail_shed", 0), 0) << "the monitor had something to decide";
}

TEST_F(Switches, wheels_on_the_ground_in_flight_are_told_and_take_no_picture_away) {
  const Json json = report({"--to", "14", "--rate", "5", "--air-ground", "ground"});
  int told = 0;
  for (const Json& frame : json["frames"]) {
    const bool says = frame["reasons"].dump().find("air_ground_disagrees") != std::string::npos;
    const double since_s =
        frame["time_s"].get<double>() - json["frames"][0]["time_s"].get<double>();
    EXPECT_EQ(says, since_s > 2.1) << since_s;
    EXPECT_EQ(frame["mode"], says ? "degraded" : "svs");
    told += says ? 1 : 0;
  }
  EXPECT_GT(told, 5);
  EXPECT_EQ(json["integrity"]["air_ground_disagreements"], 1);
  for (const char* said : {"air", "unknown"}) {
    const Json other = report({"--to", "14", "--rate", "5", "--air-ground", said});
    EXPECT_EQ(other["integrity"]["air_ground_disagreements"], 0) << said;
    EXPECT_EQ(other["degraded_frames"], 0) << said;
  }
}

}  // namespace
}  // namespace ridgeline::test
