#include "sim/methods/setting_reader.hpp"

#include <charconv>
#include <cstdio>

namespace ridgeline::sim {
namespace {

template <typename T>
bool whole_text(std::string_view text, T& value) {
  const char* const end = text.data() + text.size();
  const auto [last, fault] = std::from_chars(text.data(), end, value);
  return fault == std::errc{} && last == end;
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

}  // namespace

const std::string* SettingReader::find(std::string_view setting) {
  names_ += (names_.empty() ? "" : ", ") + std::string(setting);
  for (std::size_t k = 0; k < spec_.settings.size(); ++k) {
    if (spec_.settings[k].first != setting) continue;
    known_[k] = true;
    return &spec_.settings[k].second;
  }
  return nullptr;
}

void SettingReader::refuse(std::string_view setting, const std::string& text,
                           const std::string& wanted) {
  if (!problem_.empty()) return;
  problem_ = spec_.name + ":" + std::string(setting) + "=" + text + " is not " + wanted;
}

void SettingReader::number(std::string_view setting, double& value, double low, double high) {
  const std::string* text = find(setting);
  if (text == nullptr) return;
  double read = 0;
  if (whole_text(*text, read) && read >= low && read <= high) {
    value = read;
  } else {
    refuse(setting, *text, "a number from " + short_number(low) + " to " + short_number(high));
  }
}

void SettingReader::whole(std::string_view setting, int& value, int low, int high) {
  const std::string* text = find(setting);
  if (text == nullptr) return;
  int read = 0;
  if (whole_text(*text, read) && read >= low && read <= high) {
    value = read;
  } else {
    refuse(setting, *text,
           "a whole number from " + std::to_string(low) + " to " + std::to_string(high));
  }
}

void SettingReader::flag(std::string_view setting, bool& value) {
  const std::string* text = find(setting);
  if (text == nullptr) return;
  if (*text == "on" || *text == "off") {
    value = *text == "on";
  } else {
    refuse(setting, *text, "on or off");
  }
}

void SettingReader::grid(std::string_view setting, int& columns, int& rows, int low, int high) {
  const std::string* text = find(setting);
  if (text == nullptr) return;
  const std::size_t by = text->find('x');
  int c = 0, r = 0;
  const bool read = by != std::string::npos &&
                    whole_text(std::string_view(*text).substr(0, by), c) &&
                    whole_text(std::string_view(*text).substr(by + 1), r);
  if (read && c >= low && c <= high && r >= low && r <= high) {
    columns = c;
    rows = r;
  } else {
    refuse(setting, *text,
           "COLUMNSxROWS, each from " + std::to_string(low) + " to " + std::to_string(high));
  }
}

void SettingReader::word(std::string_view setting, std::string& value,
                         std::initializer_list<std::string_view> allowed) {
  const std::string* text = find(setting);
  if (text == nullptr) return;
  std::string wanted;
  for (const std::string_view one : allowed) {
    if (*text == one) {
      value = *text;
      return;
    }
    wanted += (wanted.empty() ? "one of " : ", ") + std::string(one);
  }
  refuse(setting, *text, wanted);
}

std::string SettingReader::problem() const {
  for (std::size_t k = 0; k < known_.size(); ++k) {
    if (known_[k]) continue;
    return spec_.name + " has no setting '" + spec_.settings[k].first + "'; it has " +
           (names_.empty() ? "none" : names_);
  }
  return problem_;
}

}  // namespace ridgeline::sim
