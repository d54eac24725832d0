#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace ridgeline::oracle {
namespace {

TEST(Independence, the_oracle_includes_nothing_of_what_it_judges) {
  std::size_t includes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(RL_ORACLE_SOURCES)) {
    const std::string ending = entry.path().extension().string();
    if (ending != ".hpp" && ending != ".cpp") continue;
    std::ifstream in(entry.path());
    std::string line;
    while (std::getline(in, line)) {
      if (!line.starts_with("#include \"")) continue;
      ++includes;
      EXPECT_TRUE(line.starts_with("#include \"tests/oracle/"))
          << entry.path().filename() << ": " << line;
    }
  }
  EXPECT_GT(includes, 10U);
}

}  // namespace
}  // namespace ridgeline::oracle
