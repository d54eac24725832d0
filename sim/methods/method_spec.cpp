#include <algorithm>

#include "sim/methods/method.hpp"

namespace ridgeline::sim {
namespace {

Outcome wrong(std::string_view text, const std::string& what) {
  return {Fault::file_malformed, "method '" + std::string(text) + "': " + what};
}

/// Pieces between separators; an empty text is one empty piece.
std::vector<std::string_view> pieces(std::string_view text, char separator) {
  std::vector<std::string_view> result;
  while (true) {
    const std::size_t end = text.find(separator);
    result.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return result;
    text.remove_prefix(end + 1);
  }
}

}  // namespace

Outcome parse_method(std::string_view text, MethodSpec& spec) {
  spec = {};
  const std::size_t colon = text.find(':');
  spec.name = text.substr(0, colon);
  if (spec.name.empty()) return wrong(text, "it has no name");
  if (colon == std::string_view::npos) return {};
  for (const std::string_view piece : pieces(text.substr(colon + 1), ',')) {
    const std::size_t equals = piece.find('=');
    if (equals == std::string_view::npos || equals == 0 || equals + 1 == piece.size()) {
      return wrong(text, "'" + std::string(piece) + "' is not of the form setting=value");
    }
    std::pair<std::string, std::string> setting{piece.substr(0, equals), piece.substr(equals + 1)};
    const bool twice = std::any_of(spec.settings.begin(), spec.settings.end(),
                                   [&](const auto& other) { return other.first == setting.first; });
    if (twice) return wrong(text, "'" + setting.first + "' is given twice");
    spec.settings.push_back(std::move(setting));
  }
  return {};
}

std::string method_text(const MethodSpec& spec) {
  std::string text = spec.name;
  for (std::size_t k = 0; k < spec.settings.size(); ++k) {
    text += (k == 0 ? ":" : ",") + spec.settings[k].first + "=" + spec.settings[k].second;
  }
  return text;
}

Outcome parse_methods(std::string_view text, std::vector<MethodSpec>& specs) {
  specs.clear();
  std::vector<std::string> texts;
  for (const std::string_view piece : pieces(text, ',')) {
    const std::size_t equals = piece.find('=');
    const bool goes_on = equals != std::string_view::npos && piece.find(':') > equals;
    if (goes_on && !texts.empty()) {
      texts.back() += "," + std::string(piece);
    } else {
      texts.emplace_back(piece);
    }
  }
  for (const std::string& one : texts) {
    MethodSpec spec;
    if (Outcome parsed = parse_method(one, spec); !parsed.ok()) return parsed;
    specs.push_back(std::move(spec));
  }
  return {};
}

}  // namespace ridgeline::sim
