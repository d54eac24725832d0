#include "sim/log/candump_reader.hpp"

#include <gtest/gtest.h>

#include "core/bus/canaerospace.hpp"
#include "sim/log/canaerospace_writer.hpp"
#include "tests/unit/log/temporary_folder.hpp"

namespace ridgeline {
namespace {

using testing::TemporaryFolder;

TEST(CandumpReader, counts_every_line_under_one_heading) {
  const TemporaryFolder folder;
  const auto path = folder.file("mixed.log",
                                "\xef\xbb\xbf# ridgeline: SYNTHETIC test\r\n"
                                "(1.000000) can0 137#0102002A40F00000\r\n"
                                "\r\n"
                                "(2.0) can1 123#R8\n"
                                "(3.0) can0 123##112\n"
                                "(4.0) can0 20000004#0004000000000000 R\n"
                                "(5.0) can0 45123#81:00:12345678#1122\n"
                                "DROPCOUNT: dropped 7 CAN frames on 'can0' socket (total drops 9)\n"
                                "nonsense\n"
                                "# a comment\n"
                                "(6.0) can0 1869F#00\n"
                                "(7.0) can1 138#0102002AC1F00000 T");
  const Result<CandumpLog> log = candump_log(path);
  ASSERT_TRUE(log.ok());
  const CandumpStatistics& s = log.value().statistics;
  EXPECT_EQ(s.lines, 12U);
  EXPECT_EQ(s.data_frames, 2U);
  EXPECT_EQ(s.remote_frames, 1U);
  EXPECT_EQ(s.fd_frames, 1U);
  EXPECT_EQ(s.error_frames, 1U);
  EXPECT_EQ(s.xl_frames, 1U);
  EXPECT_EQ(s.lost_lines, 1U);
  EXPECT_EQ(s.lost_frames, 7U);
  EXPECT_EQ(s.comment_lines, 3U);
  EXPECT_EQ(s.bad_lines, 2U);
  EXPECT_EQ(s.sent_frames, 1U);
  EXPECT_EQ(s.frames() + s.xl_frames + s.lost_lines + s.comment_lines + s.bad_lines, s.lines);
  EXPECT_EQ(log.value().notes.labels, std::vector<std::string>{"SYNTHETIC test"});
  EXPECT_EQ(log.value().notes.interfaces, (std::vector<std::string>{"can0", "can1"}));
  EXPECT_EQ(log.value().frames.back().interface, 1);
  EXPECT_EQ(
      log.value().notes.problems,
      (std::vector<std::string>{path.string() + ":9: neither a frame nor a comment",
                                path.string() + ":11: identifier has neither 3 nor 8 digits"}));
}

TEST(CandumpReader, reads_memory_in_pieces_as_it_reads_a_file) {
  const std::string text = "(1.5) can0 123#01\r\nbad\n(2.5) can1 7FF##3AABB\n# c";
  CandumpReader whole = CandumpReader::over(text, "log");
  while (whole.next()) {
  }
  EXPECT_EQ(whole.statistics().lines, 4U);
  EXPECT_EQ(whole.statistics().frames(), 2U);
  EXPECT_EQ(whole.notes().problems,
            std::vector<std::string>{"log:2: neither a frame nor a comment"});
  for (const std::size_t piece : {1U, 2U, 5U}) {
    CandumpReader reader = CandumpReader::over(text, "log", {LogFormat::by_content, false}, piece);
    EXPECT_EQ(reader.next()->id, 0x123U);
    EXPECT_EQ(reader.next()->data[1], 0xbb);
    EXPECT_FALSE(reader.next());
    EXPECT_EQ(reader.statistics(), whole.statistics()) << piece;
  }
}

TEST(CandumpReader, keeps_only_the_first_problems_but_counts_all) {
  const TemporaryFolder folder;
  std::string text = "(1.0) can0 123#\n";
  for (int line = 0; line < 100; ++line) text += "bad\n";
  const Result<CandumpLog> log = candump_log(folder.file("bad.log", text));
  ASSERT_TRUE(log.ok());
  EXPECT_EQ(log.value().statistics.bad_lines, 100U);
  EXPECT_EQ(log.value().notes.problems.size(), 10U);
}

TEST(CandumpReader, puts_frames_of_slow_interfaces_in_time_order) {
  const TemporaryFolder folder;
  const Result<CandumpLog> log =
      candump_log(folder.file("order.log",
                              "(2.00) can0 001#\n(1.12) can1 002#\n(2.00) can1 003#\n(2.10) can0 "
                              "004#\n(1.22) can1 005#\n"));
  ASSERT_TRUE(log.ok());
  std::vector<std::uint32_t> ids;
  for (const BusFrame& frame : log.value().frames) ids.push_back(frame.id);
  EXPECT_EQ(ids, (std::vector<std::uint32_t>{2, 5, 1, 3, 4}));
  EXPECT_EQ(log.value().statistics.time_reversals, 2U);
  EXPECT_EQ(log.value().statistics.largest_reversal_ns, 880'000'000);
}

TEST(CandumpReader, folds_short_identifiers_only_when_told) {
  const TemporaryFolder folder;
  const auto path = folder.file("fold.log",
                                "(1.0) can0 0000040C#0103000A1BB75640\n"
                                "(1.1) can0 0001040C#0103000A1BB75640\n");
  EXPECT_TRUE(candump_log(path).value().frames[0].extended);
  const Result<CandumpLog> folded = candump_log(path, {.fold_short_ids = true});
  EXPECT_FALSE(folded.value().frames[0].extended);
  EXPECT_TRUE(folded.value().frames[1].extended);
  EXPECT_EQ(folded.value().statistics.folded_ids, 1U);
}

TEST(CandumpReader, files_without_frames_are_faults) {
  const TemporaryFolder folder;
  EXPECT_EQ(candump_log(folder.path() / "none.log").fault(), Fault::file_unreadable);
  EXPECT_EQ(candump_log(folder.path()).fault(), Fault::file_unreadable);
  EXPECT_EQ(candump_log(folder.file("empty.log", "")).fault(), Fault::log_without_frames);
  EXPECT_EQ(candump_log(folder.file("words.log", "# ridgeline: DERIVED\nhello\n")).fault(),
            Fault::log_without_frames);
  EXPECT_EQ(
      candump_log(folder.file("two.log", "(1.0) can0 001#\n(1.0) can0 001#\n"), {}, 1).fault(),
      Fault::capacity_exceeded);
}

TEST(CandumpReader, lines_of_any_length_and_binary_data_are_survived) {
  const TemporaryFolder folder;
  std::string text(300'000, 'x');
  text += "\n(1.0) can0 123#11\n";
  for (int byte = 0; byte < 5000; ++byte) text += static_cast<char>((byte * 37) % 256);
  text += "\n(2.0) can0 123#22";
  const Result<CandumpLog> log = candump_log(folder.file("noise.log", text));
  ASSERT_TRUE(log.ok());
  EXPECT_EQ(log.value().frames.size(), 2U);
  EXPECT_GE(log.value().statistics.bad_lines, 2U);
}

TEST(CandumpReader, more_interfaces_than_an_index_can_name_are_bad_lines) {
  const TemporaryFolder folder;
  std::string text;
  for (int index = 0; index < 300; ++index) {
    text += "(1.0) can" + std::to_string(index) + " 001#\n";
  }
  const Result<CandumpLog> log = candump_log(folder.file("many.log", text));
  ASSERT_TRUE(log.ok());
  EXPECT_EQ(log.value().frames.size(), 255U);
  EXPECT_EQ(log.value().statistics.bad_lines, 45U);
}

TEST(CandumpReader, what_the_writer_writes_is_read_back) {
  const TemporaryFolder folder;
  constexpr std::int64_t time_ns = 1566720131'000'400'000;
  const std::vector<BusFrame> frames = {
      float_frame(BusParameter::roll, -30.0, time_ns, {1, 0, 42}),
      position_frame(BusParameter::gps_latitude, -46.5, time_ns, {2, 0, 255}),
      utc_frame(time_ns, {2, 0, 0}), date_frame(time_ns, {2, 0, 0})};
  std::string text;
  for (const BusFrame& frame : frames) text += candump_text(frame, "can0") + "\n";
  const Result<CandumpLog> log = candump_log(folder.file("round.log", text));
  ASSERT_TRUE(log.ok());
  ASSERT_EQ(log.value().frames.size(), frames.size());
  for (std::size_t index = 0; index < frames.size(); ++index) {
    EXPECT_EQ(log.value().frames[index].time_ns, time_ns);
    EXPECT_EQ(log.value().frames[index].id, frames[index].id);
    EXPECT_EQ(log.value().frames[index].data, frames[index].data);
  }
  EXPECT_EQ(decode_canaerospace(frames[0], {}).value().value, -30.0);
  EXPECT_NEAR(decode_canaerospace(frames[1], {}).value().value, -46.5, 1e-12);
  EXPECT_EQ(decode_canaerospace(frames[2], {}).value().value, 8 * 3600 + 2 * 60 + 11);
  EXPECT_EQ(decode_canaerospace(frames[3], {}).value().value, 18133.0);  // 25 August 2019
}

}  // namespace
}  // namespace ridgeline
