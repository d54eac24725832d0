#include "sim/log/candump_line.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace ridgeline {
namespace {

using Kind = CandumpLineKind;

TEST(CandumpLine, classic_frame) {
  const CandumpLine line = candump_line("(1436509052.249713) vcan0 137#0102002A40F00000");
  ASSERT_EQ(line.kind, Kind::frame);
  EXPECT_EQ(line.frame.time_ns, 1436509052249713000);
  EXPECT_EQ(line.interface, "vcan0");
  EXPECT_EQ(line.frame.id, 0x137U);
  EXPECT_FALSE(line.frame.extended);
  EXPECT_EQ(line.frame.length, 8);
  EXPECT_EQ(line.frame.data[4], 0x40);
  EXPECT_FALSE(line.is_sent);
}

TEST(CandumpLine, dots_between_bytes_and_lower_case) {
  const CandumpLine line = candump_line("(1.5) can0 7ff#de.ad.be.ef");
  ASSERT_EQ(line.kind, Kind::frame);
  EXPECT_EQ(line.frame.length, 4);
  EXPECT_EQ(line.frame.data[0], 0xde);
  EXPECT_EQ(line.frame.data[3], 0xef);
  EXPECT_EQ(candump_line("(1.5) can0 123#11.2233.44").frame.length, 4);
}

TEST(CandumpLine, no_data_bytes) {
  const CandumpLine line = candump_line("(1.5) can0 123#");
  ASSERT_EQ(line.kind, Kind::frame);
  EXPECT_EQ(line.frame.length, 0);
}

TEST(CandumpLine, eight_digits_are_29_bit_identifiers) {
  const CandumpLine line = candump_line("(1.5) can0 00010130#0102000041200000");
  ASSERT_EQ(line.kind, Kind::frame);
  EXPECT_TRUE(line.frame.extended);
  EXPECT_EQ(line.frame.id, 0x10130U);
}

TEST(CandumpLine, raw_dlc_after_eight_bytes) {
  for (int dlc = 9; dlc <= 15; ++dlc) {
    const std::string text =
        std::string("(1.5) can0 123#1122334455667788_") + "0123456789ABCDEF"[dlc];
    const CandumpLine line = candump_line(text);
    ASSERT_EQ(line.kind, Kind::frame) << text;
    EXPECT_EQ(line.frame.length, 8);
    EXPECT_EQ(line.raw_dlc, dlc);
  }
  EXPECT_EQ(candump_line("(1.5) can0 123#1122334455667788_8").kind, Kind::malformed);
  EXPECT_EQ(candump_line("(1.5) can0 123#11223344556677_9").kind, Kind::malformed);
}

TEST(CandumpLine, remote_frames) {
  for (const char* text : {"(1.5) can0 123#R", "(1.5) can0 123#r", "(1.5) can0 123#R8",
                           "(1.5) can0 123#R0", "(1.5) can0 12345678#R3"}) {
    const CandumpLine line = candump_line(text);
    ASSERT_EQ(line.kind, Kind::frame) << text;
    EXPECT_TRUE(line.frame.remote) << text;
  }
  EXPECT_EQ(candump_line("(1.5) can0 123#R8").frame.length, 8);
  EXPECT_EQ(candump_line("(1.5) can0 123#R8_E").raw_dlc, 14);
  EXPECT_EQ(candump_line("(1.5) can0 123#R9").kind, Kind::malformed);
  EXPECT_EQ(candump_line("(1.5) can0 123#R4_9").kind, Kind::malformed);
}

TEST(CandumpLine, can_fd_with_every_flags_nibble) {
  for (const char flags : std::string("0123456789abcdefABCDEF")) {
    const CandumpLine line =
        candump_line(std::string("(1.5) can0 123##") + flags + "112233445566778899AABBCC");
    ASSERT_EQ(line.kind, Kind::frame) << flags;
    EXPECT_TRUE(line.frame.fd);
    EXPECT_EQ(line.frame.length, 12);
    EXPECT_EQ(line.frame.data[11], 0xcc);
  }
  const CandumpLine full = candump_line("(1.5) can0 123##1" + std::string(128, 'A'));
  ASSERT_EQ(full.kind, Kind::frame);
  EXPECT_EQ(full.frame.length, 64);
  EXPECT_EQ(candump_line("(1.5) can0 123##1" + std::string(130, 'A')).kind, Kind::malformed);
  EXPECT_EQ(candump_line("(1.5) can0 123##").kind, Kind::malformed);
  EXPECT_EQ(candump_line("(1.5) can0 123##1").frame.length, 0);
}

TEST(CandumpLine, error_frames_whatever_their_class) {
  for (const char* text :
       {"(1.5) can0 20000004#0004000000000000", "(1.5) can0 20000080#0000000000000000",
        "(1.5) can0 20000040#0000000000000000"}) {
    const CandumpLine line = candump_line(text);
    ASSERT_EQ(line.kind, Kind::frame) << text;
    EXPECT_TRUE(line.frame.error) << text;
    EXPECT_FALSE(line.frame.extended) << text;
  }
  EXPECT_EQ(candump_line("(1.5) can0 20000004#0004000000000000").frame.id, 4U);
}

TEST(CandumpLine, can_xl_is_recognised_and_skipped) {
  EXPECT_EQ(candump_line("(1.5) can0 45123#81:00:12345678#11223344.556677").kind, Kind::xl_frame);
}

TEST(CandumpLine, five_digit_identifiers_are_malformed) {
  const CandumpLine line = candump_line("(1.5) can0 1869F#0000000041200000");
  EXPECT_EQ(line.kind, Kind::malformed);
  EXPECT_EQ(line.text, "identifier has neither 3 nor 8 digits");
}

TEST(CandumpLine, timestamps_are_decimal_fractions_of_any_length) {
  const auto time_of = [](const std::string& stamp) {
    return candump_line("(" + stamp + ") can0 123#").frame.time_ns;
  };
  EXPECT_EQ(time_of("1614188635.1"), 1614188635100000000);
  EXPECT_EQ(time_of("1614188635.1000000"), 1614188635100000000);
  EXPECT_EQ(time_of("1614188635.000001"), 1614188635000001000);
  EXPECT_EQ(time_of("1614188635.12345678"), 1614188635123456780);
  EXPECT_EQ(time_of("1614188635.123456789"), 1614188635123456789);
  EXPECT_EQ(time_of("1614188635.1234567891234"), 1614188635123456789);
  EXPECT_EQ(time_of("0000000000.000000"), 0);
  EXPECT_EQ(time_of("17"), 17000000000);
}

TEST(CandumpLine, timestamps_that_are_none_are_malformed) {
  for (const char* stamp : {"", ".5", "1.", "1.5x", "-1.5", "1e9", "99999999999.0", "9223372036.9",
                            "2024-01-01 00:00:00.0", "1,5"}) {
    EXPECT_EQ(candump_line(std::string("(") + stamp + ") can0 123#").kind, Kind::malformed)
        << stamp;
  }
  EXPECT_EQ(candump_line("(1.5 can0 123#").kind, Kind::malformed);
}

TEST(CandumpLine, direction_several_blanks_and_carriage_return) {
  const CandumpLine sent = candump_line("(1.5)   can0    123#11   T\r");
  ASSERT_EQ(sent.kind, Kind::frame);
  EXPECT_TRUE(sent.is_sent);
  const CandumpLine received = candump_line("(1.5) can0 123#11 R\r\n");
  ASSERT_EQ(received.kind, Kind::frame);
  EXPECT_FALSE(received.is_sent);
  EXPECT_EQ(candump_line("(1.5) can0 123#11 X").kind, Kind::malformed);
}

TEST(CandumpLine, interface_names_have_up_to_15_characters) {
  EXPECT_EQ(candump_line("(1.5) abcdefghijklmno 123#").interface, "abcdefghijklmno");
  EXPECT_EQ(candump_line("(1.5) abcdefghijklmnop 123#").kind, Kind::malformed);
  EXPECT_EQ(candump_line("(1.5) 0 123#").interface, "0");
}

TEST(CandumpLine, lost_frames_are_counted) {
  const CandumpLine line =
      candump_line("DROPCOUNT: dropped 12 CAN frames on 'can0' socket (total drops 34)");
  ASSERT_EQ(line.kind, Kind::lost);
  EXPECT_EQ(line.lost_count, 12U);
  EXPECT_EQ(candump_line("DROPCOUNT: something else").lost_count, 1U);
}

TEST(CandumpLine, comments_and_labels) {
  EXPECT_EQ(candump_line("").kind, Kind::comment);
  EXPECT_EQ(candump_line("   \r").kind, Kind::comment);
  EXPECT_EQ(candump_line("# anything").kind, Kind::comment);
  const CandumpLine label = candump_line("# ridgeline: SYNTHETIC demo flight \r");
  ASSERT_EQ(label.kind, Kind::label);
  EXPECT_EQ(label.text, "SYNTHETIC demo flight");
}

TEST(CandumpLine, malformed_frames_say_why) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"(1.5) can0 123", "frame has no '#'"},
      {"(1.5) can0", "frame is missing"},
      {"(1.5)", "interface is missing"},
      {"(1.5) can0 12G#11", "identifier is not hexadecimal"},
      {"(1.5) can0 800#11", "11-bit identifier is above 7FF"},
      {"(1.5) can0 FFFFFFFF#11", "29-bit identifier is above 1FFFFFFF"},
      {"(1.5) can0 123#1", "data is not up to 8 hexadecimal bytes"},
      {"(1.5) can0 123#11.", "data is not up to 8 hexadecimal bytes"},
      {"(1.5) can0 123#1.1", "data is not up to 8 hexadecimal bytes"},
      {"(1.5) can0 123#112233445566778899", "data is not up to 8 hexadecimal bytes"},
      {"(1.5) can0 123#GG", "data is not up to 8 hexadecimal bytes"},
      {"(1.5)  can0  RX - -  123   [3]  11 22 33", "frame has no '#'"},
      {"hello", "neither a frame nor a comment"}};
  for (const auto& [text, why] : cases) {
    const CandumpLine line = candump_line(text);
    EXPECT_EQ(line.kind, Kind::malformed) << text;
    EXPECT_EQ(line.text, why) << text;
  }
}

TEST(CandumpLine, no_damage_to_a_line_is_more_than_a_malformed_line) {
  const std::string good = "(1436509052.249713) vcan0 137#0102002A40F00000_9 T";
  for (std::size_t at = 0; at < good.size(); ++at) {
    for (int byte = 0; byte < 256; ++byte) {
      std::string text = good;
      text[at] = static_cast<char>(byte);
      const CandumpLine line = candump_line(text);
      if (line.kind == Kind::frame) {
        ASSERT_LE(line.frame.length, 64);
      }
    }
    EXPECT_NE(candump_line(good.substr(0, at)).kind, Kind::label);
  }
}

}  // namespace
}  // namespace ridgeline
