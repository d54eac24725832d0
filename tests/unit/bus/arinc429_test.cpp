// Words in CAN frames: ports, equipment, SDI, status, and GNSS positions of two words.
#include "core/bus/arinc429.hpp"

#include <gtest/gtest.h>

#include "tests/unit/bus/other_frames.hpp"
#include "tests/unit/state/ownship_fixture.hpp"

namespace ridgeline {
namespace {

using P = BusParameter;
using testing::bnr20_word;
using testing::bnr_word;
using testing::Ownship;
using testing::position_words;
using testing::word_frame;
using testing::word_of;

/// Port 0: an inertial system, 1: a GNSS receiver, 2: an air data computer, 3: another receiver.
BusProfile profile() {
  BusProfile made;
  made.protocol = BusProtocol::arinc429;
  made.arinc429.ports[0].equipment = 0x004;
  made.arinc429.ports[1].equipment = 0x00b;
  made.arinc429.ports[2].equipment = 0x006;
  made.arinc429.ports[3].equipment = 0x00b;
  return made;
}

Ownship ownship() {
  Ownship own;
  own.profile = profile();
  return own;
}

DecodeStep decoded(const BusFrame& frame) {
  return decoded_frame({}, frame, profile());
}

Fault fault_of(const BusFrame& frame) {
  const DecodeStep step = decoded(frame);
  EXPECT_FALSE(step.value.has_value());
  return step.fault;
}

TEST(Arinc429, a_label_means_what_the_equipment_of_the_port_says) {
  const std::uint32_t height = bnr20_word(0370, 1500.0, 131072.0);
  EXPECT_EQ(fault_of(word_frame(0, height)), Fault::bus_id_unknown);  // 004: the load factor
  const DecodeStep step = decoded(word_frame(1, height));
  ASSERT_TRUE(step.value);
  EXPECT_EQ(step.value->parameter, P::gps_height);
  EXPECT_DOUBLE_EQ(step.value->value, 1500.0 * 0.3048);
  EXPECT_EQ(fault_of(word_frame(4, height)), Fault::bus_id_unknown);  // nothing connected
}

TEST(Arinc429, every_single_word_of_the_table_comes_back_in_its_unit) {
  for (const Arinc429Row& row : arinc429_icd) {
    if (row.form != Arinc429Form::bnr) continue;
    BusProfile connected = profile();
    connected.arinc429.ports[0].equipment = row.equipment[0];
    const double step = row.range * std::ldexp(1.0, -row.significant_bits);
    const BusQuantity& quantity = icd_row(row.parameter).quantity;
    for (const double code : {0.0, 1.0, 7.0, 31.0, -1.0, -32.0}) {
      const double value = code * step * row.unit_factor;
      const DecodeStep taken =
          decoded_frame({}, word_frame(0, bnr_word(row.label, code * step, row.range)), connected);
      if (value < quantity.minimum) {
        EXPECT_EQ(taken.fault, Fault::bus_value_out_of_range) << std::oct << row.label;
        continue;
      }
      ASSERT_TRUE(taken.value) << std::oct << row.label;
      EXPECT_EQ(taken.value->parameter, row.parameter);
      EXPECT_DOUBLE_EQ(taken.value->value, value) << std::oct << row.label;
    }
  }
}

TEST(Arinc429, values_beyond_the_range_of_the_parameter_are_refused) {
  // 4095 kt of ground speed, 131071 ft of height, 100 degrees of latitude: codes that words can
  // hold.
  EXPECT_EQ(fault_of(word_frame(0, bnr_word(0312, 4095.0, 4096.0))), Fault::bus_value_out_of_range);
  EXPECT_EQ(fault_of(word_frame(1, bnr20_word(0370, 131071.0, 131072.0))),
            Fault::bus_value_out_of_range);
  EXPECT_EQ(fault_of(word_frame(0, bnr20_word(0310, 100.0, 180.0))), Fault::bus_value_out_of_range);
  EXPECT_EQ(fault_of(word_frame(0, bnr_word(0324, -120.0, 180.0))), Fault::bus_value_out_of_range);
}

TEST(Arinc429, every_status_but_normal_is_a_fault_and_never_a_value) {
  for (const auto& [label, port] : {std::pair{0324U, 0U}, {0310U, 0U}, {0150U, 1U}, {0110U, 1U}}) {
    EXPECT_EQ(fault_of(word_frame(port, word_of(label, 0, 0))), Fault::bus_failure_warning);
    EXPECT_EQ(fault_of(word_frame(port, word_of(label, 0, 1))), Fault::bus_no_computed_data);
    EXPECT_EQ(fault_of(word_frame(port, word_of(label, 0x20000, 2))), Fault::bus_functional_test);
  }
  const std::uint32_t date = 0x02510U << 2;  // BCD 01-02-510: first of February
  EXPECT_TRUE(decoded(word_frame(1, word_of(0260, (1U << 13 | 2U << 8 | 0x24U) << 2, 0))).value);
  EXPECT_EQ(fault_of(word_frame(1, word_of(0260, date, 1))), Fault::bus_no_computed_data);
  EXPECT_EQ(fault_of(word_frame(1, word_of(0260, date, 2))), Fault::bus_functional_test);
  EXPECT_EQ(fault_of(word_frame(1, word_of(0260, date, 3))), Fault::bus_value_out_of_range);
}

TEST(Arinc429, a_bcd_position_is_too_coarse_and_refused_by_name) {
  EXPECT_EQ(fault_of(word_frame(0, 0x87559910)), Fault::bus_resolution);
  EXPECT_EQ(fault_of(word_frame(0, 0x76925890)), Fault::bus_resolution);
}

TEST(Arinc429, frames_of_another_form_are_faults) {
  const BusFrame good = word_frame(0, 0x7f1c802b);
  ASSERT_TRUE(decoded(good).value);
  for (int length = 0; length <= 64; ++length) {
    BusFrame frame = good;
    frame.length = static_cast<std::uint8_t>(length);
    if (length != 4) {
      EXPECT_EQ(fault_of(frame), Fault::bus_length);
    }
  }
  BusFrame frame = good;
  frame.extended = false;
  EXPECT_EQ(fault_of(frame), Fault::bus_id_unknown);
  frame = good;
  frame.id += arinc429_port_count;
  EXPECT_EQ(fault_of(frame), Fault::bus_id_unknown);
  frame.id = arinc429_default_id_base - 1;
  EXPECT_EQ(fault_of(frame), Fault::bus_id_unknown);
  frame = good;
  frame.remote = true;
  EXPECT_EQ(fault_of(frame), Fault::bus_not_data);
  frame = good;
  frame.error = true;
  EXPECT_EQ(fault_of(frame), Fault::bus_not_data);
  frame = good;
  frame.fd = true;
  EXPECT_EQ(fault_of(frame), Fault::bus_not_classic);
  EXPECT_EQ(fault_of(word_frame(0, 0xff1c802b)), Fault::bus_parity);
}

TEST(Arinc429, another_sdi_is_another_source_or_not_read_at_all) {
  const BusFrame left = word_frame(0, bnr_word(0324, 5.0, 180.0, 3, 1));
  EXPECT_EQ(decoded(left).value->source.node_id, 1);
  EXPECT_EQ(decoded(left).value->source.channel, 0);
  BusProfile one = profile();
  one.arinc429.ports[0].sdi = 2;
  EXPECT_EQ(decoded_frame({}, left, one).fault, Fault::bus_id_unknown);
  one.arinc429.ports[0].sdi = 1;
  EXPECT_TRUE(decoded_frame({}, left, one).value);
  // In words of 20 bits the same two bits are data.
  EXPECT_TRUE(decoded_frame({}, word_frame(0, bnr20_word(0310, 46.5, 180.0)), one).value);
}

TEST(Arinc429, coarse_and_fine_make_a_position_to_a_centimetre_in_all_quadrants) {
  for (const double latitude_deg : {46.5, -46.5, 0.00001, -0.00001, 89.9999999, -89.9999999}) {
    for (const double longitude_deg : {7.985432, -7.985432, 179.9999999, -180.0}) {
      Ownship own = ownship();
      const auto lat = position_words(0110, 0120, latitude_deg);
      const auto lon = position_words(0111, 0121, longitude_deg);
      own.feed({word_frame(1, lat.coarse, 0.0), word_frame(1, lon.coarse, 0.4),
                word_frame(1, lat.fine, 0.8), word_frame(1, lon.fine, 1.2)},
               2.0);
      ASSERT_EQ(own.state[P::gps_latitude].validity, Validity::valid);
      EXPECT_NEAR(own.state[P::gps_latitude].value, latitude_deg, 4.2e-8);
      EXPECT_NEAR(own.state[P::gps_longitude].value, longitude_deg, 4.2e-8);
      EXPECT_EQ(own.state.counters.unpaired_halves, 0U);
    }
  }
}

TEST(Arinc429, the_fine_word_is_added_or_subtracted_as_configured) {
  const auto south = position_words(0110, 0120, -46.50001);
  const double coarse_deg = bnr20_value(south.coarse, 180.0);
  const double fine_deg = bnr_fine_units(south.fine).value() * 180.0 / 2147483648.0;
  ASSERT_GT(fine_deg, 1e-6);
  const auto value = [&](FineRule rule) {
    BusProfile ruled = profile();
    ruled.arinc429.fine_rule = rule;
    const DecodeStep first = decoded_frame({}, word_frame(1, south.coarse, 0.0), ruled);
    if (rule == FineRule::coarse_alone) return first.value->value;
    EXPECT_FALSE(first.value);
    EXPECT_EQ(first.fault, Fault::none);
    return decoded_frame(first.memory, word_frame(1, south.fine, 1.0), ruled).value->value;
  };
  EXPECT_DOUBLE_EQ(value(FineRule::always_add), coarse_deg + fine_deg);
  EXPECT_DOUBLE_EQ(value(FineRule::by_coarse_sign), coarse_deg - fine_deg);
  EXPECT_DOUBLE_EQ(value(FineRule::coarse_alone), coarse_deg);
  EXPECT_EQ(BusProfile{}.arinc429.fine_rule, FineRule::always_add);
}

TEST(Arinc429, a_coarse_word_alone_is_no_position) {
  Ownship own = ownship();
  for (int step = 0; step < 20; ++step) {
    const auto lat = position_words(0110, 0120, 46.5);
    const auto lon = position_words(0111, 0121, 8.0);
    own.feed({word_frame(1, lat.coarse, step * 200.0), word_frame(1, lon.coarse, step * 200.0)},
             step * 200.0);
  }
  EXPECT_EQ(own.state[P::gps_latitude].validity, Validity::missing);
  EXPECT_EQ(own.state.counters.decoded, 40U);
  EXPECT_EQ(own.state.counters.unpaired_halves, 38U);
}

TEST(Arinc429, a_fine_word_after_two_different_coarse_words_is_refused) {
  const auto first = position_words(0110, 0120, 46.5);
  const auto second = position_words(0110, 0120, 46.5003);
  DecodeStep step = decoded_frame({}, word_frame(1, first.coarse, 0.0), profile());
  step = decoded_frame(step.memory, word_frame(1, second.coarse, 10.0), profile());
  EXPECT_TRUE(step.unpaired);
  step = decoded_frame(step.memory, word_frame(1, second.fine, 11.0), profile());
  EXPECT_EQ(step.fault, Fault::bus_unpaired);
  EXPECT_TRUE(step.unpaired);
  // The same coarse word twice says nothing new, and the next burst is whole again.
  step = decoded_frame(step.memory, word_frame(1, second.coarse, 200.0), profile());
  step = decoded_frame(step.memory, word_frame(1, second.coarse, 201.0), profile());
  step = decoded_frame(step.memory, word_frame(1, second.fine, 202.0), profile());
  ASSERT_TRUE(step.value);
  EXPECT_NEAR(step.value->value, 46.5003, 4.2e-8);
}

TEST(Arinc429, a_fine_word_is_used_once_and_only_in_time) {
  const auto words = position_words(0110, 0120, 46.5);
  const BusFrame fine = word_frame(1, words.fine, 50.0);
  EXPECT_EQ(fault_of(fine), Fault::bus_unpaired);
  const DecodeStep coarse = decoded_frame({}, word_frame(1, words.coarse, 0.0), profile());
  const DecodeStep in_time = decoded_frame(coarse.memory, fine, profile());
  ASSERT_TRUE(in_time.value);
  EXPECT_EQ(decoded_frame(in_time.memory, fine, profile()).fault, Fault::bus_unpaired);
  const BusFrame late = word_frame(1, words.fine, 50.001);
  EXPECT_EQ(decoded_frame(coarse.memory, late, profile()).fault, Fault::bus_unpaired);
  const BusFrame early = word_frame(1, words.fine, -1.0);
  EXPECT_EQ(decoded_frame(coarse.memory, early, profile()).fault, Fault::bus_unpaired);
  // After a burst that lost its fine word the old coarse word is long over: no ambiguity.
  const auto next = position_words(0110, 0120, 46.6);
  DecodeStep step = decoded_frame(coarse.memory, word_frame(1, next.coarse, 200.0), profile());
  step = decoded_frame(step.memory, word_frame(1, next.fine, 201.0), profile());
  ASSERT_TRUE(step.value);
  EXPECT_NEAR(step.value->value, 46.6, 4.2e-8);
}

TEST(Arinc429, two_receivers_in_step_do_not_starve_each_other) {
  Ownship own = ownship();
  const auto lat = position_words(0110, 0120, 46.5), lon = position_words(0111, 0121, 8.0);
  for (int burst = 0; burst < 10; ++burst) {
    const double t = burst * 200.0;
    own.feed({word_frame(1, lat.coarse, t), word_frame(3, lat.coarse, t + 0.1),
              word_frame(1, lon.coarse, t + 0.4), word_frame(3, lon.coarse, t + 0.5),
              word_frame(1, lat.fine, t + 0.8), word_frame(3, lat.fine, t + 0.9),
              word_frame(1, lon.fine, t + 1.2), word_frame(3, lon.fine, t + 1.3)},
             t + 2.0);
    ASSERT_EQ(own.state[P::gps_latitude].validity, Validity::valid) << burst;
    EXPECT_EQ(own.state[P::gps_latitude].source.channel, 1);
    EXPECT_EQ(own.state[P::gps_latitude].time_ns, testing::at_ms(t + 0.8));
  }
}

TEST(Arinc429, what_the_sender_disowns_makes_the_parameter_invalid_at_once) {
  for (const unsigned ssm : {0U, 1U, 2U}) {
    Ownship own = ownship();
    own.feed(word_frame(0, bnr_word(0324, 5.0, 180.0), 0.0));
    EXPECT_EQ(own.validity(P::pitch, 1.0), Validity::valid);
    own.feed(word_frame(0, bnr_word(0324, 22.5, 180.0, ssm), 20.0));
    EXPECT_EQ(own.validity(P::pitch, 21.0), Validity::invalid);
    EXPECT_NEAR(own.state[P::pitch].value, 5.0, 0.003) << "the last good one, with its age";
    own.feed(word_frame(0, bnr_word(0324, 5.0, 180.0), 40.0));
    EXPECT_EQ(own.validity(P::pitch, 41.0), Validity::valid);
  }
  Ownship own = ownship();
  own.feed(word_frame(0, bnr_word(0324, 5.0, 180.0), 0.0));
  own.feed(word_frame(0, bnr_word(0324, 6.0, 180.0) ^ 1U << 20, 20.0));
  EXPECT_EQ(own.validity(P::pitch, 21.0), Validity::valid) << "a damaged word says nothing";
  EXPECT_EQ(own.state.counters.bad_parity, 1U);
}

TEST(Arinc429, counters_name_what_was_wrong) {
  Ownship own = ownship();
  own.feed(word_frame(0, word_of(0324, 0, 0), 0.0));
  own.feed(word_frame(0, word_of(0324, 0, 1), 1.0));
  own.feed(word_frame(0, word_of(0324, 0, 2), 2.0));
  own.feed(word_frame(0, word_of(0324, 0, 3) ^ 1U, 3.0));
  own.feed(word_frame(1, word_of(0260, 0xfU << 2, 0), 4.0));
  own.feed(word_frame(1, word_of(0120, 0, 3), 5.0));
  own.feed(word_frame(0, 0x87559910, 6.0));
  own.feed(word_frame(0, word_of(0377, 0, 3), 7.0));
  const UpdateCounters& c = own.state.counters;
  EXPECT_EQ(c.failure_warning, 1U);
  EXPECT_EQ(c.no_computed_data, 1U);
  EXPECT_EQ(c.functional_test, 1U);
  EXPECT_EQ(c.bad_parity, 1U);
  EXPECT_EQ(c.suspect, 1U);
  EXPECT_EQ(c.unpaired_words, 1U);
  EXPECT_EQ(c.type_mismatch, 1U);
  EXPECT_EQ(c.ignored, 1U);
  EXPECT_EQ(c.frames, 8U);
  EXPECT_EQ(c.decoded, 0U);
}

}  // namespace
}  // namespace ridgeline
