// The frame budget from outside: the same work gives the same frames, a slow machine keeps the
// deadline with sound pictures, and what a real clock decided can be done again exactly.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/demo_flight.hpp"

namespace ridgeline::test {
namespace {

using Json = nlohmann::json;

class Monitor : public DemoFlight {
 protected:
  Monitor() : DemoFlight({"--size", "200x160", "--rate", "30"}) {}
  /// Time of the full picture on the reference machine, ms: of the first drawn frame.
  [[nodiscard]] double full_frame_ms(const std::string& error_px) const {
    const Json json = report({"--from", "10", "--to", "10.5", "--error", error_px, "--monitor",
                              "work", "--deadline-ms", "1000"});
    EXPECT_EQ(json["frames"][5]["budget"]["step"], 0);
    return json["frames"][5]["budget"]["elapsed_ms"].get<double>();
  }
};

TEST_F(Monitor, a_fast_machine_reaches_the_configured_bound_and_stays_there) {
  const Json json = report({"--from", "10", "--to", "11.5", "--monitor", "work", "--cost-scale",
                            std::to_string(0.6 * 33.3 / full_frame_ms("1"))});
  for (const Json& frame : json["frames"]) {
    EXPECT_EQ(frame["budget"]["step"], 0);
    EXPECT_EQ(frame["mode"], "svs");
  }
  EXPECT_EQ(json["budget"]["sheds"], 0);
  EXPECT_EQ(json["budget"]["late_finishes"], 0);
  EXPECT_EQ(json["allocations_after_boot"], 0);
  EXPECT_EQ(json["gl_creations_after_boot"], 0);
}

TEST_F(Monitor, machines_too_slow_keep_the_deadline_with_sound_frames) {
  const double full_ms = full_frame_ms("0.5");
  for (const double times : {1.4, 3.0}) {
    const std::string dump = folder().file("slow" + std::to_string(times));
    const Json json = report({"--from", "10", "--to", "13.2", "--error", "0.5", "--monitor", "work",
                              "--cost-scale", std::to_string(times * 33.333 / full_ms), "--dump",
                              dump, "--dump-every", "15"});
    int late = 0, counted = 0, worse = 0;
    for (const Json& frame : json["frames"]) {
      if (frame["index"].get<int>() < 30) continue;
      ++counted;
      late += frame["budget"]["elapsed_ms"].get<double>() > 33.333334 ? 1 : 0;
      worse += frame["budget"]["step"].get<int>() > 0 ? 1 : 0;
      const std::string all = frame["reasons"].dump();
      if (frame["mode"] == "removed") {
        EXPECT_NE(all.find("overload"), std::string::npos) << all;
      } else if (frame["bound_px"].get<double>() > 0.5) {
        EXPECT_NE(all.find("bound_exceeded"), std::string::npos) << all;
      }
    }
    EXPECT_GE(counted, 65);
    EXPECT_LE(late, counted / 100) << times;
    EXPECT_GE(worse, counted * 9 / 10) << times;
    EXPECT_EQ(json["allocations_after_boot"], 0);
    const Ended judged =
        ridgeline({"verify", dump, "--terrain", folder().path(), "--pixels", "1500"});
    EXPECT_EQ(judged.status, 0) << judged.out << judged.err;
  }
}

TEST_F(Monitor, counted_work_leaves_the_same_bytes_whatever_the_machine_does) {
  const auto flown = [&](const std::string& name, const std::string& environment) {
    const std::string dump = folder().file(name);
    const Ended ended =
        ridgeline(replay({"--from", "20", "--to", "21", "--monitor", "work", "--cost-scale", "20",
                          "--dump", dump, "--dump-every", "5", "--record-decisions",
                          folder().file(name + ".decisions")}),
                  environment);
    EXPECT_EQ(ended.status, 0) << ended.err;
    return dump;
  };
  const std::string first = flown("first", ""), second = flown("second", "LP_NUM_THREADS=1");
  EXPECT_EQ(text_of(first + ".decisions"), text_of(second + ".decisions"));
  EXPECT_GT(same_files(first, second), 0);
}

TEST_F(Monitor, what_a_real_clock_decided_is_done_again_exactly) {
  // Terrain comes whenever it is read, slowly, and the deadline is one that no machine keeps
  // always.
  const std::string decisions = folder().file("real.decisions");
  const std::vector<std::string> same{"--from",    "20",       "--to",         "21.5",
                                      "--arrival", "as-ready", "--dump-every", "3"};
  const auto flown = [&](const std::string& name, std::vector<std::string> more) {
    const std::string dump = folder().file(name);
    more.insert(more.end(), same.begin(), same.end());
    more.insert(more.end(), {"--dump", dump});
    const Ended ended = ridgeline(replay(more));
    EXPECT_EQ(ended.status, 0) << ended.err;
    return dump;
  };
  const std::string live = flown("live", {"--monitor", "real", "--deadline-ms", "8", "--delay-us",
                                          "300", "--record-decisions", decisions});
  const std::string again = flown("again", {"--decisions", decisions});
  EXPECT_GE(same_files(live, again), 2 * 16);
}

TEST_F(Monitor, decisions_of_another_run_are_refused_with_file_and_line) {
  const std::string decisions = folder().file("some.decisions");
  const std::vector<std::string> part{"--from", "20", "--to", "20.2"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), part.begin(), part.end());
    return ridgeline(replay(more));
  };
  ASSERT_EQ(with({"--monitor", "work", "--record-decisions", decisions}).status, 0);
  EXPECT_EQ(with({"--decisions", decisions}).status, 0);
  EXPECT_TRUE(with({"--decisions", decisions, "--error", "2"}).says("another --error"));
  EXPECT_TRUE(with({"--decisions", decisions, "--arrival", "as-ready"}).says("another --arrival"));
  const Ended late = ridgeline(replay({"--decisions", decisions, "--from", "21", "--to", "21.2"}));
  EXPECT_EQ(late.status, 3);
  EXPECT_TRUE(late.says("some.decisions:2"));
  const Ended longer = ridgeline(replay({"--decisions", decisions, "--from", "20", "--to", "21"}));
  EXPECT_EQ(longer.status, 3);
  EXPECT_TRUE(longer.says("has no frame"));
  const std::string text = text_of(decisions);
  write_text(decisions, text.substr(0, text.find('\n') + 1) + "{\"frame\": 0}\n");
  expect_one_line(with({"--decisions", decisions}), 3, {"some.decisions:2", "time_ns"});
  write_text(decisions, "frames\n");
  expect_one_line(with({"--decisions", decisions}), 3, {"some.decisions:1"});
  write_text(decisions, "");
  expect_one_line(with({"--decisions", decisions}), 3, {"some.decisions", "empty"});
  expect_one_line(with({"--decisions", folder().file("none")}), 3, {"none"});
  expect_one_line(with({"--decisions", decisions, "--monitor", "work"}), 2, {"--decisions"});
  expect_one_line(with({"--record-decisions", decisions}), 2, {"--monitor"});
}

TEST_F(Monitor, bench_prints_frame_times_with_the_monitor_and_without) {
  const std::string file = folder().file("monitor.json");
  const Ended ended = ridgeline({"bench", "--monitor", "--terrain", folder().path(), "--log",
                                 folder().file("demo.log"), "--size", "96x72", "--range", "15000",
                                 "--views", "12", "--deadline-ms", "20", "--json", file});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.out.find("deadline 20.00 ms"), std::string::npos);
  EXPECT_NE(ended.out.find("| off | "), std::string::npos);
  EXPECT_NE(ended.out.find("| on | "), std::string::npos);
  const Json json = Json::parse(text_of(file));
  ASSERT_EQ(json["flights"].size(), 2U);
  EXPECT_EQ(json["flights"][0]["frames"], json["flights"][1]["frames"]);
  EXPECT_EQ(ridgeline({"bench", "--monitor", "--terrain", folder().path()}).status, 2);
}

}  // namespace
}  // namespace ridgeline::test
