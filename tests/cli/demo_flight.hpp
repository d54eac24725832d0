#pragma once
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"

namespace ridgeline::test {

/// Tests that replay the demo flight over the demo land, which are made once for all tests of a
/// program.
class DemoFlight : public testing::Test {
 protected:
  /// `settings`: options of every replay.
  explicit DemoFlight(std::vector<std::string> settings) : settings_(std::move(settings)) {}

  static const TemporaryFolder& folder();
  /// Arguments of a replay with these options as well, 15 km far.
  [[nodiscard]] std::vector<std::string> replay(const std::vector<std::string>& more) const;
  /// Replays; what the report says.
  [[nodiscard]] nlohmann::json report(const std::vector<std::string>& more) const;

 private:
  std::vector<std::string> settings_;
};

/// Expects that both folders hold the same files with the same bytes; how many.
int same_files(const std::string& a, const std::string& b);

}  // namespace ridgeline::test
