#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <string>

#include "platform/display/config_keys.hpp"
#include "tests/support/scratch_folder.hpp"

namespace ridgeline {
namespace {

using Values = std::map<std::string, std::map<std::string, std::string>>;

/// What has to be there, and nothing more.
Values required() {
  return {{"picture",
           {{"width_px", "640"}, {"height_px", "480"}, {"horizontal_field_of_view_deg", "60"}}},
          {"screen", {{"kind", "\"surfaceless\""}}},
          {"terrain",
           {{"folder", "\"tiles\""},
            {"geoid", "\"none\""},
            {"home_latitude_deg", "46.5"},
            {"home_longitude_deg", "8.5"}}},
          {"bus",
           {{"interfaces", "[\"can0\"]"},
            {"protocol", "\"canaerospace\""},
            {"heading_reference", "\"true\""}}}};
}

class ConfigFile : public testing::Test {
 protected:
  /// Writes the values; notes on which line each key stands.
  void write(const Values& values) {
    std::ofstream stream(path_);
    int line = 0;
    lines_.clear();
    for (const auto& [section, keys] : values) {
      stream << "[" << section << "]\n";
      ++line;
      for (const auto& [key, value] : keys) {
        stream << key << " = " << value << "\n";
        lines_[section + "." + key] = ++line;
      }
    }
  }
  void write_text(const std::string& text) { std::ofstream(path_) << text; }
  FileResult<DisplayConfig> load() const { return load_config(path_); }
  DisplayConfig loaded() const {
    auto config = load();
    EXPECT_TRUE(config.ok()) << (config ? "" : config.problem().message);
    return config ? config.value() : DisplayConfig{};
  }
  /// Expects a refusal that names the line of `key` and begins with these words.
  void expect_refused(const std::string& key, const std::string& words = "") {
    const auto config = load();
    ASSERT_FALSE(config.ok()) << key << ": " << words;
    const std::string start = path_ + ":" + std::to_string(lines_[key]) + ": " + key + ": " + words;
    EXPECT_EQ(config.problem().message.substr(0, start.size()), start);
    EXPECT_EQ(config.problem().message.find('\n'), std::string::npos);
  }
  void expect_refused_with(const ConfigKey& key, const std::string& value) {
    Values values = required();
    const std::string section(key.section), name(key.name);
    values[section][name] = value;
    write(values);
    SCOPED_TRACE(name + " = " + value);
    expect_refused(section + "." + name);
  }

  test::ScratchFolder folder_{"config"};
  std::string path_ = folder_.file("display.toml");
  std::map<std::string, int> lines_;
};

TEST_F(ConfigFile, what_is_required_is_enough_and_the_rest_has_defaults) {
  write(required());
  const DisplayConfig config = loaded();
  EXPECT_EQ(config.picture.width_px, 640);
  EXPECT_EQ(config.picture.rate_hz, 30.0);
  EXPECT_EQ(config.terrain.folder, folder_.file("tiles")) << "relative to the file's folder";
  EXPECT_EQ(config.terrain.geoid, "none");
  EXPECT_EQ(config.bus.heading_reference, HeadingReference::true_north);
  EXPECT_EQ(frame_settings(config).range_m, limits::default_range_m);
  EXPECT_EQ(pose_limits(config).attitude_timeout_ns, limits::attitude_timeout_ns);
  EXPECT_EQ(gpio_settings(config).hold_ns, limits::discrete_hold_ns);
}

TEST_F(ConfigFile, the_monitor_keeps_the_period_unless_told_otherwise) {
  Values values = required();
  values["picture"]["rate_hz"] = "20";
  values["picture"]["error_px"] = "0.5";
  write(values);
  EXPECT_TRUE(loaded().monitor.on);
  EXPECT_EQ(budget_settings(loaded()).deadline_ns, 50 * limits::ms_ns);
  EXPECT_EQ(budget_settings(loaded()).wanted_px, 0.5);
  EXPECT_EQ(budget_settings(loaded()).most_px, limits::budget_most_px);
  values["monitor"] = {{"on", "false"}, {"deadline_ms", "12.5"}, {"most_px", "4"}};
  write(values);
  EXPECT_FALSE(loaded().monitor.on);
  EXPECT_EQ(budget_settings(loaded()).deadline_ns, 12'500'000);
  EXPECT_EQ(budget_settings(loaded()).most_px, 4.0);
}

TEST_F(ConfigFile, the_night_has_a_level_and_the_wheels_a_rule) {
  write(required());
  EXPECT_EQ(loaded().picture.night_luminance, limits::default_night_luminance);
  EXPECT_FALSE(loaded().lines.can_hover);
  Values values = required();
  values["picture"]["night_luminance"] = "0.05";
  values["lines"]["can_hover"] = "true";
  write(values);
  EXPECT_EQ(loaded().picture.night_luminance, 0.05);
  EXPECT_TRUE(loaded().lines.can_hover);
  values["picture"]["night_luminance"] = "0";
  write(values);
  expect_refused("picture.night_luminance", "is not a number from 0.05 to 1");
}

TEST_F(ConfigFile, a_window_is_of_x11_unless_configured_otherwise) {
  Values values = required();
  values["screen"]["kind"] = "\"window\"";
  write(values);
  DisplayConfig config = loaded();
  EXPECT_EQ(screen_settings(config).window_system, WindowSystem::x11);
  values["screen"]["window_system"] = "\"wayland\"";
  values["screen"]["wayland_display"] = "\"/run/somewhere/wayland-3\"";
  write(values);
  config = loaded();
  EXPECT_EQ(screen_settings(config).kind, ScreenKind::window);
  EXPECT_EQ(screen_settings(config).window_system, WindowSystem::wayland);
  EXPECT_STREQ(screen_settings(config).wayland_display, "/run/somewhere/wayland-3");
  values["screen"]["window_system"] = "\"auto\"";
  write(values);
  expect_refused("screen.window_system", "is not one of \"x11\", \"wayland\"");
}

/// No configuration that is accepted meets a limit of the monitor in flight.
TEST_F(ConfigFile, every_rate_gives_a_deadline_that_the_monitor_takes) {
  for (const char* rate_hz : {"0.1", "120"}) {
    Values values = required();
    values["picture"]["rate_hz"] = rate_hz;
    write(values);
    const BudgetSettings settings = budget_settings(loaded());
    EXPECT_GE(settings.deadline_ns, limits::min_deadline_ns) << rate_hz;
    EXPECT_LE(settings.deadline_ns, limits::max_deadline_ns) << rate_hz;
  }
  Values values = required();
  values["monitor"]["deadline_ms"] = "0.5";
  write(values);
  expect_refused("monitor.deadline_ms", "is neither 0 (the period) nor at least 1");
}

TEST_F(ConfigFile, every_required_key_is_missed_by_name) {
  for (const ConfigKey& key : config_keys()) {
    if (!key.required) continue;
    Values values = required();
    ASSERT_EQ(values[std::string(key.section)].erase(std::string(key.name)), 1u) << key.name;
    write(values);
    const auto config = load();
    ASSERT_FALSE(config.ok()) << key.name;
    const std::string words =
        std::string(key.section) + "." + std::string(key.name) + ": is missing";
    EXPECT_NE(config.problem().message.find(words), std::string::npos) << config.problem().message;
  }
}

TEST_F(ConfigFile, every_key_refuses_values_of_another_type_by_line) {
  for (const ConfigKey& key : config_keys()) {
    for (const char* value : {"1979-05-27", "{ a = 1 }", "[[1]]", "[]"}) {
      expect_refused_with(key, value);
    }
    const bool text =
        std::holds_alternative<TextKey>(key.rule) || std::holds_alternative<ChoiceKey>(key.rule);
    if (!text) expect_refused_with(key, "\"12\"");
    if (!std::holds_alternative<BooleanKey>(key.rule)) expect_refused_with(key, "true");
    if (std::holds_alternative<WholeKey>(key.rule)) expect_refused_with(key, "100.0");
    if (text) expect_refused_with(key, "17");
  }
}

TEST_F(ConfigFile, every_number_refuses_what_is_out_of_its_range_by_line) {
  for (const ConfigKey& key : config_keys()) {
    if (const auto* whole = std::get_if<WholeKey>(&key.rule)) {
      expect_refused_with(key, std::to_string(whole->low - 1));
      expect_refused_with(key, std::to_string(whole->high + 1));
      expect_refused_with(key, "9223372036854775807");
    }
    if (const auto* number = std::get_if<NumberKey>(&key.rule)) {
      expect_refused_with(key, std::to_string(number->low - 0.001));
      expect_refused_with(key, std::to_string(number->high + 0.001));
      for (const char* value : {"nan", "inf", "-inf"}) expect_refused_with(key, value);
    }
  }
}

TEST_F(ConfigFile, every_text_and_choice_refuses_what_it_cannot_be) {
  for (const ConfigKey& key : config_keys()) {
    if (std::holds_alternative<ChoiceKey>(key.rule)) expect_refused_with(key, "\"no-such-word\"");
    if (const auto* text = std::get_if<TextKey>(&key.rule)) {
      expect_refused_with(key, "\"" + std::string(text->longest + 1, 'x') + "\"");
      expect_refused_with(key, "\"a\\u0000b\"");
    }
  }
}

TEST_F(ConfigFile, every_choice_takes_each_of_its_words) {
  for (const ConfigKey& key : config_keys()) {
    const auto* choice = std::get_if<ChoiceKey>(&key.rule);
    if (choice == nullptr || key.name == "protocol") continue;
    for (const std::string_view word : choice->words) {
      Values values = required();
      values[std::string(key.section)][std::string(key.name)] = "\"" + std::string(word) + "\"";
      write(values);
      EXPECT_TRUE(load().ok()) << key.name << " " << word;
    }
  }
}

TEST_F(ConfigFile, unknown_keys_and_sections_are_refused_with_their_line) {
  Values values = required();
  values["picture"]["wdith_px"] = "640";
  write(values);
  expect_refused("picture.wdith_px", "there is no such key");
  write_text("[picture]\nwidth_px = 640\n[pictures]\nwidth_px = 640\n");
  EXPECT_EQ(load().problem().message, path_ + ":1: picture.height_px: is missing");
  values = required();
  values["zebra"]["a"] = "1";
  write(values);
  EXPECT_NE(load().problem().message.find("zebra: there is no such section"), std::string::npos);
}

/// Found by fuzzing: the message had two lines, the second of the file's own choosing.
TEST_F(ConfigFile, a_line_feed_in_a_name_does_not_reach_the_message) {
  write_text("\"a\\n\\u001bb\" = 1\n");
  const auto config = load();
  ASSERT_FALSE(config.ok());
  EXPECT_EQ(config.problem().message, path_ + ":1: a??b: there is no such section");
}

/// Found by fuzzing (2026-11-26): undefined behaviour of toml++ at a letter where a key begins.
TEST_F(ConfigFile, letters_outside_ascii_are_refused_in_keys_and_taken_in_texts) {
  for (const char* letter : {"\u010a", "\u00e4", "\u0416", "\ufefa"}) {
    write_text("[picture]\nwidth_px = 640\n" + std::string(letter) + " = 1\n");
    EXPECT_EQ(load().problem().message.rfind(path_ + ":3: ", 0), 0u) << load().problem().message;
  }
  Values values = required();
  values["terrain"]["folder"] = "\"Gel\u00e4nde\"  # \u010a";
  write(values);
  EXPECT_TRUE(loaded().terrain.folder.ends_with("Gel\u00e4nde"));
}

TEST_F(ConfigFile, what_is_no_toml_is_refused_with_its_line) {
  write_text("[picture]\nwidth_px = 640\nheight_px = = 3\n");
  EXPECT_EQ(load().problem().message.rfind(path_ + ":3: ", 0), 0u) << load().problem().message;
  write_text("[picture]\nwidth_px = 640\nwidth_px = 640\n");
  EXPECT_EQ(load().problem().message.rfind(path_ + ":3: ", 0), 0u) << load().problem().message;
}

TEST_F(ConfigFile, a_file_that_cannot_be_read_is_named) {
  EXPECT_EQ(load_config(folder_.file("none.toml")).problem().fault, Fault::file_unreadable);
  EXPECT_EQ(load_config(folder_.path()).problem().fault, Fault::file_unreadable);
}

TEST_F(ConfigFile, keys_that_contradict_each_other_are_refused) {
  Values values = required();
  values["picture"]["error_px"] = "0.0001";
  write(values);
  expect_refused("picture.error_px", "rounding alone costs");
  values = required();
  values["bus"]["arinc429_ports"] = "[\"0=002\"]";
  write(values);
  expect_refused("bus.arinc429_ports", "needs protocol");
  values["bus"]["protocol"] = "\"arinc429\"";
  values["bus"]["arinc429_ports"] = "[\"0=002\", \"0=003\"]";
  write(values);
  expect_refused("bus.arinc429_ports", "'0=003' names a port for the second time");
  values = required();
  values["lines"]["svs_valid"] = "\"out\"";
  values["lines"]["svs_fail"] = "\"out\"";
  write(values);
  expect_refused("lines.svs_fail", "'out' is the line of another key");
  values = required();
  values["bus"]["channel_count"] = "8192";
  write(values);
  expect_refused("bus.channel_count", "asks for more identifiers");
}

TEST_F(ConfigFile, ports_of_arinc429_reach_the_profile) {
  Values values = required();
  values["bus"]["protocol"] = "\"arinc429\"";
  values["bus"]["arinc429_ports"] = "[\"3=00A\", \"15=fff\"]";
  write(values);
  const BusProfile profile = bus_profile(loaded());
  EXPECT_EQ(profile.arinc429.ports[3].equipment, 0x00a);
  EXPECT_EQ(profile.arinc429.ports[15].equipment, 0xfff);
  for (const char* wrong : {"16=001", "1=000", "1=1000", "1", "=1", "1=", "a=1", "1=1 "}) {
    values["bus"]["arinc429_ports"] = "[\"" + std::string(wrong) + "\"]";
    write(values);
    expect_refused("bus.arinc429_ports", "'" + std::string(wrong) + "' is not PORT=EQ");
  }
}

/// Whether a file has a line for the key, as a value or as a comment that shows one.
bool mentions(const std::string& text, std::string_view key) {
  const std::string name = "\n" + std::string(key) + " = ",
                    shown = "\n# " + std::string(key) + " = ";
  return text.find(name) != std::string::npos || text.find(shown) != std::string::npos;
}

TEST(ConfigFolder, each_installation_there_is_checked_and_names_every_key) {
  for (const char* name : {"bench.toml", "cockpit.toml"}) {
    const std::string path = std::string(CONFIG_FOLDER "/") + name;
    const auto config = load_config(path);
    EXPECT_TRUE(config.ok()) << config.problem().message;
    const auto bytes = test::bytes_of(path);
    const std::string text(bytes.begin(), bytes.end());
    for (const ConfigKey& key : config_keys()) {
      EXPECT_TRUE(mentions(text, key.name)) << path << ": " << key.name;
    }
  }
}

}  // namespace
}  // namespace ridgeline
