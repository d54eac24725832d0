// PEAK TRC rows of every version, the odd rows, and what is no row.
#include "sim/log/peak_trc.hpp"

#include <gtest/gtest.h>

#include <random>

#include "sim/log/log_date.hpp"

namespace ridgeline {
namespace {

using Kind = CandumpLineKind;
constexpr std::int64_t second = 1'000'000'000;
/// 2021-12-18 14:28:07.062 as UTC.
constexpr std::int64_t start = 1639837687 * second + 62'000'000;

PeakTrcParser parser_of(const std::string& version, const std::string& columns = "") {
  PeakTrcParser parser;
  EXPECT_EQ(parser.line(";$FILEVERSION=" + version).kind, Kind::comment);
  EXPECT_EQ(parser.line(";$STARTTIME=44548.6028595139").kind, Kind::comment);
  if (!columns.empty()) {
    EXPECT_EQ(parser.line(";$COLUMNS=" + columns).kind, Kind::comment);
  }
  return parser;
}

struct Rows {
  const char* version;
  const char* columns;
  const char* received;  // bus 1, 29-bit id 100, 17.5354 s
  const char* sent;      // 11-bit id 704
  const char* remote;    // one byte
  const char* status;    // bus heavy
};

class EveryVersion : public ::testing::TestWithParam<Rows> {};

TEST_P(EveryVersion, gives_the_same_frames) {
  const Rows& rows = GetParam();
  PeakTrcParser parser = parser_of(rows.version, rows.columns);
  const CandumpLine received = parser.line(rows.received);
  ASSERT_EQ(received.kind, Kind::frame) << received.text;
  EXPECT_EQ(received.frame.id, 0x100U);
  EXPECT_TRUE(received.frame.extended);
  EXPECT_EQ(received.frame.length, 8);
  EXPECT_EQ(received.frame.data[0], 0x12);
  EXPECT_EQ(received.frame.data[7], 0xab);
  EXPECT_EQ(received.interface, "can0");
  EXPECT_EQ(received.frame.time_ns, start + 17'535 * second / 1000);
  const CandumpLine sent = parser.line(rows.sent);
  ASSERT_EQ(sent.kind, Kind::frame) << sent.text;
  EXPECT_EQ(sent.frame.id, 0x704U);
  EXPECT_FALSE(sent.frame.extended);
  EXPECT_EQ(sent.frame.length, 2);
  EXPECT_EQ(sent.is_sent, std::string(rows.version) != "1.0");
  const CandumpLine remote = parser.line(rows.remote);
  ASSERT_EQ(remote.kind, Kind::frame) << remote.text;
  EXPECT_TRUE(remote.frame.remote);
  EXPECT_EQ(remote.frame.length, 1);
  const CandumpLine status = parser.line(rows.status);
  ASSERT_EQ(status.kind, Kind::frame) << status.text;
  EXPECT_TRUE(status.frame.error);
  EXPECT_EQ(status.frame.id, 0x4U);
}

INSTANTIATE_TEST_SUITE_P(
    Versions, EveryVersion,
    ::testing::Values(
        Rows{"1.0", "", "     1)     17535  00000100  8  12 00 00 00 00 00 00 AB",
             "     2)     17540      0704  2  00 08", "    12)     48937      0704  1  RTR",
             "     2)     17540  FFFFFFFF  4  00 00 00 08 -- -- -- -- BUSHEAVY"},
        Rows{"1.1", "", "     1)     17535.0  Rx     00000100  8  12 00 00 00 00 00 00 AB ",
             "     2)     17540.3  Tx         0704  2  00 08",
             "12) 48937.6  Rx         0704  1  RTR",
             "     2)     17540.3  Warng  FFFFFFFF  4  00 00 00 08  BUSHEAVY "},
        Rows{"1.2", "", "     1)     17535.000 1  Rx     00000100  8  12 00 00 00 00 00 00 AB",
             "     2)     17540.3 1 Tx         0704  2  00 08", "12) 48937.6 1 Rx     0704  1  RTR",
             "     2)     17540.3 1 Warng  FFFFFFFF  4  00 00 00 08  BUSHEAVY"},
        Rows{"1.3", "", "     1)     17535.000 1  Rx    00000100 -  8    12 00 00 00 00 00 00 AB",
             "2) 17540.300 1  Tx 0704 -  2    00 08", "12) 48937.600 1  Rx   0704 -  1    RTR",
             "2) 17540.300 1  Warng FFFFFFFF -  4    00 00 00 08 BUSHEAVY"},
        Rows{"2.0", "N,O,T,I,d,l,D", "1     17535.000 DT 00000100 Rx 8  12 00 00 00 00 00 00 AB",
             "2 17540.300 DT     0704 Tx 2  00 08", "12 48937.600 RR     0704 Rx 1",
             "2 17540.300 ST          Rx    00 00 00 08"},
        Rows{"2.1", "N,O,T,B,I,d,R,L,D",
             "1     17535.000 DT 1  00000100 Rx -  8    12 00 00 00 00 00 00 AB",
             "2 17540.300 DT 1      0704 Tx -  2    00 08", "12 48937.600 RR 1 0704 Rx -  1",
             "2 17540.300 ST 1         - Rx -  4    00 00 00 08"}));

TEST(PeakTrc, columns_may_come_in_another_order_and_number) {
  PeakTrcParser parser = parser_of("2.1", "O,T,I,B,L,D");
  const CandumpLine line = parser.line("10.5 DT 0137 3 2 AA BB");
  ASSERT_EQ(line.kind, Kind::frame) << line.text;
  EXPECT_EQ(line.interface, "can2");
  EXPECT_EQ(line.frame.id, 0x137U);
  EXPECT_EQ(line.frame.time_ns, start + 10'500'000);
  PeakTrcParser unknown = parser_of("2.1", "O,T,Z");
  EXPECT_EQ(unknown.line("10.5 DT 0137").kind, Kind::malformed);
}

TEST(PeakTrc, fd_rows_have_length_codes_or_bytes) {
  PeakTrcParser codes = parser_of("2.1");
  for (const char* type : {"FD", "FB", "FE", "BI"}) {
    std::string row = std::string("1 1.000 ") + type + " 1 0300 Rx - 9 ";
    for (int byte = 0; byte < 12; ++byte) row += " 0A";
    const CandumpLine line = codes.line(row);
    ASSERT_EQ(line.kind, Kind::frame) << line.text;
    EXPECT_TRUE(line.frame.fd);
    EXPECT_EQ(line.frame.length, 12);
  }
  PeakTrcParser bytes = parser_of("2.0");
  EXPECT_EQ(bytes.line("1 1.000 FD 0300 Rx 3 01 02 03").frame.length, 3);
  EXPECT_EQ(bytes.line("1 1.000 DT 0300 Rx 9 1 2 3 4 5 6 7 8 9").kind, Kind::malformed);
  const CandumpLine raw = codes.line("1 1.000 DT 1 0300 Rx - 13 01 02 03 04 05 06 07 08");
  EXPECT_EQ(raw.raw_dlc, 13);
  EXPECT_EQ(raw.frame.length, 8);
}

/// Found with the properties of the fuzz target: it became a frame that no bus carries.
TEST(PeakTrc, a_remote_row_of_can_fd_is_malformed) {
  PeakTrcParser parser = parser_of("2.1");
  EXPECT_EQ(parser.line("1 1.0 FD 1 0300 Rx - 9 RTR").text, "a remote frame is not CAN FD");
  EXPECT_EQ(parser.line("1 1.0 DT 1 0300 Rx - 2 RTR").kind, Kind::frame);
}

TEST(PeakTrc, rows_about_the_bus_are_error_frames_and_events_are_comments) {
  PeakTrcParser parser = parser_of("2.1");
  EXPECT_EQ(parser.line("1 1.0 ST 1 - Rx - 4 00 00 00 10").frame.id, 0x40U);
  EXPECT_EQ(parser.line("1 1.0 ER 1 - Rx - 5 04 00 02 00 00").frame.id, 0x80U);
  EXPECT_EQ(parser.line("1 1.0 EC 1 - Rx - 2 00 08").frame.id, 0x200U);
  EXPECT_TRUE(parser.line("1 1.0 EC 1 - Rx - 2 00 08").frame.error);
  EXPECT_EQ(parser.line("1 1.0 EV 1 User event").kind, Kind::comment);
  PeakTrcParser old = parser_of("1.1");
  EXPECT_EQ(old.line("5) 1.0 Error 0008 4 00 19 08 08").frame.id, 0x80U);
  EXPECT_TRUE(old.line("5) 1.0 Error 0008 4 00 19 08 08").frame.error);
}

TEST(PeakTrc, comments_labels_and_the_line_of_a_converter) {
  PeakTrcParser parser = parser_of("2.1");
  for (const char* text : {"", ";", ";-----", ";   Generated by somebody", ";$UNKNOWN=1",
                           ";Begin Triggerblock Sat Sep 30 10:06:13.191 PM 2017",
                           "   0.000000 Start of measurement", ";End TriggerBlock"}) {
    EXPECT_EQ(parser.line(text).kind, Kind::comment) << text;
  }
  const CandumpLine label = parser.line("; ridgeline: DERIVED attitude");
  EXPECT_EQ(label.kind, Kind::label);
  EXPECT_EQ(label.text, "DERIVED attitude");
}

TEST(PeakTrc, lines_of_no_known_form_are_malformed_and_say_why) {
  PeakTrcParser parser = parser_of("1.1");
  const std::pair<const char*, const char*> wrong[] = {{"1) x Rx 0100 0", "time"},
                                                       {"1) 1.0 Up 0100 0", "Rx nor Tx"},
                                                       {"1) 1.0 Rx 0800 0", "above 7FF"},
                                                       {"1) 1.0 Rx 20000000 0", "above 1FFFFFFF"},
                                                       {"1) 1.0 Rx 01G0 0", "identifier"},
                                                       {"1) 1.0 Rx 0100 16", "length"},
                                                       {"1) 1.0 Rx 0100 x", "length"},
                                                       {"1) 1.0 Rx 0100 2 00", "fewer"},
                                                       {"1) 1.0 Rx 0100 2 00 000", "fewer"},
                                                       {"1) 1.0 Rx 0100 2 00 00 00", "more"},
                                                       {"1) 9999999999999 Rx 0100 0", "time"},
                                                       {"1)", "time"},
                                                       {"hello", "neither"},
                                                       {"#137", "neither"},
                                                       {";$STARTTIME=today", "STARTTIME"}};
  for (const auto& [text, why] : wrong) {
    const CandumpLine line = parser.line(text);
    EXPECT_EQ(line.kind, Kind::malformed) << text;
    EXPECT_NE(line.text.find(why), std::string_view::npos) << text << ": " << line.text;
  }
  PeakTrcParser newer = parser_of("3.0");
  EXPECT_NE(newer.line("1 1.0 DT 1 0100 Rx - 0").text.find("file version"), std::string_view::npos);
  PeakTrcParser typed = parser_of("2.1");
  EXPECT_NE(typed.line("1 1.0 XX 1 0100 Rx - 0").text.find("type"), std::string_view::npos);
  EXPECT_NE(typed.line("1 1.0 DT 0 0100 Rx - 0").text.find("bus"), std::string_view::npos);
}

TEST(PeakTrc, start_times_are_those_that_the_programs_print) {
  EXPECT_EQ(trc_day_number_ns("44548.6028595139"), start);
  EXPECT_EQ(trc_date_ns("18.12.2021 14:28:07.062.0"), start);
  EXPECT_EQ(trc_date_ns("18.12.2021 14:28:07.062.001"), start + 1000);
  EXPECT_EQ(trc_day_number_ns("43008.920986006946"), 1506809173 * second + 191'000'000);
  EXPECT_EQ(trc_day_number_ns("25569"), 0);
  EXPECT_EQ(trc_day_number_ns("45244.9259259259"), 1'700'000'000 * second);
  for (const char* wrong : {"", "25568.9", "109001", "x", "1e5", "44548.", "-1"}) {
    EXPECT_FALSE(trc_day_number_ns(wrong)) << wrong;
  }
  for (const char* wrong :
       {"", "18.12.2021", "18.12 14:28:07", "32.12.2021 1:1:1", "a.b.c 1:1:1"}) {
    EXPECT_FALSE(trc_date_ns(wrong)) << wrong;
  }
  PeakTrcParser no_key;
  EXPECT_EQ(no_key.line(";    Start time: 18.12.2021 14:28:07.062").kind, Kind::comment);
  EXPECT_EQ(no_key.line("1) 1000 0100 0").frame.time_ns, start + second);
  PeakTrcParser key = parser_of("1.1");
  EXPECT_EQ(key.line(";    Start time: nonsense").kind, Kind::comment) << "the key was there";
  EXPECT_EQ(key.line("1) 1000.0 Rx 0100 0").frame.time_ns, start + second);
}

TEST(PeakTrc, random_text_is_survived_and_lengths_hold) {
  std::mt19937 random(18);
  constexpr std::string_view letters = "0123456789abcdefRxTDTFDSTEV -).;$=, \t\xff";
  for (const char* version : {"1.0", "1.1", "1.2", "1.3", "2.0", "2.1"}) {
    PeakTrcParser parser = parser_of(version);
    for (int round = 0; round < 20'000; ++round) {
      std::string text = random() % 2 == 0 ? "1) 1.0 " : "1 1.0 FD 1 01 Rx - ";
      for (std::size_t count = random() % 90; count > 0; --count) {
        text += letters[random() % letters.size()];
      }
      const CandumpLine line = parser.line(text);
      if (line.kind == Kind::frame) {
        EXPECT_LE(line.frame.length, line.frame.fd ? 64 : 8) << text;
      }
    }
  }
}

}  // namespace
}  // namespace ridgeline
