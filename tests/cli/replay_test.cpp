// A replay is a function of the log and the options, and its report says what happened when.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/cli/demo_flight.hpp"

namespace ridgeline::test {
namespace {

using Json = nlohmann::json;

std::set<std::string> words_of(const Json& frame) {
  std::set<std::string> words;
  for (const auto& word : frame["reasons"]) words.insert(word.get<std::string>());
  return words;
}

class Demo : public DemoFlight {
 protected:
  Demo() : DemoFlight({"--size", "96x72"}) {}
};

TEST_F(Demo, the_same_replay_leaves_the_same_bytes) {
  const auto flown = [&](const std::string& name, const std::string& environment) {
    const std::string dump = folder().file(name);
    const Ended ended = ridgeline(
        replay({"--from", "20", "--to", "21.5", "--rate", "4", "--dump", dump}), environment);
    EXPECT_EQ(ended.status, 0) << ended.err;
    return dump;
  };
  const std::string first = flown("first", "");
  EXPECT_EQ(same_files(first, flown("second", "")), 3 * 7);
  EXPECT_EQ(same_files(first, flown("one_thread", "LP_NUM_THREADS=1")), 3 * 7);
  EXPECT_EQ(same_files(first, flown("two_threads", "LP_NUM_THREADS=2")), 3 * 7);
}

TEST_F(Demo, frames_stand_at_the_first_stamp_plus_k_over_rate) {
  const Json json = report({"--from", "3", "--to", "5", "--rate", "3"});
  ASSERT_EQ(json["frames"].size(), 7U);
  for (std::size_t k = 0; k < 7; ++k) {
    EXPECT_EQ(json["frames"][k]["index"], k);
    EXPECT_NEAR(json["frames"][k]["time_s"].get<double>(),
                1'700'000'000.0 + 3 + static_cast<double>(k) / 3, 1e-6);
  }
}

TEST_F(Demo, the_picture_is_removed_while_the_position_is_lost_and_says_so) {
  // No position from 38 s to 41 s; it is stale after 2 s. The report has a frame every 1/4 s.
  const Json json = report({"--from", "37", "--to", "42", "--rate", "4"});
  const Json& frames = json["frames"];
  ASSERT_EQ(frames.size(), 21U);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const double at_s = 37 + static_cast<double>(k) / 4;
    const auto words = words_of(frames[k]);
    if (at_s > 40.2 && at_s < 40.9) {
      EXPECT_EQ(frames[k]["mode"], "removed") << at_s;
      EXPECT_EQ(words.count("position_stale"), 1U) << at_s;
      EXPECT_EQ(words.count("height_stale"), 1U) << at_s;
      EXPECT_TRUE(frames[k]["bound_px"].is_null()) << at_s;
    } else if (at_s < 39.7 || at_s > 41.3) {
      EXPECT_EQ(frames[k]["mode"], "svs") << at_s << ' ' << frames[k]["reasons"];
      EXPECT_EQ(frames[k]["bound_px"], 1.0) << at_s;
    }
    EXPECT_EQ(words.count("attitude_stale"), 0U) << at_s;
  }
}

TEST_F(Demo, the_picture_is_removed_while_the_attitude_is_lost_and_says_so) {
  // No attitude from 62 s to 63 s; it is stale after 0.3 s.
  const Json json = report({"--from", "61", "--to", "64", "--rate", "10"});
  const Json& frames = json["frames"];
  ASSERT_EQ(frames.size(), 31U);
  int removed = 0;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const double at_s = 61 + static_cast<double>(k) / 10;
    const auto words = words_of(frames[k]);
    if (at_s > 62.35 && at_s < 62.95) {
      EXPECT_EQ(frames[k]["mode"], "removed") << at_s;
      EXPECT_EQ(words.count("attitude_stale"), 1U) << at_s;
      EXPECT_EQ(words.count("heading_stale"), 1U) << at_s;
      ++removed;
    } else if (at_s < 62.25 || at_s > 63.15) {
      EXPECT_EQ(frames[k]["mode"], "svs") << at_s << ' ' << frames[k]["reasons"];
    }
    EXPECT_EQ(words.count("position_stale"), 0U) << at_s;
  }
  EXPECT_GE(removed, 5);
}

TEST_F(Demo, the_frame_path_allocates_nothing_after_boot) {
  const Json json = report({"--from", "10", "--to", "13", "--rate", "5"});
  EXPECT_EQ(json["allocations_after_boot"], 0);
  EXPECT_EQ(json["gl_creations_after_boot"], 0);
  EXPECT_GT(json["gl_creations"], 20);
  EXPECT_GT(json["blocks_loaded"], 50);  // the count includes the loading of the window
  EXPECT_GT(json["heap_bytes"].get<double>(), 1e6);
  EXPECT_GT(json["gpu_bytes"].get<double>(), 1e6);
  EXPECT_GT(json["mapped_bytes"].get<double>(), 1e6);
}

TEST_F(Demo, nor_does_it_by_any_other_method) {
  // From the same frames on: what a driver compiles at the first use of a program counts as well.
  for (const char* method :
       {"pgm:grid=64x64", "loffler:grid=64x64", "loffler:grid=64x64,rays=0", "warp:grid=64",
        "hybrid", "hybrid:t=1e9", "clipmap", "mesh", "raycast"}) {
    const Json json = report({"--from", "10", "--to", "11", "--rate", "5", "--method", method});
    EXPECT_EQ(json["frame_count"], 6) << method;
    EXPECT_EQ(json["removed_frames"], 0) << method;
    EXPECT_EQ(json["allocations_after_boot"], 0) << method;
    EXPECT_EQ(json["gl_creations_after_boot"], 0) << method;
  }
}

TEST_F(Demo, removed_frames_leave_no_range_file) {
  const std::string dump = folder().file("lost");
  ASSERT_EQ(
      ridgeline(replay({"--from", "62.3", "--to", "62.9", "--rate", "5", "--dump", dump})).status,
      0);
  int removed = 0;
  for (int index = 0; index < 4; ++index) {
    const std::string stem = dump + "/00000" + std::to_string(index);
    const Json json = Json::parse(text_of(stem + ".json"));
    const bool is_removed = json["mode"] == "removed";
    EXPECT_EQ(std::filesystem::exists(stem + "_range.npy"), !is_removed);
    EXPECT_EQ(json["bound_px"].is_null(), is_removed);
    EXPECT_EQ(json["reasons"].empty(), !is_removed);
    removed += is_removed ? 1 : 0;
  }
  EXPECT_GE(removed, 2);
}

}  // namespace
}  // namespace ridgeline::test
