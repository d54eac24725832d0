// Names and settings of methods as the command line gives them.
#include <gtest/gtest.h>

#include <algorithm>

#include "sim/methods/method.hpp"

namespace ridgeline::sim {
namespace {

TEST(MethodSpec, a_name_and_its_settings_come_out_as_they_went_in) {
  for (const char* text : {"mesh", "ridgeline:error=0.5", "pgm:grid=512x256,base=sea"}) {
    MethodSpec spec;
    ASSERT_TRUE(parse_method(text, spec).ok()) << text;
    EXPECT_EQ(method_text(spec), text);
  }
}

TEST(MethodSpec, words_that_are_no_setting_are_named) {
  const std::pair<const char*, const char*> wrong[] = {
      {"", "no name"},         {":error=1", "no name"},
      {"mesh:", "''"},         {"mesh:fast", "'fast'"},
      {"mesh:=1", "'=1'"},     {"mesh:grid=", "'grid='"},
      {"mesh:a=1,,b=2", "''"}, {"mesh:a=1,a=2", "given twice"}};
  for (const auto& [text, word] : wrong) {
    MethodSpec spec;
    const Outcome parsed = parse_method(text, spec);
    EXPECT_FALSE(parsed.ok()) << text;
    EXPECT_NE(parsed.message.find(word), std::string::npos) << parsed.message;
  }
}

TEST(MethodSpec, a_list_tells_the_comma_of_settings_from_that_of_methods) {
  std::vector<MethodSpec> specs;
  ASSERT_TRUE(
      parse_methods("mesh,ridgeline:error=2,planes=4,raycast,embree:threads=1", specs).ok());
  ASSERT_EQ(specs.size(), 4U);
  EXPECT_EQ(method_text(specs[0]), "mesh");
  EXPECT_EQ(method_text(specs[1]), "ridgeline:error=2,planes=4");
  EXPECT_EQ(method_text(specs[2]), "raycast");
  EXPECT_EQ(method_text(specs[3]), "embree:threads=1");
  EXPECT_FALSE(parse_methods("mesh,,raycast", specs).ok());
  EXPECT_FALSE(parse_methods("", specs).ok());
}

TEST(Registry, every_name_can_be_made_or_says_that_it_is_absent) {
  const auto names = method_names();
  EXPECT_GE(names.size(), 4U);
  for (const std::string_view name : names) {
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
    const MethodSpec spec{std::string(name), {}};
    EXPECT_EQ(method_problem(spec), "") << name;
    if (is_own_method(spec)) continue;
    std::string problem;
    const auto method = make_method(spec, problem);
    if (method == nullptr) {
      EXPECT_NE(problem.find("absent"), std::string::npos) << problem;
    } else {
      EXPECT_EQ(method->name(), name);
      EXPECT_FALSE(method->params().empty()) << name;
    }
  }
}

TEST(Registry, no_method_takes_a_setting_it_does_not_have) {
  for (const std::string_view name : method_names()) {
    const std::string problem = method_problem({std::string(name), {{"no_such_word", "1"}}});
    EXPECT_TRUE(problem.empty() || problem.find("no_such_word") != std::string::npos) << problem;
    std::string made;
    const bool absent = make_method({std::string(name), {}}, made) == nullptr &&
                        made.find("absent") != std::string::npos;
    EXPECT_TRUE(absent || !problem.empty()) << name;
  }
}

TEST(Registry, a_name_nobody_knows_lists_those_there_are) {
  const std::string problem = method_problem({"magic", {}});
  EXPECT_NE(problem.find("'magic'"), std::string::npos) << problem;
  for (const std::string_view name : method_names()) {
    EXPECT_NE(problem.find(name), std::string::npos) << problem;
  }
}

TEST(OwnMethod, settings_of_ours_go_into_those_of_the_frame) {
  FrameSettings settings;
  EXPECT_EQ(apply_own_method({"ridgeline", {{"error", "0.5"}, {"planes", "6"}}}, settings), "");
  EXPECT_EQ(settings.error_px, 0.5);
  EXPECT_EQ(settings.node_spacing.planes_px, 6.0);
  EXPECT_FALSE(settings.cast_every_pixel);
  EXPECT_EQ(apply_own_method({"raycast", {}}, settings), "");
  EXPECT_TRUE(settings.cast_every_pixel);
  EXPECT_EQ(settings.error_px, 0.5);
}

TEST(OwnMethod, a_wrong_word_changes_nothing) {
  FrameSettings settings;
  const double before_px = settings.error_px;
  for (const MethodSpec& spec :
       {MethodSpec{"ridgeline", {{"error", "2"}, {"planes", "0"}}},
        MethodSpec{"ridgeline", {{"error", "1e9"}}}, MethodSpec{"raycast", {{"planes", "2"}}},
        MethodSpec{"mesh", {}}}) {
    EXPECT_NE(apply_own_method(spec, settings), "") << method_text(spec);
    EXPECT_EQ(settings.error_px, before_px);
    EXPECT_FALSE(settings.cast_every_pixel);
  }
}

}  // namespace
}  // namespace ridgeline::sim
