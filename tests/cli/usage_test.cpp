// Wrong usage ends with status 2 and says what is wrong; right usage with negative numbers works.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/cli/program.hpp"

namespace ridgeline::test {
namespace {

TEST(Usage, negative_positions_are_numbers_and_not_options) {
  const FlatScene scene;  // 45.5 south, 72.5 west, roll -3, pitch -5, heading -90
  const std::string dump = scene.file("dump");
  const Ended ended = ridgeline(scene.pose({"--dump", dump}));
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(ended.err, "");
  EXPECT_NE(ended.out.find("svs: bound 1.000 px"), std::string::npos) << ended.out;
  for (const char* name : {"000000.json", "000000_range.npy", "000000_color.png"}) {
    EXPECT_TRUE(std::filesystem::exists(dump + "/" + name)) << name;
  }
  const std::string json = text_of(dump + "/000000.json");
  EXPECT_NE(json.find("\"lat_deg\": -45.5"), std::string::npos) << json;
  EXPECT_NE(json.find("\"lon_deg\": -72.5"), std::string::npos) << json;
}

TEST(Usage, help_and_its_absence) {
  EXPECT_EQ(ridgeline({"--help"}).status, 0);
  EXPECT_EQ(ridgeline({"pose", "--help"}).status, 0);
  expect_one_line(ridgeline({}), 2, {"subcommand"});
  expect_one_line(ridgeline({"fly"}), 2, {"ridgeline: "});
  expect_one_line(ridgeline({"import", "gpx", "a", "b"}), 2, {"ridgeline: "});
}

TEST(Usage, options_outside_their_domain) {
  const FlatScene scene;
  const std::vector<std::vector<std::string>> wrong{
      {"--size", "64"},   {"--size", "64x"},     {"--size", "64x48x2"},
      {"--size", "0x48"}, {"--size", "-64x48"},  {"--size", "9999x48"},
      {"--hfov", "5"},    {"--hfov", "121"},     {"--hfov", "nan"},
      {"--error", "0"},   {"--error", "-1"},     {"--error", "nan"},
      {"--error", "65"},  {"--range", "10"},     {"--range", "nan"},
      {"--range", "1e9"}, {"--method", "magic"}, {"--nonsense", "1"},
      {"--size"},         {"--range", "far"}};
  for (const auto& options : wrong) {
    const Ended ended = ridgeline(scene.pose(options));
    EXPECT_EQ(ended.status, 2) << options[0] << ' ' << options.back() << ": " << ended.err;
    EXPECT_EQ(ended.error_lines(), 1) << ended.err;
    EXPECT_TRUE(ended.says(options[0])) << ended.err;
  }
}

TEST(Usage, poses_outside_the_domain) {
  const FlatScene scene;
  const std::vector<std::pair<int, std::string>> wrong{
      {1, "91"},   {1, "-90.01"}, {1, "nan"},  {1, "north"}, {2, "361"},
      {2, "-181"}, {2, "inf"},    {3, "1e6"},  {3, "nan"},   {3, "-700"},
      {4, "nan"},  {5, "91"},     {5, "-inf"}, {6, "nan"},   {6, "721"}};
  for (const auto& [place, word] : wrong) {
    std::vector<std::string> arguments = scene.pose();
    arguments[place] = word;
    const Ended ended = ridgeline(arguments);
    EXPECT_EQ(ended.status, 2) << place << ' ' << word << ": " << ended.out << ended.err;
    EXPECT_EQ(ended.error_lines(), 1) << ended.err;
  }
  std::vector<std::string> short_of_one = scene.pose();
  short_of_one.erase(short_of_one.begin() + 6);
  EXPECT_EQ(ridgeline(short_of_one).status, 2);
}

TEST(Usage, replay_options_outside_their_domain) {
  const FlatScene scene;
  const std::vector<std::vector<std::string>> wrong{
      {"--rate", "0"},  {"--rate", "nan"},    {"--rate", "-5"},  {"--from", "nan"},
      {"--from", "-1"}, {"--to", "nan"},      {"--from", "inf"}, {"--profile", "loose"},
      {"--error", "0"}, {"--heading", "left"}};
  for (const auto& options : wrong) {
    const Ended ended = ridgeline(scene.replay(options));
    EXPECT_EQ(ended.status, 2) << options[0] << ' ' << options[1] << ": " << ended.err;
    EXPECT_EQ(ended.error_lines(), 1) << ended.err;
    EXPECT_TRUE(ended.says(options[0])) << ended.err;
  }
}

TEST(Usage, verify_options_outside_their_domain) {
  EXPECT_EQ(ridgeline({"verify", "/nowhere"}).status, 2);  // no --terrain
  EXPECT_EQ(ridgeline({"verify", "/nowhere", "--terrain", "/nowhere", "--pixels", "0"}).status, 2);
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--pixels", "every"},
                                                {"--pixels", "1.5"},
                                                {"--walk", "slow"},
                                                {"--without-slack", "-1"},
                                                {"--threads", "0"}}) {
    std::vector<std::string> words{"verify", "/nowhere", "--terrain", "/nowhere"};
    words.insert(words.end(), wrong.begin(), wrong.end());
    expect_one_line(ridgeline(words), 2, {wrong[0]});
  }
}

TEST(Usage, attack_options_outside_their_domain) {
  for (const std::string seconds : {"-1", "nan", "soon"}) {
    expect_one_line(ridgeline({"verify", "--attack", seconds}), 2, {"--attack"});
  }
  expect_one_line(ridgeline({"verify", "--cases", "0"}), 2, {"--cases"});
  expect_one_line(ridgeline({"verify"}), 2, {"DUMP_DIR"});
  expect_one_line(ridgeline({"verify", "--case", "tile=dt0:46,8"}), 2, {"--case", "pose"});
  expect_one_line(ridgeline({"verify", "--case", "tile=dt0:46,x pose=46,8,0,0,0,0,0"}), 2,
                  {"--case", "\"tile=dt0:46,x\""});
}

TEST(Usage, a_case_is_drawn_and_judged) {
  const Ended ended =
      ridgeline({"verify", "--case",
                 "land=flat:100 tile=dt0:46,8 size=32,24 range=5000 pose=46.5,8.5,700,0,-9,0,0"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.out.find("pixels checked 768, violations 0"), std::string::npos) << ended.out;
}

}  // namespace
}  // namespace ridgeline::test
