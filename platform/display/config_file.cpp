#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>

#include "core/bus/can_filters.hpp"
#include "core/geo/camera.hpp"
#include "core/render/frame_blocks.hpp"
#include "platform/display/config_keys.hpp"

namespace ridgeline {
namespace {

/// The first problem of a file, by line.
class Problems {
 public:
  void add(std::uint32_t line, const std::string& what) {
    if (!first_line_ || line < *first_line_) {
      first_line_ = line;
      what_ = what;
    }
  }
  [[nodiscard]] bool none() const { return !first_line_; }
  /// Names of keys and texts may hold a line feed; a message is one line all the same.
  [[nodiscard]] FileProblem told(const std::string& path) const {
    std::string what = what_;
    std::replace_if(
        what.begin(), what.end(), [](char c) { return (c >= 0 && c < ' ') || c == 0x7f; }, '?');
    return {Fault::file_malformed, path, path + ":" + std::to_string(*first_line_) + ": " + what};
  }

 private:
  std::optional<std::uint32_t> first_line_;
  std::string what_;
};

std::uint32_t line_of(const toml::node& node) {
  return node.source().begin.line;
}

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

/// What is being filled, and relative to what.
struct Filling {
  DisplayConfig& config;
  std::string folder;  ///< of the file, with a slash at its end, or empty
};

std::string taken(const BooleanKey& rule, const toml::node& node, Filling& filling) {
  const auto value = node.value_exact<bool>();
  if (!value) return "is not true or false";
  rule.place(filling.config) = *value;
  return {};
}

std::string taken(const WholeKey& rule, const toml::node& node, Filling& filling) {
  const auto value = node.value_exact<std::int64_t>();
  if (!value || *value < rule.low || *value > rule.high) {
    return "is not a whole number from " + std::to_string(rule.low) + " to " +
           std::to_string(rule.high);
  }
  rule.place(filling.config) = static_cast<int>(*value);
  return {};
}

std::string taken(const NumberKey& rule, const toml::node& node, Filling& filling) {
  std::optional<double> value;
  if (node.is_floating_point()) value = node.value_exact<double>();
  if (const auto whole = node.value_exact<std::int64_t>()) value = static_cast<double>(*whole);
  if (!value || !(*value >= rule.low && *value <= rule.high)) {
    return "is not a number from " + number_text(rule.low) + " to " + number_text(rule.high);
  }
  rule.place(filling.config) = *value;
  return {};
}

std::string wrong_text(const std::optional<std::string>& value, std::size_t longest) {
  if (!value) return "is not a text";
  if (value->size() > longest) return "is longer than " + std::to_string(longest) + " bytes";
  if (value->find('\0') != std::string::npos) return "holds a zero byte";
  return {};
}

std::string taken(const TextKey& rule, const toml::node& node, Filling& filling) {
  auto value = node.value_exact<std::string>();
  if (std::string wrong = wrong_text(value, rule.longest); !wrong.empty()) return wrong;
  const bool relative = rule.is_path && !value->empty() && *value != "none" && (*value)[0] != '/';
  rule.place(filling.config) = relative ? filling.folder + *value : *value;
  return {};
}

std::string taken(const TextListKey& rule, const toml::node& node, Filling& filling) {
  const toml::array* list = node.as_array();
  if (list == nullptr) return "is not a list of texts";
  if (list->empty() || list->size() > rule.most) {
    return "does not have 1 to " + std::to_string(rule.most) + " texts";
  }
  std::vector<std::string> texts;
  for (const toml::node& item : *list) {
    const auto value = item.value_exact<std::string>();
    std::string wrong = wrong_text(value, rule.longest);
    if (wrong.empty()) wrong = rule.wrong(*value);
    if (!wrong.empty()) return (value ? "'" + *value + "' " : "an item ") + wrong;
    for (const std::string& before : texts) {
      if (before == *value) return "'" + *value + "' is there twice";
    }
    texts.push_back(*value);
  }
  rule.place(filling.config) = std::move(texts);
  return {};
}

std::string taken(const ChoiceKey& rule, const toml::node& node, Filling& filling) {
  const auto value = node.value_exact<std::string>();
  std::string all;
  for (std::size_t word = 0; word < rule.words.size(); ++word) {
    if (value && *value == rule.words[word]) {
      rule.take(filling.config, word);
      return {};
    }
    all += (word == 0 ? "\"" : ", \"") + std::string(rule.words[word]) + "\"";
  }
  return "is not one of " + all;
}

std::string name_of(const ConfigKey& key) {
  return std::string(key.section) + "." + std::string(key.name);
}

bool is_section(std::string_view name) {
  for (const ConfigKey& key : config_keys()) {
    if (key.section == name) return true;
  }
  return false;
}

const ConfigKey* key_of(std::string_view section, std::string_view name) {
  for (const ConfigKey& key : config_keys()) {
    if (key.section == section && key.name == name) return &key;
  }
  return nullptr;
}

void take_section(std::string_view section, const toml::table& table, Filling& filling,
                  Problems& problems) {
  for (const auto& entry : table) {
    const toml::key& name = entry.first;
    const toml::node& node = entry.second;  // clang before 16 captures no structured binding
    const std::string full = std::string(section) + "." + std::string(name.str());
    const ConfigKey* key = key_of(section, name.str());
    if (key == nullptr) {
      problems.add(name.source().begin.line, full + ": there is no such key");
      continue;
    }
    const auto take = [&](const auto& rule) { return taken(rule, node, filling); };
    const std::string wrong = std::visit(take, key->rule);
    if (!wrong.empty()) problems.add(line_of(node), full + ": " + wrong);
  }
}

/// Where to look for what a key says: its own line, else its section's, else the file's first.
std::uint32_t line_of_key(const toml::table& root, std::string_view section,
                          std::string_view name) {
  const toml::node* table = root.get(section);
  if (table == nullptr || !table->is_table()) return 1;
  const toml::node* node = table->as_table()->get(name);
  return line_of(node != nullptr ? *node : *table);
}

void check_required(const toml::table& root, Problems& problems) {
  for (const ConfigKey& key : config_keys()) {
    const toml::node* table = root.get(key.section);
    const bool there =
        table != nullptr && table->is_table() && table->as_table()->contains(key.name);
    if (key.required && !there) {
      problems.add(line_of_key(root, key.section, key.name), name_of(key) + ": is missing");
    }
  }
}

/// What single keys cannot show.
void check_together(const toml::table& root, const DisplayConfig& config, Problems& problems) {
  const auto tell = [&](std::string_view section, std::string_view name, const std::string& what) {
    problems.add(line_of_key(root, section, name),
                 std::string(section) + "." + std::string(name) + ": " + what);
  };
  const auto made = camera({}, frame_settings(config).image);
  if (!made) {
    tell("picture", "horizontal_field_of_view_deg", std::string(fault_text(made.fault())));
  } else if (const double least_px = smallest_error_px(made.value());
             config.picture.error_px < least_px) {
    tell("picture", "error_px",
         "rounding alone costs " + number_text(std::ceil(least_px * 1e4) * 1e-4) +
             " px in this picture");
  }
  const double deadline_ms = config.monitor.deadline_ms;
  if (deadline_ms > 0 && deadline_ms < 1e-6 * limits::min_deadline_ns) {
    tell("monitor", "deadline_ms", "is neither 0 (the period) nor at least 1");
  }
  if (config.terrain.folder.empty()) tell("terrain", "folder", "is empty");
  if (config.terrain.geoid.empty()) tell("terrain", "geoid", "is neither a file nor \"none\"");
  const bool is_arinc429 = config.bus.protocol == BusProtocol::arinc429;
  if (is_arinc429 && config.bus.arinc429_ports.empty()) {
    tell("bus", "arinc429_ports", "is missing: a label means nothing without its equipment");
  }
  if (!is_arinc429 && !config.bus.arinc429_ports.empty()) {
    tell("bus", "arinc429_ports", "needs protocol = \"arinc429\"");
  }
  Arinc429Profile ports;
  for (const std::string& port : config.bus.arinc429_ports) {
    const std::string wrong = set_arinc429_port(port, ports);
    if (!wrong.empty()) tell("bus", "arinc429_ports", "'" + port + "' " + wrong);
  }
  if (problems.none() && !can_filters(bus_profile(config))) {
    tell("bus", "channel_count", "asks for more identifiers than one socket can filter");
  }
}

void check_lines(const toml::table& root, const DisplayConfig& config, Problems& problems) {
  std::vector<std::string> names;
  for (const ConfigKey& key : config_keys()) {
    const TextKey* rule = std::get_if<TextKey>(&key.rule);
    if (key.section != "lines" || rule == nullptr) continue;
    DisplayConfig copy = config;
    const std::string name = rule->place(copy);
    for (const std::string& before : names) {
      if (!name.empty() && name == before) {
        problems.add(line_of_key(root, key.section, key.name),
                     name_of(key) + ": '" + name + "' is the line of another key");
      }
    }
    names.push_back(name);
  }
}

}  // namespace

FileResult<DisplayConfig> load_config(const std::string& path) {
  // A folder opens like a file, and then its reading throws.
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    return file_problem(path, Fault::file_unreadable, "it is a folder");
  }
  std::ifstream stream(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream.is_open() || stream.bad()) return file_problem(path, Fault::file_unreadable, {});
  return config_in(path, text);
}

FileResult<DisplayConfig> config_in(const std::string& path, const std::string& text) {
  const toml::parse_result parsed = toml::parse(text, path);
  Problems problems;
  if (!parsed) {
    problems.add(parsed.error().source().begin.line, std::string(parsed.error().description()));
    return problems.told(path);
  }
  const toml::table& root = parsed.table();
  DisplayConfig config;
  const std::size_t slash = path.rfind('/');
  Filling filling{config, slash == std::string::npos ? "" : path.substr(0, slash + 1)};
  for (const auto& [name, node] : root) {
    if (!is_section(name.str())) {
      problems.add(name.source().begin.line,
                   std::string(name.str()) + ": there is no such section");
    } else if (!node.is_table()) {
      problems.add(line_of(node), std::string(name.str()) + ": is a section, not a value");
    } else {
      take_section(name.str(), *node.as_table(), filling, problems);
    }
  }
  check_required(root, problems);
  if (problems.none()) check_together(root, config, problems);
  if (problems.none()) check_lines(root, config, problems);
  if (!problems.none()) return problems.told(path);
  return config;
}

}  // namespace ridgeline
