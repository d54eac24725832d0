// One word: golden vectors, parity, labels, SSM by form, boundary values of every field.
#include "core/bus/arinc429_word.hpp"

#include <gtest/gtest.h>

#include "tests/unit/bus/other_frames.hpp"

namespace ridgeline {
namespace {

using testing::word_of;
using Form = Arinc429Form;
using Status = Arinc429Status;

Arinc429Word word(std::uint32_t bits) {
  const Result<Arinc429Word> taken = arinc429_word(bits, LabelOrder::as_sent);
  EXPECT_TRUE(taken.ok()) << std::hex << bits;
  return taken.ok() ? taken.value() : Arinc429Word{};
}

struct Golden {
  std::uint32_t bits;
  unsigned label;
  double range;
  int significant_bits;  // 20: a word of 20 bits
  double value, within;
};

class GoldenBnr : public ::testing::TestWithParam<Golden> {};

TEST_P(GoldenBnr, decodes_to_what_the_examples_say) {
  const Golden& golden = GetParam();
  EXPECT_EQ(word(golden.bits).label, golden.label);
  EXPECT_EQ(word(golden.bits).ssm, 3);
  const double value = golden.significant_bits == 20
                           ? bnr20_value(golden.bits, golden.range)
                           : bnr_value(golden.bits, golden.range,
                                       static_cast<std::uint8_t>(golden.significant_bits));
  EXPECT_NEAR(value, golden.value, golden.within);
}

INSTANTIATE_TEST_SUITE_P(
    Words, GoldenBnr,
    ::testing::Values(Golden{0xe73ea813, 0310, 180.0, 20, 81.50344848632812, 0.0},
                      Golden{0xe73e9413, 0310, 180.0, 20, 81.5, 0.0001},
                      Golden{0x7716c093, 0311, 180.0, 20, -100.250244140625, 0.0},
                      Golden{0xf716c193, 0311, 180.0, 20, -100.25, 0.0001},
                      Golden{0xe28a0053, 0312, 4096.0, 15, 650.0, 0.0},
                      Golden{0xe57e40c1, 0203, 131072.0, 17, 45000.0, 0.0},
                      Golden{0x64c9002e, 0164, 8192.0, 16, 2450.0, 0.0},
                      Golden{0xe6a40061, 0206, 1024.0, 14, 425.0, 0.0},
                      Golden{0x646a0011, 0210, 2048.0, 15, 565.0, 0.0},
                      Golden{0x788e0051, 0212, 32768.0, 11, -15248.0, 0.0},
                      Golden{0x78720032, 0114, 180.0, 12, -84.990234375, 0.0},
                      Golden{0x6d550082, 0101, 180.0, 12, 149.9853515625, 0.0},
                      Golden{0xe2ab0006, 0140, 180.0, 12, 30.0146484375, 0.0},
                      Golden{0x6a0500cb, 0323, 4.0, 12, 2.5, 0.005},
                      Golden{0x7f1c802b, 0324, 180.0, 14, -10.0, 0.0055},
                      Golden{0xe2aac0ab, 0325, 180.0, 14, 30.0, 0.0055},
                      Golden{0xf871c033, 0314, 180.0, 15, -85.0, 0.0028},
                      Golden{0xe00190a1, 0205, 262144.0, 18, 100.0, 0.0},
                      Golden{0x600c808b, 0321, 16384.0, 18, 50.0, 0.0}));

TEST(Arinc429Word, even_parity_as_printed_in_two_examples_is_refused) {
  for (const std::uint32_t bits : {0x657e40c1U, 0xff1c0086U}) {
    EXPECT_EQ(arinc429_word(bits, LabelOrder::as_sent).fault(), Fault::bus_parity);
    EXPECT_TRUE(arinc429_word(bits ^ 0x80000000U, LabelOrder::as_sent).ok());
  }
  EXPECT_NEAR(bnr_value(0xff1c0086, 180.0, 12), -10.0195, 0.0001);
}

TEST(Arinc429Word, any_single_bit_error_is_noticed) {
  for (int bit = 0; bit < 32; ++bit) {
    EXPECT_EQ(arinc429_word(0xe28a0053U ^ 1U << bit, LabelOrder::as_sent).fault(),
              Fault::bus_parity);
  }
}

TEST(Arinc429Word, every_label_is_read_in_either_order) {
  for (unsigned label = 0; label <= 0377; ++label) {
    const std::uint32_t sent = word_of(label, 0, 0);
    EXPECT_EQ(arinc429_word(sent, LabelOrder::as_sent).value().label, label);
    std::uint32_t turned = (sent & 0x7fffff00U) | label;
    if (std::popcount(turned) % 2 == 0) turned |= 0x80000000U;
    EXPECT_EQ(arinc429_word(turned, LabelOrder::octal_number).value().label, label);
  }
  EXPECT_EQ(word(word_of(0310, 0, 3)).bits & 0xffU, 0x13U);
}

TEST(Arinc429Word, sdi_and_ssm_have_their_bits) {
  for (unsigned sdi = 0; sdi < 4; ++sdi) {
    for (unsigned ssm = 0; ssm < 4; ++ssm) {
      const Arinc429Word taken = word(word_of(0324, 0x155554U | sdi, ssm));
      EXPECT_EQ(taken.sdi, sdi);
      EXPECT_EQ(taken.ssm, ssm);
    }
  }
}

TEST(Arinc429Word, the_ssm_means_what_the_form_says) {
  const auto status = [](Form form) {
    return std::array{arinc429_status(form, 0), arinc429_status(form, 1), arinc429_status(form, 2),
                      arinc429_status(form, 3)};
  };
  const std::array bnr{Status::failure_warning, Status::no_computed_data, Status::functional_test,
                       Status::normal};
  const std::array bcd{Status::normal, Status::no_computed_data, Status::functional_test,
                       Status::minus};
  const std::array discrete{Status::normal, Status::no_computed_data, Status::functional_test,
                            Status::failure_warning};
  for (const Form form : {Form::bnr, Form::bnr20, Form::bnr_fine, Form::utc_word}) {
    EXPECT_EQ(status(form), bnr);
  }
  for (const Form form : {Form::bcd, Form::bcd_position, Form::date_word}) {
    EXPECT_EQ(status(form), bcd);
  }
  EXPECT_EQ(status(Form::discrete), discrete);
  EXPECT_EQ(fault_of_status(Status::normal), Fault::none);
  EXPECT_EQ(fault_of_status(Status::minus), Fault::none);
  EXPECT_EQ(fault_of_status(Status::no_computed_data), Fault::bus_no_computed_data);
  EXPECT_EQ(fault_of_status(Status::functional_test), Fault::bus_functional_test);
  EXPECT_EQ(fault_of_status(Status::failure_warning), Fault::bus_failure_warning);
}

TEST(Arinc429Word, bits_below_the_significant_ones_are_masked) {
  // All 18 data bits set: with n significant ones the largest code has n ones.
  const std::uint32_t ones = word_of(0324, 0xfffffU, 3);
  const std::uint32_t lowest = word_of(0324, 0x100000U, 3);
  for (int bits = 1; bits <= 18; ++bits) {
    const auto count = static_cast<std::uint8_t>(bits);
    EXPECT_EQ(bnr_value(ones, 1.0, count), 1.0 - std::ldexp(1.0, -bits));
    EXPECT_EQ(bnr_value(lowest, 1.0, count), -1.0);
  }
  EXPECT_EQ(bnr20_value(ones, 1.0), 1.0 - std::ldexp(1.0, -20));
  EXPECT_EQ(bnr20_value(lowest, 1.0), -1.0);
  EXPECT_EQ(bnr20_value(word_of(0310, 0x1fffffU, 3), 1.0), -std::ldexp(1.0, -20));
}

TEST(Arinc429Word, bcd_examples_are_exact) {
  EXPECT_EQ(bcd_digits(0x81940050).value() * 0.1, 650.0);
  EXPECT_EQ(word(0x81940050).label, 012);
  EXPECT_DOUBLE_EQ(bcd_digits(0x859540d0).value() * 0.01, 165.5);
  EXPECT_EQ(bcd_digits(0x68800008).value(), 22000U);
  EXPECT_EQ(arinc429_status(Form::bcd, word(0x68800008).ssm), Status::minus);
  EXPECT_EQ(bcd_digits(0xe5494059).value(), 15250U);
  EXPECT_EQ(arinc429_status(Form::bcd, word(0xe5494059).ssm), Status::minus);
  EXPECT_EQ(bcd_digits(0xfe1404a1).value(), 78501U);
  EXPECT_EQ(bcd_position_units(0x87559910).value(), 75U * 600 + 599);
  EXPECT_EQ(arinc429_status(Form::bcd_position, word(0x87559910).ssm), Status::normal);
  EXPECT_EQ(bcd_position_units(0x76925890).value(), 169U * 600 + 258);
  EXPECT_EQ(arinc429_status(Form::bcd_position, word(0x76925890).ssm), Status::minus);
}

TEST(Arinc429Word, no_digit_above_nine_is_read) {
  EXPECT_EQ(bcd_digits(word_of(012, 0x79999U << 2, 0)).value(), 79999U);
  for (int place = 0; place < 4; ++place) {
    for (std::uint32_t digit = 10; digit < 16; ++digit) {
      const std::uint32_t bits = digit << (4 * place);
      EXPECT_EQ(bcd_digits(word_of(012, bits << 2, 0)).fault(), Fault::bus_digit);
      EXPECT_EQ(bcd_position_units(word_of(010, bits, 0)).fault(), Fault::bus_digit);
      EXPECT_EQ(bcd_position_units(word_of(010, bits << 4, 0)).fault(), Fault::bus_digit);
    }
  }
  EXPECT_EQ(bcd_position_units(word_of(010, 0x090599, 0)).value(), 90U * 600 + 599);
  EXPECT_EQ(bcd_position_units(word_of(010, 0x090600, 0)).fault(), Fault::bus_value_out_of_range);
}

TEST(Arinc429Word, fine_words_have_eleven_bits_and_no_sign) {
  EXPECT_EQ(bnr_fine_units(word_of(0120, 0, 3)).value(), 0U);
  EXPECT_EQ(bnr_fine_units(word_of(0120, 0x7ffU << 9, 3)).value(), 2047U);
  EXPECT_EQ(bnr_fine_units(word_of(0120, 1U << 9 | 0x1ffU, 3)).value(), 1U);
  EXPECT_EQ(bnr_fine_units(word_of(0120, 1U << 20, 3)).fault(), Fault::bus_value_out_of_range);
}

std::uint32_t utc_word(unsigned hour, unsigned minute, unsigned second) {
  return word_of(0150, hour << 15 | minute << 9 | second << 3, 3);
}

std::uint32_t date_word(unsigned day, unsigned month, unsigned year) {
  const unsigned bcd = (day / 10) << 17 | (day % 10) << 13 | (month / 10) << 12 |
                       (month % 10) << 8 | (year / 10) << 4 | year % 10;
  return word_of(0260, bcd << 2, 0);
}

TEST(Arinc429Word, utc_is_a_clock) {
  EXPECT_EQ(utc_word_s(utc_word(13, 43, 22)).value(), 13 * 3600 + 43 * 60 + 22);
  EXPECT_EQ(utc_word_s(utc_word(23, 59, 60)).value(), 86400.0);
  EXPECT_EQ(utc_word_s(utc_word(24, 0, 0)).fault(), Fault::bus_value_out_of_range);
  EXPECT_EQ(utc_word_s(utc_word(0, 60, 0)).fault(), Fault::bus_value_out_of_range);
  EXPECT_EQ(utc_word_s(utc_word(0, 0, 61)).fault(), Fault::bus_value_out_of_range);
  EXPECT_EQ(utc_word_s(utc_word(0, 0, 0) ^ 1U << 28).fault(), Fault::bus_value_out_of_range);
}

TEST(Arinc429Word, a_date_has_the_century_of_gnss) {
  EXPECT_EQ(date_word_days(date_word(1, 1, 0)).value(), 10957.0);
  EXPECT_EQ(date_word_days(date_word(12, 6, 87)).value(), 6371.0);
  EXPECT_EQ(date_word_days(date_word(31, 12, 79)).value(), 40176.0);
  EXPECT_EQ(date_word_days(date_word(1, 1, 80)).value(), 3652.0);
  EXPECT_EQ(date_word_days(date_word(0, 1, 20)).fault(), Fault::bus_value_out_of_range);
  EXPECT_EQ(date_word_days(date_word(1, 13, 20)).fault(), Fault::bus_value_out_of_range);
  EXPECT_EQ(date_word_days(date_word(30, 2, 20)).fault(), Fault::bus_value_out_of_range);
  EXPECT_EQ(date_word_days(word_of(0260, 0xfU << 2, 0)).fault(), Fault::bus_digit);
}

}  // namespace
}  // namespace ridgeline
