// Which reader takes a file, ARINC 429 words in text, and no line of any format lost.
#include <gtest/gtest.h>

#include <random>

#include "config/arinc429_icd.hpp"
#include "sim/log/candump_reader.hpp"
#include "tests/unit/log/temporary_folder.hpp"

namespace ridgeline {
namespace {

using testing::TemporaryFolder;

TEST(LogFormatChoice, the_content_says_what_a_log_is_whatever_its_name) {
  for (const char* name : {"a.log", "a.asc", "a.trc", "a"}) {
    EXPECT_EQ(log_format("(1.0) can0 123#00\n", name), LogFormat::candump);
    EXPECT_EQ(log_format("\n  # a comment\n", name), LogFormat::candump);
    EXPECT_EQ(log_format("\r\ndate Sam Sep 30 15:06:13 2017\r\n", name), LogFormat::vector_asc);
    EXPECT_EQ(log_format("\xef\xbb\xbf"
                         "base hex  timestamps absolute\n",
                         name),
              LogFormat::vector_asc);
    EXPECT_EQ(log_format("// version 9.0.0\n", name), LogFormat::vector_asc);
    EXPECT_EQ(log_format(";$FILEVERSION=2.1\n", name), LogFormat::peak_trc);
    EXPECT_EQ(log_format(";######\n", name), LogFormat::peak_trc);
    EXPECT_EQ(log_format("     1)     17535  00000100  8  00 00\n", name), LogFormat::peak_trc);
    EXPECT_EQ(log_format("something\nbase dec\n", name), LogFormat::vector_asc);
  }
}

TEST(LogFormatChoice, a_content_that_says_nothing_leaves_it_to_the_name) {
  for (const char* content : {"", "something", "1.0 1 123 Rx d 0\n"}) {
    EXPECT_EQ(log_format(content, "/logs.trc/flight.ASC"), LogFormat::vector_asc);
    EXPECT_EQ(log_format(content, "flight.Trc"), LogFormat::peak_trc);
    EXPECT_EQ(log_format(content, "flight.log"), LogFormat::candump);
    EXPECT_EQ(log_format(content, ""), LogFormat::candump);
  }
}

TEST(LogFormatChoice, the_file_and_line_of_a_bad_line_are_told_in_every_format) {
  const TemporaryFolder folder;
  const std::pair<const char*, const char*> logs[] = {
      {"a.log", "(1.0) can0 123#00\n(1.0) can0 123#0\n"},
      {"a.asc", "date Sam Sep 30 15:06:13 2017\n1.0 1 123 Rx d 1 0\n1.0 1 123 Rx d 2 0\n"},
      {"a.trc", ";$FILEVERSION=1.1\n1) 1.0 Rx 0123 0\n2) 1.0 Rx 0123 9\n"}};
  for (const auto& [name, text] : logs) {
    CandumpOptions options;
    options.format = LogFormat::by_content;
    const auto path = folder.file(name, text);
    const Result<CandumpLog> log = candump_log(path, options);
    ASSERT_TRUE(log.ok()) << name;
    EXPECT_EQ(log.value().frames.size(), 1U) << name;
    ASSERT_EQ(log.value().notes.problems.size(), 1U) << name;
    const int line = std::string(name) == "a.log" ? 2 : 3;
    EXPECT_EQ(
        log.value().notes.problems[0].rfind(path.string() + ":" + std::to_string(line) + ": ", 0),
        0U)
        << log.value().notes.problems[0];
  }
}

TEST(LogFormatChoice, no_line_of_any_format_is_lost) {
  const TemporaryFolder folder;
  std::mt19937 random(3);
  constexpr std::string_view letters = "0123456789abcdefRTxd#().;$/ -\t\r";
  constexpr std::array<std::string_view, 8> starts = {"(1.0) can0 123#",
                                                      "1.0 1 123 Rx d 2 ",
                                                      "7) 1.0 Rx 0123 2 ",
                                                      "1 1.0 DT 1 0123 Rx - 2 ",
                                                      ";",
                                                      "// ",
                                                      "(1.0) 429.3 ",
                                                      ""};
  for (const char* head :
       {"(1.0) can0 123#00\n", "base hex\n", ";$FILEVERSION=1.1\n", ";$FILEVERSION=2.1\n"}) {
    std::string text = head;
    std::size_t lines = 1;
    for (; lines < 3000; ++lines) {
      text += starts[random() % starts.size()];
      for (std::size_t count = random() % 12; count > 0; --count) {
        text += letters[random() % letters.size()];
      }
      text += '\n';
    }
    CandumpOptions options;
    options.format = LogFormat::by_content;
    Result<CandumpReader> reader = CandumpReader::open(folder.file("random.log", text), options);
    ASSERT_TRUE(reader.ok());
    std::uint64_t frames = 0;
    while (reader.value().next()) ++frames;
    const CandumpStatistics& s = reader.value().statistics();
    EXPECT_EQ(s.lines, lines) << head;
    EXPECT_EQ(s.frames(), frames) << head;
    EXPECT_EQ(s.frames() + s.xl_frames + s.comment_lines + s.lost_lines + s.bad_lines, s.lines);
    EXPECT_GT(s.bad_lines, 0U) << head;
  }
}

TEST(Arinc429Text, a_word_is_read_as_the_frame_of_the_convention) {
  const CandumpLine line = candump_line("(1700000000.123456) 429.7 e28A0053 T");
  ASSERT_EQ(line.kind, CandumpLineKind::frame) << line.text;
  EXPECT_EQ(line.interface, "429");
  EXPECT_EQ(line.frame.id, arinc429_default_id_base + 7);
  EXPECT_TRUE(line.frame.extended);
  EXPECT_EQ(line.frame.length, 4);
  EXPECT_EQ(line.frame.data[0], 0xe2);
  EXPECT_EQ(line.frame.data[3], 0x53);
  EXPECT_TRUE(line.is_sent);
  EXPECT_EQ(line.frame.time_ns, 1'700'000'000'123'456'000);
  const CandumpLine frame = candump_line("(1700000000.123456) can0 0A429007#E28A0053");
  ASSERT_EQ(frame.kind, CandumpLineKind::frame);
  EXPECT_EQ(frame.frame.id, line.frame.id);
  EXPECT_EQ(frame.frame.data, line.frame.data);
  EXPECT_EQ(candump_line("(1.0) 429.15 E28A0053").frame.id, arinc429_default_id_base + 15);
}

TEST(Arinc429Text, anything_else_behind_such_a_port_is_malformed) {
  for (const char* wrong :
       {"(1.0) 429.16 E28A0053", "(1.0) 429. E28A0053", "(1.0) 429.x E28A0053",
        "(1.0) 429.0 E28A005", "(1.0) 429.0 E28A00533", "(1.0) 429.0 E28A005G", "(1.0) 429.0",
        "(1.0) 429.0 E28A0053 X", "(1.0) can0 E28A0053", "(x) 429.0 E28A0053"}) {
    EXPECT_EQ(candump_line(wrong).kind, CandumpLineKind::malformed) << wrong;
  }
  EXPECT_EQ(candump_line("(1.0) 429.0 123#00").frame.id, 0x123U) << "an interface of that name";
}

}  // namespace
}  // namespace ridgeline
