#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "platform/display/display_config.hpp"

namespace ridgeline {

// What a key may hold, and where it goes.
struct BooleanKey {
  bool& (*place)(DisplayConfig&);
};
struct WholeKey {
  int low, high;
  int& (*place)(DisplayConfig&);
};
struct NumberKey {
  double low, high;
  double& (*place)(DisplayConfig&);
};
struct TextKey {
  std::size_t longest;  ///< bytes
  bool is_path;         ///< relative to the folder of the file; empty and `none` stay as they are
  std::string& (*place)(DisplayConfig&);
};
/// `wrong`: what is wrong with one text of the list; empty: nothing.
struct TextListKey {
  std::size_t longest, most;
  std::string (*wrong)(const std::string&);
  std::vector<std::string>& (*place)(DisplayConfig&);
};
struct ChoiceKey {
  std::span<const std::string_view> words;
  void (*take)(DisplayConfig&, std::size_t word);
};

struct ConfigKey {
  std::string_view section, name;
  bool required;
  std::variant<BooleanKey, WholeKey, NumberKey, TextKey, TextListKey, ChoiceKey> rule;
};

/// Every key there is.
[[nodiscard]] std::span<const ConfigKey> config_keys();

/// "PORT=EQ" of an ARINC 429 port into the profile; what is wrong with it, or empty.
[[nodiscard]] std::string set_arinc429_port(const std::string& text, Arinc429Profile& profile);

}  // namespace ridgeline
