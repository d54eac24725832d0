// What holds for every protocol: any bytes, values in range only, one flight told three ways.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/bus/bus_decoder.hpp"
#include "core/bus/canas_services.hpp"
#include "tests/unit/bus/other_frames.hpp"
#include "tests/unit/state/ownship_fixture.hpp"

namespace ridgeline {
namespace {

using P = BusParameter;
using testing::Ownship;

BusProfile profile_of(BusProtocol protocol) {
  BusProfile profile;
  profile.protocol = protocol;
  profile.header_rule = HeaderRule::field;
  profile.channel_count = 3;
  profile.canfix_height_is_ellipsoidal = true;
  profile.fixed_variation_deg = 2.0;
  const std::uint16_t equipment[] = {0x004, 0x00b, 0x006, 0x038, 0x005, 0x055};
  for (std::size_t port = 0; port < 6; ++port) {
    profile.arinc429.ports[port].equipment = equipment[port];
  }
  return profile;
}

/// Numbers of 32 bits, the same every time.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  std::uint32_t operator()() { return static_cast<std::uint32_t>(engine_()); }
  std::uint8_t below(std::uint32_t count) { return static_cast<std::uint8_t>((*this)() % count); }

 private:
  std::mt19937 engine_;
};

/// Identifiers that reach a table often, everything else at random, flags and lengths included.
BusFrame random_frame(Random& random, std::int64_t time_ns) {
  BusFrame frame;
  frame.time_ns = time_ns;
  for (std::uint8_t& byte : frame.data) byte = random.below(256);
  switch (random() % 5) {
    case 0:
      frame.id = random() & 0x1fffffffU;
      frame.extended = true;
      break;
    case 1:
      frame.id = arinc429_default_id_base + random() % 18;
      frame.extended = true;
      break;
    case 2:
      frame.id = canfix_icd[random() % canfix_icd.size()].id;
      frame.data[1] = random.below(4);
      frame.data[2] = random() % 8 == 0 ? frame.data[2] : 0;
      break;
    default:
      frame.id = bus_icd[random() % bus_icd.size()].id + ((random() % 4) << 16);
      frame.extended = frame.id > 0x7ff;
      frame.data[1] = random.below(34);
      break;
  }
  // A word of the table every other time, with any data, its parity right as often as not.
  if (random() % 2 == 0) {
    const Arinc429Row& row = arinc429_icd[random() % arinc429_icd.size()];
    const std::uint32_t word =
        testing::word_of(row.label, random(), random() % 4) ^ (random() % 2 << 31);
    for (int byte = 0; byte < 4; ++byte) {
      if (frame.id >= arinc429_default_id_base) {
        frame.data[byte] = static_cast<std::uint8_t>(word >> (24 - 8 * byte));
      }
    }
  }
  const unsigned kind = random() % 32;
  frame.remote = kind == 0;
  frame.error = kind == 1;
  frame.fd = kind == 2;
  frame.length = static_cast<std::uint8_t>(random() % 4 == 0   ? random() % (frame.fd ? 65 : 9)
                                           : random() % 2 == 0 ? 8
                                                               : 4);
  frame.interface = random() % 16 == 0;
  return frame;
}

std::uint32_t counted(const UpdateCounters& c) {
  return c.decoded + c.ignored + c.not_data + c.other_channel + c.other_source + c.bad_length +
         c.type_mismatch + c.out_of_range + c.not_finite + c.bad_parity + c.no_computed_data +
         c.functional_test + c.failure_warning + c.suspect + c.unpaired_words + c.implausible +
         c.out_of_order + c.from_future + c.duplicated + c.replayed;
}

class AnyProtocol : public ::testing::TestWithParam<BusProtocol> {};

TEST_P(AnyProtocol, random_frames_never_give_a_value_out_of_range) {
  const BusProfile profile = profile_of(GetParam());
  Random random(20231114);
  DecoderMemory memory;
  std::array<int, bus_parameter_count> values{};
  for (std::int64_t step = 0; step < 400'000; ++step) {
    const BusFrame frame = random_frame(random, testing::start_ns + step * 100'000);
    const std::optional<FrameTopic> topic = frame_topic(frame, profile);
    const DecodeStep decoded = decoded_frame(memory, frame, profile);
    memory = decoded.memory;
    if (!decoded.value) continue;
    ASSERT_EQ(decoded.fault, Fault::none);
    ASSERT_TRUE(topic);
    ASSERT_EQ(topic->parameter, decoded.value->parameter);
    ASSERT_EQ(topic->source, decoded.value->source);
    const BusQuantity& quantity = icd_row(decoded.value->parameter).quantity;
    ASSERT_TRUE(std::isfinite(decoded.value->value));
    ASSERT_GE(decoded.value->value, quantity.minimum);
    ASSERT_LE(decoded.value->value, quantity.maximum);
    ASSERT_EQ(decoded.value->time_ns, frame.time_ns);
    ++values[static_cast<std::size_t>(decoded.value->parameter)];
  }
  int parameters = 0;
  for (const int count : values) parameters += count > 0 ? 1 : 0;
  EXPECT_GE(parameters, 12) << "the frames must reach the tables, else nothing was shown";
}

TEST_P(AnyProtocol, random_frames_leave_a_state_whose_values_are_in_range) {
  Ownship own;
  own.profile = profile_of(GetParam());
  Random random(5);
  std::uint32_t fed = 0;
  for (std::int64_t step = 0; step < 60'000; ++step, ++fed) {
    const std::int64_t jitter_ns = static_cast<std::int64_t>(random() % 60) * 1'000'000;
    own.feed(random_frame(random, testing::start_ns + step * 1'000'000 - jitter_ns));
  }
  for (const BusIcdRow& row : bus_icd) {
    const Sample& sample = own.state[row.parameter];
    if (sample.validity == Validity::missing) continue;
    EXPECT_GE(sample.value, row.quantity.minimum) << row.name;
    EXPECT_LE(sample.value, row.quantity.maximum) << row.name;
  }
  EXPECT_EQ(own.state.counters.frames, fed);
  EXPECT_EQ(counted(own.state.counters), fed) << "each frame under exactly one heading";
}

INSTANTIATE_TEST_SUITE_P(Protocols, AnyProtocol,
                         ::testing::Values(BusProtocol::canaerospace, BusProtocol::arinc429,
                                           BusProtocol::canfix));

TEST(AnyBytes, services_take_any_frame) {
  Random random(99);
  const CanasIdentity self{7, 1, 1};
  int replies = 0, stamps = 0;
  for (int step = 0; step < 200'000; ++step) {
    BusFrame frame = random_frame(random, 0);
    if (random() % 2 == 0) {
      frame.id = 128 + random() % 4;
      frame.extended = false;
      frame.data[0] = random.below(9);
      frame.data[1] = random.below(5);
      frame.data[2] = random.below(2);
    }
    replies += ids_reply(frame, self) ? 1 : 0;
    stamps += nss_time_stamp(frame).ok() ? 1 : 0;
  }
  EXPECT_GT(replies, 0);
  EXPECT_GT(stamps, 0);
}

/// A moment of a flight over 46 N, south and west of zero on request.
struct Moment {
  double latitude_deg, longitude_deg, height_m, speed_mps, track_deg, climb_mps, roll_deg,
      pitch_deg, heading_deg;
};

Moment moment(int step, double sign) {
  const double t = step * 0.1;
  return {sign * (46.5 + 0.0005 * t),
          sign * (8.0 + 0.0007 * t),
          3000.0 + 2.0 * t,
          77.2,  // the speed and track of these steps: what contradicts them is refused
          sign > 0.0 ? 43.94 : 223.94,
          2.0,
          15.0 * std::sin(t),
          3.0,
          std::remainder(44.0 + t, 360.0)};
}

std::vector<BusFrame> canas_frames(const Moment& m, double t) {
  using testing::float_of, testing::long_of;
  return {long_of(P::gps_latitude, m.latitude_deg, t),
          long_of(P::gps_longitude, m.longitude_deg, t),
          float_of(P::gps_height, m.height_m, t),
          float_of(P::gps_ground_speed, m.speed_mps, t),
          float_of(P::gps_true_track, m.track_deg, t),
          float_of(P::altitude_rate, m.climb_mps, t),
          float_of(P::roll, m.roll_deg, t),
          float_of(P::pitch, m.pitch_deg, t),
          float_of(P::true_heading, m.heading_deg, t)};
}

std::vector<BusFrame> arinc429_frames(const Moment& m, double t) {
  using testing::bnr_word, testing::word_frame;
  const auto lat = testing::position_words(0110, 0120, m.latitude_deg);
  const auto lon = testing::position_words(0111, 0121, m.longitude_deg);
  const double knots = m.speed_mps * 3600.0 / 1852.0, feet = m.height_m / 0.3048;
  return {word_frame(1, lat.coarse, t),
          word_frame(1, lon.coarse, t),
          word_frame(1, lat.fine, t),
          word_frame(1, lon.fine, t),
          word_frame(1, testing::bnr20_word(0370, feet, 131072.0), t),
          word_frame(1, bnr_word(0112, knots, 4096.0), t),
          word_frame(1, bnr_word(0103, std::remainder(m.track_deg, 360.0), 180.0), t),
          word_frame(1, bnr_word(0165, m.climb_mps / 0.3048 * 60.0, 32768.0), t),
          word_frame(0, bnr_word(0325, m.roll_deg, 180.0), t),
          word_frame(0, bnr_word(0324, m.pitch_deg, 180.0), t),
          word_frame(0, bnr_word(0314, m.heading_deg, 180.0), t)};
}

std::vector<BusFrame> canfix_frames(const Moment& m, double t) {
  const auto steps = [t](std::uint32_t id, double value) {
    const CanfixRow& row = *canfix_row(id);
    return testing::canfix_steps(row, std::llround(value / row.unit_per_step), t);
  };
  const auto degrees = [t](std::uint32_t id, double value) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
    return testing::canfix_frame(id, {bits & 0xff, bits >> 8 & 0xff, bits >> 16 & 0xff, bits >> 24},
                                 t);
  };
  const double variation_deg = 2.0;
  const double magnetic_deg = std::fmod(m.heading_deg - variation_deg + 720.0, 360.0);
  return {degrees(451, m.latitude_deg), degrees(452, m.longitude_deg), steps(1034, m.height_m),
          steps(453, m.speed_mps),      steps(454, m.track_deg),       steps(390, m.climb_mps),
          steps(385, m.roll_deg),       steps(384, m.pitch_deg),       steps(389, magnetic_deg)};
}

TEST(OneFlight, told_in_three_protocols_is_one_ownship_within_their_resolutions) {
  struct Within {
    double position_deg, height_m, angle_deg, heading_deg;
  };
  for (const double sign : {1.0, -1.0}) {
    Ownship canas, arinc429, canfix;
    canas.profile = profile_of(BusProtocol::canaerospace);
    arinc429.profile = profile_of(BusProtocol::arinc429);
    canfix.profile = profile_of(BusProtocol::canfix);
    for (int step = 0; step < 600; ++step) {
      const Moment m = moment(step, sign);
      const double t = step * 100.0;
      canas.feed(canas_frames(m, t), t);
      arinc429.feed(arinc429_frames(m, t), t);
      canfix.feed(canfix_frames(m, t), t);
      const OwnshipPose truth = canas.pose(t + 40.0);
      const auto expect_near = [&](const OwnshipPose& pose, const Within& within) {
        ASSERT_EQ(pose.latitude_deg.validity, Validity::valid) << step;
        ASSERT_EQ(pose.heading_deg.validity, Validity::valid) << step;
        EXPECT_NEAR(pose.latitude_deg.value, truth.latitude_deg.value, within.position_deg);
        EXPECT_NEAR(pose.longitude_deg.value, truth.longitude_deg.value, within.position_deg);
        EXPECT_NEAR(pose.height_m.value, truth.height_m.value, within.height_m);
        EXPECT_NEAR(pose.roll_deg.value, truth.roll_deg.value, within.angle_deg);
        EXPECT_NEAR(pose.pitch_deg.value, truth.pitch_deg.value, within.angle_deg);
        EXPECT_NEAR(std::remainder(pose.heading_deg.value - truth.heading_deg.value, 360.0), 0.0,
                    within.heading_deg);
      };
      expect_near(arinc429.pose(t + 40.0), {2e-7, 0.03, 0.0055, 0.0055});
      expect_near(canfix.pose(t + 40.0), {3e-6, 0.16, 0.0051, 0.0502});
    }
    EXPECT_EQ(counted(arinc429.state.counters), arinc429.state.counters.decoded);
    EXPECT_EQ(counted(canfix.state.counters), canfix.state.counters.decoded);
  }
}

TEST(OneFlight, read_by_another_protocol_gives_no_position_and_no_attitude) {
  const auto has_any = [](const Ownship& own) {
    for (const P p : {P::gps_latitude, P::gps_longitude, P::roll, P::pitch, P::true_heading}) {
      if (own.state[p].validity != Validity::missing) return true;
    }
    return false;
  };
  const BusProtocol all[] = {BusProtocol::canaerospace, BusProtocol::arinc429, BusProtocol::canfix};
  for (const BusProtocol spoken : all) {
    for (const BusProtocol configured : all) {
      Ownship own;
      own.profile = profile_of(configured);
      own.profile.header_rule = HeaderRule::strict;
      for (int step = 0; step < 50; ++step) {
        const Moment m = moment(step, 1.0);
        const double t = step * 100.0;
        own.feed(spoken == BusProtocol::canaerospace ? canas_frames(m, t)
                 : spoken == BusProtocol::arinc429   ? arinc429_frames(m, t)
                                                     : canfix_frames(m, t),
                 t);
      }
      EXPECT_EQ(has_any(own), spoken == configured)
          << static_cast<int>(spoken) << " read as " << static_cast<int>(configured);
    }
  }
}

}  // namespace
}  // namespace ridgeline
