#pragma once
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "sim/methods/method.hpp"

namespace ridgeline::sim {

/// Reads the settings of one method. Each call names one setting the method knows and leaves its
/// value as it is where the spec does not give it; problem() then tells the first word that is
/// wrong.
class SettingReader {
 public:
  /// `spec` must outlive the reader.
  explicit SettingReader(const MethodSpec& spec) : spec_(spec), known_(spec.settings.size()) {}

  void number(std::string_view setting, double& value, double low, double high);
  void whole(std::string_view setting, int& value, int low, int high);
  /// `on` or `off`.
  void flag(std::string_view setting, bool& value);
  /// Of the form 512x256, each side from `low` to `high`.
  void grid(std::string_view setting, int& columns, int& rows, int low, int high);
  void word(std::string_view setting, std::string& value,
            std::initializer_list<std::string_view> allowed);

  /// Empty, or one sentence that names the method, the setting and what is wrong. Call it last: a
  /// setting that no call has named is one the method does not have.
  [[nodiscard]] std::string problem() const;

 private:
  const std::string* find(std::string_view setting);
  void refuse(std::string_view setting, const std::string& text, const std::string& wanted);

  const MethodSpec& spec_;
  std::vector<bool> known_;
  std::string problem_, names_;
};

}  // namespace ridgeline::sim
