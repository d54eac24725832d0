#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <span>
#include <string>
#include <string_view>

#include "platform/file_result.hpp"
#include "tests/support/temporary_folder.hpp"

namespace ridgeline::sim {

/// A text file of a test.
class InputFile {
 public:
  explicit InputFile(std::string_view text) {
    test::write_bytes(path(), std::as_bytes(std::span(text)));
  }
  [[nodiscard]] std::string path() const { return folder_.file("input.txt"); }

 private:
  test::TemporaryFolder folder_;
};

/// The problem names file and line, is one line, and says `words`.
inline void expect_problem(const InputFile& file, const FileProblem& problem, Fault fault, int line,
                           const std::string& words) {
  EXPECT_EQ(fault_id(problem.fault), fault_id(fault));
  EXPECT_EQ(problem.file, file.path());
  EXPECT_THAT(problem.message,
              testing::StartsWith(file.path() + ":" + std::to_string(line) + ": "));
  EXPECT_THAT(problem.message, testing::HasSubstr(words));
  EXPECT_LT(problem.message.size(), file.path().size() + 160);
  for (const char c : problem.message) EXPECT_GE(c, ' ');
}

}  // namespace ridgeline::sim
