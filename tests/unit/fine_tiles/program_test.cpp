#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <string>

#include "tests/support/temporary_folder.hpp"
#include "tests/support/tile_writer.hpp"

namespace ridgeline::fine {
namespace {

using test::TemporaryFolder;
using ::testing::HasSubstr;

struct Ended {
  int status = -1;
  std::string text;  ///< both outputs
};

/// Runs the program on a line of words without spaces.
Ended run(const std::string& arguments) {
  const std::string command = "'" RL_FINE_TILES_PROGRAM "' " + arguments + " 2>&1 </dev/null";
  Ended ended;
  std::FILE* pipe = ::popen(command.c_str(), "r");  // NOLINT(cert-env33-c): a test's own command
  std::array<char, 4096> block{};
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), pipe)) {
    ended.text.append(block.data(), count);
  }
  const int result = ::pclose(pipe);
  if (WIFEXITED(result)) ended.status = WEXITSTATUS(result);
  return ended;
}

void expect_one_line(const Ended& ended, int status, const std::string& words) {
  EXPECT_EQ(ended.status, status) << ended.text;
  EXPECT_EQ(std::count(ended.text.begin(), ended.text.end(), '\n'), 1) << ended.text;
  EXPECT_THAT(ended.text,
              testing::AllOf(testing::StartsWith("ridgeline-fine-tiles: "), HasSubstr(words)));
}

TEST(FineTilesProgram, fills_a_place_and_says_that_it_is_generated) {
  const TemporaryFolder folder;
  test::write_hgt(folder.file("source/N46E008.hgt"), 1201,
                  [](int row, int column) { return 20 * (row % 40) + 9 * (column % 30); });
  const std::string target = folder.path() + "/target";
  const Ended ended =
      run(folder.path() + "/source " + target + " --factor 3 --place -17,179,1,2 --seed 4");
  EXPECT_EQ(ended.status, 0);
  EXPECT_THAT(ended.text, testing::StartsWith("GENERATED, not measured: 2 tiles of 3601 posts"));
  for (const char* name : {"/S17E179.hgt", "/S17W180.hgt"}) {
    EXPECT_EQ(std::filesystem::file_size(target + name), 2U * 3601 * 3601);
  }
  EXPECT_TRUE(std::filesystem::exists(target + "/GENERATED.txt"));
}

TEST(FineTilesProgram, writes_a_flight) {
  const TemporaryFolder folder;
  const std::string log = folder.path() + "/flight.log";
  const Ended ended = run("flight " + log +
                          " --from -45.5,-72.5 --heading 300 --speed 60 --height 900 --seconds 20 "
                          "--jump-at 5 --jump-km 2 --turn-at 8 --bank 20 --turn-seconds 10");
  EXPECT_EQ(ended.status, 0) << ended.text;
  EXPECT_THAT(ended.text, HasSubstr("SYNTHETIC flight"));
  EXPECT_GT(std::filesystem::file_size(log), 20U * 80 * 3 * 40);
}

TEST(FineTilesProgram, wrong_usage_is_one_line_and_status_2) {
  const TemporaryFolder folder;
  const std::string two = folder.path() + " " + folder.path() + "/target";
  const std::string flight =
      "flight " + folder.path() + "/f.log --heading 0 --height 1 --seconds 9";
  expect_one_line(run(two + " --factor 3 --place 0,0,1"), 2, "--place 0,0,1");
  expect_one_line(run(two + " --factor 3 --place 95,0,1,1"), 2, "south");
  expect_one_line(run(two + " --factor 4 --place 0,0,1,1"), 2, "--factor");
  expect_one_line(run(two + " --place 0,0,1,1"), 2, "--factor");
  expect_one_line(run(folder.path() + " --factor 3 --place 0,0,1,1"), 2, "TARGET_DIR");
  expect_one_line(run(two + " --synthetic --factor 3 --place 0,0,1,1"), 2, "TARGET_DIR");
  expect_one_line(run(folder.path() + " " + folder.path() + " --factor 3 --place 0,0,1,1"), 2,
                  "same folder");
  expect_one_line(run(flight + " --speed 9 --from 12"), 2, "--from 12");
  expect_one_line(run(flight + " --speed 999 --from 1,2"), 2, "speed");
  expect_one_line(run(flight + " --speed 9 --from 1,2 --jump-at 3"), 2, "--jump-km");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(FineTilesProgram, bad_input_is_one_line_and_status_3) {
  const TemporaryFolder folder;
  const std::string target = folder.path() + "/target";
  expect_one_line(run(folder.path() + "/none " + target + " --factor 3 --place 0,0,1,1"), 3,
                  "/none: folder cannot be read");
  test::write_bytes(folder.file("N46E008.hgt"), std::vector<std::byte>(9));
  expect_one_line(run(folder.path() + " " + target + " --factor 9 --place 0,0,1,1"), 3,
                  "N46E008.hgt: file is shorter");
  expect_one_line(run("flight " + folder.path() +
                      "/no/f.log --from 1,2 --heading 0 --height 1 "
                      "--seconds 9 --speed 9"),
                  3, "/no/f.log: file cannot be written");
  EXPECT_FALSE(std::filesystem::exists(target));
}

}  // namespace
}  // namespace ridgeline::fine
