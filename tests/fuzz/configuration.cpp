// The configuration of an installation. An input is the text of a file.
#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "core/bus/can_filters.hpp"
#include "platform/display/config_keys.hpp"
#include "platform/display/display_config.hpp"
#include "tests/fuzz/input_bytes.hpp"
#include "tests/fuzz/property.hpp"

using namespace ridgeline;
using ridgeline::fuzz::must;

namespace {

/// Every value is one that its key may hold.
void check_values(DisplayConfig config) {
  for (const ConfigKey& key : config_keys()) {
    if (const auto* whole = std::get_if<WholeKey>(&key.rule)) {
      const int value = whole->place(config);
      must(value >= whole->low && value <= whole->high, "a whole number is within its range");
    }
    if (const auto* number = std::get_if<NumberKey>(&key.rule)) {
      const double value = number->place(config);
      must(value >= number->low && value <= number->high, "a number is within its range");
    }
    if (const auto* text = std::get_if<TextKey>(&key.rule)) {
      const std::string& value = text->place(config);
      must(text->is_path || value.size() <= text->longest, "a text is not longer than it may be");
      must(value.find('\0') == std::string::npos, "a text is whole for the system as well");
    }
    if (const auto* list = std::get_if<TextListKey>(&key.rule)) {
      const std::vector<std::string>& values = list->place(config);
      must(values.size() <= list->most, "a list is not longer than it may be");
      for (const std::string& value : values) {
        must(value.size() <= list->longest && list->wrong(value).empty(), "a text of it is right");
      }
    }
  }
}

/// What the parts are told can be told them.
void check_parts(const DisplayConfig& config) {
  const BusProfile profile = bus_profile(config);
  must(offsets_are_distinct(profile.channel_offsets), "no identifier is on two channels");
  must(can_filters(profile).ok(), "a socket can filter what is read");
  must(std::isfinite(frame_settings(config).error_px), "a bound is asked for");
}

/// "FILE:LINE: SECTION.KEY: what is wrong".
void check_problem(const std::string& message, std::string_view text) {
  must(message.starts_with("display.toml:"), "a problem names its file");
  const std::size_t colon = message.find(": ", 13);
  must(colon != std::string::npos && colon > 13, "a problem names its line");
  const long line = std::stol(message.substr(13, colon - 13));
  must(line >= 1 && line <= std::count(text.begin(), text.end(), '\n') + 1,
       "the line of a problem is one of the file");
  must(message.find('\n') == std::string::npos, "a problem is one line");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(fuzz::InputBytes(data, size).text());
  const FileResult<DisplayConfig> config = config_in("display.toml", text);
  if (!config.ok()) {
    check_problem(config.problem().message, text);
    return 0;
  }
  check_values(config.value());
  check_parts(config.value());
  return 0;
}
