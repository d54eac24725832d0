// config/canaerospace.dbc says what the table says, and reads frames as the decoder does.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "core/bus/canaerospace.hpp"
#include "tests/unit/bus/frames.hpp"

namespace ridgeline {
namespace {

struct Signal {
  int multiplexer = -1;  ///< data type code it belongs to; -1: in every frame
  bool selects = false;  ///< the multiplexer itself
  int start = 0, length = 0;
  bool is_signed = false, is_float = false;
  double factor = 0.0, minimum = 0.0, maximum = 0.0;
  std::string unit;
};

struct Message {
  std::string name;
  std::map<std::string, Signal> signals;
};

using Messages = std::map<unsigned, Message>;

Signal signal_of(const std::smatch& part) {
  Signal signal;
  signal.selects = part[2] == "M";
  if (part[3].matched) signal.multiplexer = std::stoi(part[3]);
  signal.start = std::stoi(part[4]);
  signal.length = std::stoi(part[5]);
  signal.is_signed = part[6] == "-";
  signal.factor = std::stod(part[7]);
  signal.minimum = std::stod(part[8]);
  signal.maximum = std::stod(part[9]);
  signal.unit = part[10];
  return signal;
}

/// Reads the whole file; a line of no known form fails the test.
Messages dbc_messages() {
  const std::regex message_line(R"(BO_ (\d+) (\w+): 8 sender)");
  const std::regex signal_line(R"~( SG_ (\w+) (M|m(\d+)|) ?: (\d+)\|(\d+)@0([+-]) )~"
                               R"~(\(([^,]+),0\) \[([^|]+)\|([^\]]+)\] "([^"]*)" display)~");
  const std::regex float_line(R"(SIG_VALTYPE_ (\d+) (\w+) : 1;)");
  const std::regex value_line(
      R"~(VAL_ (\d+) data_type 2 "FLOAT" 3 "LONG" 12 "SHORT2" 15 "CHAR4" 30 "DOUBLEH" 31 "DOUBLEL" ;)~");
  const std::regex other_line(R"(|VERSION ""|NS_ :|BS_:|BU_: sender display|CM_ "[^"]*";)");
  std::ifstream file(RL_SOURCE_DIR "/config/canaerospace.dbc");
  EXPECT_TRUE(file.good());
  Messages messages;
  std::set<unsigned> described;
  unsigned id = 0;
  for (std::string line; std::getline(file, line);) {
    std::smatch part;
    if (std::regex_match(line, part, message_line)) {
      id = static_cast<unsigned>(std::stoul(part[1]));
      EXPECT_EQ(messages.count(id), 0U) << line;
      messages[id].name = part[2];
    } else if (std::regex_match(line, part, signal_line)) {
      EXPECT_TRUE(messages[id].signals.emplace(part[1], signal_of(part)).second) << line;
    } else if (std::regex_match(line, part, float_line)) {
      const auto at = static_cast<unsigned>(std::stoul(part[1]));
      EXPECT_EQ(messages[at].signals.count(part[2]), 1U) << line;
      messages[at].signals[part[2]].is_float = true;
    } else if (std::regex_match(line, part, value_line)) {
      described.insert(static_cast<unsigned>(std::stoul(part[1])));
    } else {
      EXPECT_TRUE(std::regex_match(line, other_line)) << line;
    }
  }
  EXPECT_EQ(described.size(), messages.size());
  return messages;
}

/// A big-endian signal: `start` is its most significant bit, byte * 8 + bit within the byte.
double physical(const Signal& signal, const BusFrame& frame) {
  const int first = signal.start / 8 * 8 + 7 - signal.start % 8;
  std::uint64_t raw = 0;
  for (int bit = first; bit < first + signal.length; ++bit) {
    raw = raw << 1 | (static_cast<std::uint64_t>(frame.data[bit / 8]) >> (7 - bit % 8) & 1U);
  }
  if (signal.is_float) {
    return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(raw)));
  }
  auto value = static_cast<double>(raw);
  if (signal.is_signed && (raw >> (signal.length - 1) & 1U) != 0) {
    value -= std::ldexp(1.0, signal.length);
  }
  return value * signal.factor;
}

std::string dbc_unit(BusUnit unit) {
  constexpr const char* units[] = {"deg", "deg/s", "m", "m/s", "s", "d"};
  return units[static_cast<std::size_t>(unit)];
}

/// The names of the value signals that a row's types ask for, by type code.
std::map<std::string, int> wanted_signals(const BusIcdRow& row) {
  const std::string name(row.name);
  std::map<std::string, int> wanted;
  const auto has = [&](CanasType type) { return (row.quantity.types & type_bit(type)) != 0; };
  if (has(CanasType::float32)) wanted[name + "_float"] = 2;
  if (has(CanasType::int32)) wanted[name + "_long"] = 3;
  if (has(CanasType::short2)) wanted[name + "_short2"] = wanted[name + "_full_scale"] = 12;
  if (has(CanasType::double_high)) wanted[name + "_upper"] = 30;
  if (has(CanasType::double_low)) wanted[name + "_lower"] = 31;
  if (row.parameter == BusParameter::utc) {
    for (const char* part : {"_hour", "_minute", "_second"}) wanted[name + part] = 15;
  }
  if (row.parameter == BusParameter::date) {
    for (const char* part : {"_day", "_month", "_century", "_year"}) wanted[name + part] = 15;
  }
  return wanted;
}

TEST(Dbc, has_the_messages_of_the_table_with_the_signals_of_their_types) {
  const Messages messages = dbc_messages();
  EXPECT_EQ(messages.size(), bus_icd.size());
  for (const BusIcdRow& row : bus_icd) {
    ASSERT_EQ(messages.count(row.id), 1U) << row.name;
    const Message& message = messages.at(row.id);
    EXPECT_EQ(message.name, row.name);
    const std::map<std::string, int> wanted = wanted_signals(row);
    std::set<std::string> extra{"node_id", "data_type", "service_code", "message_code"};
    EXPECT_EQ(message.signals.size(), wanted.size() + extra.size()) << row.name;
    for (const auto& [name, signal] : message.signals) {
      if (extra.count(name) != 0) {
        EXPECT_EQ(signal.selects, name == "data_type");
        EXPECT_EQ(signal.multiplexer, -1);
        continue;
      }
      ASSERT_EQ(wanted.count(name), 1U) << name;
      EXPECT_EQ(signal.multiplexer, wanted.at(name)) << name;
      EXPECT_EQ(signal.is_float, wanted.at(name) == 2) << name;
      const bool is_value = wanted.at(name) == 2 || wanted.at(name) == 3;
      if (is_value) {
        EXPECT_EQ(signal.minimum, row.quantity.minimum) << name;
        EXPECT_EQ(signal.maximum, row.quantity.maximum) << name;
        EXPECT_EQ(signal.unit, dbc_unit(row.quantity.unit)) << name;
      }
    }
  }
}

/// The value that the file's signals give for a frame of a type.
double dbc_value(const BusIcdRow& row, const Message& message, const BusFrame& frame) {
  const std::string name(row.name);
  const auto read = [&](const char* part) {
    return physical(message.signals.at(name + part), frame);
  };
  switch (frame.data[1]) {
    case 2:
      return read("_float");
    case 3:
      return read("_long");
    case 12:
      return read("_short2") * read("_full_scale") / 32767.0;
    case 30:
      return read("_upper");
    case 31:
      return read("_lower");
    default:
      break;
  }
  if (row.parameter == BusParameter::utc) {
    return 3600.0 * read("_hour") + 60.0 * read("_minute") + read("_second");
  }
  return 1000000.0 * read("_century") + 10000.0 * read("_year") + 100.0 * read("_month") +
         read("_day");
}

TEST(Dbc, reads_every_frame_as_the_decoder_does) {
  const Messages messages = dbc_messages();
  std::uint32_t random = 7;
  const auto next = [&random] { return random = random * 1664525U + 1013904223U; };
  std::map<int, int> compared;
  for (int step = 0; step < 200'000; ++step) {
    const BusIcdRow& row = bus_icd[(next() >> 16) % bus_icd.size()];
    constexpr CanasType types[] = {CanasType::float32,     CanasType::int32,
                                   CanasType::short2,      CanasType::char4,
                                   CanasType::double_high, CanasType::double_low};
    const CanasType type = types[(next() >> 16) % 6];
    std::uint32_t bits = next() ^ next() >> 16;
    if (type == CanasType::float32) {
      bits = std::bit_cast<std::uint32_t>(static_cast<float>(static_cast<int>(bits >> 16) - 30000) /
                                          64.0F);
    }
    if (type == CanasType::char4) bits &= 0x1f1f1f3fU;
    if (type == CanasType::char4 && row.parameter == BusParameter::date) {
      bits = (bits & 0x1f0f003fU) | 0x1400U;
    }
    const BusFrame frame = testing::raw_frame(row.id, type, bits, 0.0, 0x2a, 9);
    const Result<DecodedValue> decoded = decode_canaerospace(frame, BusProfile{});
    if (!decoded) continue;
    const Message& message = messages.at(row.id);
    EXPECT_EQ(physical(message.signals.at("node_id"), frame), 9.0);
    EXPECT_EQ(physical(message.signals.at("data_type"), frame), frame.data[1]);
    EXPECT_EQ(physical(message.signals.at("message_code"), frame), 0x2a);
    const double read = dbc_value(row, message, frame);
    ++compared[frame.data[1]];
    if (decoded.value().part != ValuePart::whole) {
      EXPECT_EQ(read, decoded.value().half_bits);
    } else if (row.parameter == BusParameter::date) {
      EXPECT_EQ(read, 20000000.0 + 10000.0 * frame.data[7] + 100.0 * frame.data[5] + frame.data[4]);
    } else {
      const double off = read - decoded.value().value;
      EXPECT_NEAR(row.quantity.wraps ? std::remainder(off, 360.0) : off, 0.0, 1e-9) << row.name;
    }
  }
  for (const int type : {2, 3, 12, 15, 30, 31}) EXPECT_GT(compared[type], 100) << type;
}

}  // namespace
}  // namespace ridgeline
