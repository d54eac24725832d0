#include "tests/cli/demo_flight.hpp"

#include <filesystem>

#include "sim/synthetic/make_demo.hpp"

namespace ridgeline::test {

const TemporaryFolder& DemoFlight::folder() {
  static const TemporaryFolder made;
  static const bool done = sim::make_demo(made.path()).ok();
  EXPECT_TRUE(done);
  return made;
}

std::vector<std::string> DemoFlight::replay(const std::vector<std::string>& more) const {
  std::vector<std::string> all{
      "replay", folder().file("demo.log"), "--terrain", folder().path(), "--range", "15000"};
  all.insert(all.end(), settings_.begin(), settings_.end());
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

nlohmann::json DemoFlight::report(const std::vector<std::string>& more) const {
  const std::string file = folder().file("report.json");
  std::vector<std::string> arguments = replay(more);
  arguments.insert(arguments.end(), {"--report", file});
  const Ended ended = ridgeline(arguments);
  EXPECT_EQ(ended.status, 0) << ended.err;
  return nlohmann::json::parse(text_of(file));
}

int same_files(const std::string& a, const std::string& b) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(a)) {
    const std::string name = entry.path().filename().string();
    EXPECT_EQ(read_bytes(a + "/" + name), read_bytes(b + "/" + name)) << name;
    ++count;
  }
  const auto others = std::distance(std::filesystem::directory_iterator(b), {});
  EXPECT_EQ(count, others) << "files in one folder only";
  return count;
}

}  // namespace ridgeline::test
