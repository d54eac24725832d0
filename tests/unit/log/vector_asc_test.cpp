// Vector ASC lines: headers, classic, remote, error and FD frames, events, and what is no line.
#include "sim/log/vector_asc.hpp"

#include <gtest/gtest.h>

#include <random>

#include "sim/log/log_date.hpp"

namespace ridgeline {
namespace {

using Kind = CandumpLineKind;
constexpr std::int64_t second = 1'000'000'000;
/// 2017-09-30 15:06:13.191 as UTC.
constexpr std::int64_t start = 1506783973 * second + 191'000'000;

VectorAscParser hex_parser() {
  VectorAscParser parser;
  EXPECT_EQ(parser.line("date Sam Sep 30 15:06:13.191 2017").kind, Kind::comment);
  EXPECT_EQ(parser.line("base hex  timestamps absolute").kind, Kind::comment);
  return parser;
}

std::string hex_of(const BusFrame& frame) {
  std::string text;
  char byte[4];
  for (int index = 0; index < frame.length; ++index) {
    std::snprintf(byte, sizeof byte, "%02X", frame.data[index]);
    text += byte;
  }
  return text;
}

TEST(VectorAsc, classic_frames_of_both_identifiers_are_read) {
  VectorAscParser parser = hex_parser();
  const CandumpLine line = parser.line(
      "  17.876708 1  6F9             Rx   d 8 05 0C 00 00 00 00 0a FF  Length = 240015");
  ASSERT_EQ(line.kind, Kind::frame) << line.text;
  EXPECT_EQ(line.frame.id, 0x6f9U);
  EXPECT_FALSE(line.frame.extended);
  EXPECT_EQ(line.interface, "can0");
  EXPECT_FALSE(line.is_sent);
  EXPECT_EQ(hex_of(line.frame), "050C000000000AFF");
  EXPECT_EQ(line.frame.time_ns, start + 17 * second + 876'708'000);
  const CandumpLine wide = parser.line("3.098426 12  18EBFF00x       Tx d 3 01 A0 0F");
  ASSERT_EQ(wide.kind, Kind::frame);
  EXPECT_EQ(wide.frame.id, 0x18ebff00U);
  EXPECT_TRUE(wide.frame.extended);
  EXPECT_TRUE(wide.is_sent);
  EXPECT_EQ(wide.interface, "can11");
  EXPECT_EQ(hex_of(wide.frame), "01A00F");
  const CandumpLine long_code = parser.line("13.258671 1  3FF  Tx   d D 55 AA 01 02 03 04 05 06");
  ASSERT_EQ(long_code.kind, Kind::frame);
  EXPECT_EQ(long_code.raw_dlc, 13);
  EXPECT_EQ(long_code.frame.length, 8);
  EXPECT_EQ(parser.line("0.1 1 7FF Rx d 0").kind, Kind::frame);
}

TEST(VectorAsc, remote_frames_may_have_a_length) {
  VectorAscParser parser = hex_parser();
  for (const auto& [text, length] : {std::pair{"2.510001 2 100 Tx r", 0},
                                     {"2.520002 3 200 Tx r Length = 1704000 BitCount = 145", 0},
                                     {"2.584921 4 300 Rx r 8 Length = 1704000", 8}}) {
    const CandumpLine line = parser.line(text);
    ASSERT_EQ(line.kind, Kind::frame) << text;
    EXPECT_TRUE(line.frame.remote);
    EXPECT_EQ(line.frame.length, length) << text;
  }
}

TEST(VectorAsc, error_frames_are_error_frames) {
  VectorAscParser parser = hex_parser();
  for (const char* text : {"2.501000 1 ErrorFrame", "3.501000 1 ErrorFrame ECC: 10100010",
                           "4.501000 2 ErrorFrame Flags = 0xe CodeExt = 0x20a2 Code = 0x82",
                           "30.806898 CANFD 5 Tx ErrorFrame Not Acknowledge error, fffe c7"}) {
    const CandumpLine line = parser.line(text);
    ASSERT_EQ(line.kind, Kind::frame) << text;
    EXPECT_TRUE(line.frame.error) << text;
    EXPECT_EQ(line.frame.length, 0);
  }
}

TEST(VectorAsc, frames_of_a_can_fd_channel_say_by_their_flags_what_they_are) {
  VectorAscParser parser = hex_parser();
  const CandumpLine fd = parser.line(
      "30.005071 CANFD   3 Rx        30a  Generic_Name_12                  1 1 8  8 01 02 03 04 05 "
      "06 07 08   102203  133   303000 e0006659");
  ASSERT_EQ(fd.kind, Kind::frame) << fd.text;
  EXPECT_TRUE(fd.frame.fd);
  EXPECT_EQ(fd.frame.id, 0x30aU);
  EXPECT_EQ(hex_of(fd.frame), "0102030405060708");
  EXPECT_EQ(fd.interface, "can2");
  const CandumpLine classic =
      parser.line("30.1 CANFD 1 Rx 137 0 0 8 8 01 02 00 2A 40 F0 00 00 102203 133 200000 e0");
  ASSERT_EQ(classic.kind, Kind::frame) << classic.text;
  EXPECT_FALSE(classic.frame.fd);
  EXPECT_EQ(hex_of(classic.frame), "0102002A40F00000");
  const CandumpLine remote = parser.line(
      "30.300981 CANFD   3 Tx     50005x        0 1 5 0 140000 73 200050 7a60 46500250");
  ASSERT_EQ(remote.kind, Kind::frame) << remote.text;
  EXPECT_TRUE(remote.frame.remote);
  EXPECT_FALSE(remote.frame.fd);
  EXPECT_EQ(remote.frame.length, 5);
  // Found by fuzzing: such a line became a frame that no bus carries.
  for (const char* both :
       {"1 CANFD 3 Tx 5x 0 1 5 0 1 1 1010", "1 CANFD 3 Tx 5 0 1 2 2 7 8 1 1 10"}) {
    EXPECT_EQ(parser.line(both).kind, Kind::malformed) << both;
  }
  std::string text = "30.5 CANFD 4 Rx 4EE 0 1 f 64";
  for (int byte = 0; byte < 64; ++byte) text += " A1";
  EXPECT_TRUE(parser.line(text + " 1331984 11 0 46").frame.fd) << "flags left 0";
  const CandumpLine full = parser.line(text + " 1331984 11 1000 46");
  ASSERT_EQ(full.kind, Kind::frame);
  EXPECT_EQ(full.frame.length, 64);
  EXPECT_TRUE(parser.line(text).frame.fd) << "no flags at all";
  EXPECT_EQ(parser.line("30.5 CANFD 4 Rx 4EE 0 1 f 65").kind, Kind::malformed);
  EXPECT_EQ(parser.line("30.5 CANFD 4 Rx 4EE name other 1 f 8").kind, Kind::malformed);
}

TEST(VectorAsc, events_without_a_frame_are_comments) {
  VectorAscParser parser = hex_parser();
  for (const char* text :
       {"", "   ", "// version 9.0.0", "//0.000000 previous log file: a.asc",
        "internal events logged", "no internal events logged", "End TriggerBlock",
        "Begin Triggerblock Sam Sep 30 15:06:13.191 2017", "   0.000000 Start of measurement",
        "   0.015991 CAN 1 Status:chip status error passive - TxErr: 132 RxErr: 0",
        "   1.015991 1  Statistic: D 0 R 0 XD 0 XR 0 E 0 O 0 B 0.00%",
        "   3.297743 1  J1939TP FEE3p        6    0  0   -   Rx   d 23 A0 0F A6 60 3B"}) {
    EXPECT_EQ(parser.line(text).kind, Kind::comment) << text;
  }
  const CandumpLine label = parser.line("// ridgeline: SYNTHETIC flight");
  EXPECT_EQ(label.kind, Kind::label);
  EXPECT_EQ(label.text, "SYNTHETIC flight");
}

TEST(VectorAsc, lines_of_no_known_form_are_malformed_and_say_why) {
  VectorAscParser parser = hex_parser();
  const std::pair<const char*, const char*> wrong[] = {
      {"1.0 1 800 Rx d 0", "above 7FF"},
      {"1.0 1 20000000x Rx d 0", "above 1FFFFFFF"},
      {"1.0 1 12G Rx d 0", "identifier"},
      {"1.0 0 123 Rx d 0", "channel"},
      {"1.0 256 123 Rx d 0", "channel"},
      {"1.0 1 123 Up d 0", "Rx nor Tx"},
      {"1.0 1 123 Rx q 0", "neither data"},
      {"1.0 1 123 Rx d", "length"},
      {"1.0 1 123 Rx d 40 00 01 02", "length code is above 15"},
      {"1.0 1 123 Rx d 3 00 01", "fewer data bytes"},
      {"1.0 1 123 Rx d 2 00 100", "above 255"},
      {"1.0 1 123 Rx d 2 00 0x", "fewer data bytes"},
      {"1.x 1 123 Rx d 0", "time"},
      {"9999999999.0 1 123 Rx d 0", "time"},
      {"1.0 what is this", "event"},
      {"1.0", "event"},
      {"something else", "neither a frame"},
      {"base oct timestamps absolute", "base"},
      {"base hex timestamps sometimes", "base"},
      {"date Sam Foo 30 15:06:13.191 2017", "date"},
      {"date Sam Feb 30 15:06:13.191 2017", "date"}};
  for (const auto& [text, why] : wrong) {
    const CandumpLine line = parser.line(text);
    EXPECT_EQ(line.kind, Kind::malformed) << text;
    EXPECT_NE(line.text.find(why), std::string_view::npos) << text << ": " << line.text;
  }
}

TEST(VectorAsc, a_decimal_base_is_decimal_everywhere) {
  VectorAscParser parser;
  EXPECT_EQ(parser.line("base dec  timestamps absolute").kind, Kind::comment);
  const CandumpLine line = parser.line("0.5 1 311 Rx d 8 1 2 0 42 64 240 0 0");
  ASSERT_EQ(line.kind, Kind::frame) << line.text;
  EXPECT_EQ(line.frame.id, 311U);
  EXPECT_EQ(hex_of(line.frame), "0102002A40F00000");
  EXPECT_EQ(parser.line("0.5 1 137 Rx d 1 2A").kind, Kind::malformed);
  EXPECT_EQ(parser.line("0.5 1 418119424x Rx d 1 255").frame.id, 0x18ebff00U);
}

TEST(VectorAsc, relative_times_add_up_over_every_timed_line) {
  VectorAscParser parser;
  EXPECT_EQ(parser.line("base hex timestamps relative").kind, Kind::comment);
  EXPECT_EQ(parser.line("1.0 1 100 Rx d 0").frame.time_ns, second);
  EXPECT_EQ(parser.line("0.5 1 Statistic: D 0").kind, Kind::comment);
  EXPECT_EQ(parser.line("0.25 1 100 Rx q 0").kind, Kind::malformed);
  EXPECT_EQ(parser.line("0.25 1 100 Rx d 0").frame.time_ns, 2 * second);
}

TEST(VectorAsc, relative_times_begin_anew_at_a_dated_trigger_block) {
  VectorAscParser parser;
  EXPECT_EQ(parser.line("base hex timestamps relative").kind, Kind::comment);
  EXPECT_EQ(parser.line("5.0 1 100 Rx d 0").frame.time_ns, 5 * second);
  EXPECT_EQ(parser.line("Begin Triggerblock Sam Sep 30 15:06:13.191 2017").kind, Kind::comment);
  EXPECT_EQ(parser.line("1.0 1 100 Rx d 0").frame.time_ns, start + second);
  EXPECT_EQ(parser.line("Begin Triggerblock").kind, Kind::comment);
  EXPECT_EQ(parser.line("1.0 1 100 Rx d 0").frame.time_ns, start + 2 * second);
}

TEST(VectorAsc, the_date_of_the_trigger_block_wins) {
  VectorAscParser parser = hex_parser();
  EXPECT_EQ(parser.line("Begin TriggerBlock Sat Sep 30 10:06:13.191 PM 2017").kind, Kind::comment);
  EXPECT_EQ(parser.line("1.0 1 100 Rx d 0").frame.time_ns, start + 7 * 3600 * second + second);
}

TEST(VectorAsc, dates_of_both_languages_and_clocks_are_read) {
  EXPECT_EQ(asc_date_ns("Thu Apr 28 10:44:52.480 am 2022"), 1651142692 * second + 480'000'000);
  EXPECT_EQ(asc_date_ns("Die Nov 14 22:13:20 2023"), 1'700'000'000 * second);
  EXPECT_EQ(asc_date_ns("Tue Nov 14 10:13:20 PM 2023"), 1'700'000'000 * second);
  EXPECT_EQ(asc_date_ns("Tue Nov 14 22:13:20 PM 2023"), 1'700'000'000 * second);
  EXPECT_EQ(asc_date_ns("Mit M\xc3\xa4r 1 12:00:00 am 2023"), asc_date_ns("Wed Mar 1 0:0:0 2023"));
  EXPECT_EQ(asc_date_ns("Mit M\xe4r 1 0:00:00 2023"), asc_date_ns("Wed mrz 1 00:00:00.000 2023"));
  EXPECT_EQ(asc_date_ns("Mit Mai 3 1:02:03.4 2023"), asc_date_ns("Wed May 3 01:02:03.400 2023"));
  EXPECT_EQ(asc_date_ns("Mit Dez 3 1:02:03.4 2023"), asc_date_ns("Sun Dec 3 01:02:03.400 2023"));
  for (const char* wrong :
       {"", "Tue", "Tue Nov 14", "Tue Nov 14 22:13 2023", "Tue Nov 32 1:1:1 2023",
        "Tue Nov 14 24:00:00 2023", "Tue Nov 14 22:13:20 23 extra", "Tue Nov 14 22:13:20 1969",
        "Tue Nov 14 a:b:c 2023"}) {
    EXPECT_FALSE(asc_date_ns(wrong)) << wrong;
  }
}

TEST(VectorAsc, random_text_is_survived_and_lengths_hold) {
  std::mt19937 random(17);
  constexpr std::string_view letters = "0123456789abcdefxRrTtdCANFDEror .:/; \t\xff";
  VectorAscParser parser = hex_parser();
  for (int round = 0; round < 100'000; ++round) {
    std::string text = random() % 3 == 0 ? "1.0 1 1A Rx d 8 " : "";
    if (random() % 3 == 0) text = "1.0 CANFD 1 Rx 1A 0 0 f 64 ";
    for (std::size_t count = random() % 120; count > 0; --count)
      text += letters[random() % letters.size()];
    const CandumpLine line = parser.line(text);
    if (line.kind == Kind::frame) {
      EXPECT_LE(line.frame.length, line.frame.fd ? 64 : 8) << text;
      EXPECT_LE(line.frame.id, 0x1fffffffU);
    }
  }
}

}  // namespace
}  // namespace ridgeline
