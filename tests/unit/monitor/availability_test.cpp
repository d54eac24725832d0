#include "core/monitor/availability.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>
#include <vector>

#include "tests/unit/state/ownship_fixture.hpp"

namespace ridgeline {
namespace {

using testing::float_of;
using testing::Ownship;
using P = BusParameter;

Ownship complete(double time_ms) {
  Ownship own;
  own.feed_fix(46.5, 8.0, time_ms);
  own.feed(float_of(P::gps_height, 2000.0, time_ms));
  own.feed(float_of(P::roll, 0.0, time_ms));
  own.feed(float_of(P::pitch, 0.0, time_ms));
  own.feed(float_of(P::true_heading, 0.0, time_ms));
  return own;
}

std::vector<std::string> words(const Ownship& own, double now_ms) {
  const Availability result =
      availability(own.state, testing::at_ms(now_ms), state_limits(own.profile));
  std::vector<std::string> list;
  for (const Reason reason : result.reasons) list.emplace_back(reason_word(reason));
  EXPECT_EQ(result.mode == Mode::svs, list.empty());
  return list;
}

using Words = std::vector<std::string>;

TEST(Availability, complete_fresh_data_is_svs) {
  EXPECT_EQ(words(complete(0), 100), Words{});
}

TEST(Availability, an_empty_bus_removes_and_names_everything_missing) {
  EXPECT_EQ(words(Ownship(), 0),
            (Words{"attitude_missing", "heading_missing", "position_missing", "height_missing"}));
}

TEST(Availability, limits_are_300_ms_for_attitude_and_heading_and_2_s_for_position) {
  const Ownship own = complete(0);
  EXPECT_EQ(words(own, 299), Words{});
  EXPECT_EQ(words(own, 301), (Words{"attitude_stale", "heading_stale"}));
  EXPECT_EQ(words(own, 2010),
            (Words{"attitude_stale", "heading_stale", "position_stale", "height_stale"}));
}

TEST(Availability, each_stale_value_is_named_alone) {
  const std::vector<std::pair<BusParameter, Words>> cases = {{P::roll, {"attitude_stale"}},
                                                             {P::pitch, {"attitude_stale"}},
                                                             {P::true_heading, {"heading_stale"}},
                                                             {P::gps_latitude, {"position_stale"}},
                                                             {P::gps_height, {"height_stale"}}};
  for (const auto& [silent, expected] : cases) {
    Ownship own = complete(0);
    for (double t = 50; t <= 2500; t += 50) {
      for (const P parameter : {P::roll, P::pitch, P::true_heading, P::gps_height}) {
        if (parameter != silent)
          own.feed(float_of(parameter, 100.0 * (parameter == P::gps_height) * 20, t));
      }
      if (silent != P::gps_latitude) own.feed_fix(46.5, 8.0, t);
    }
    EXPECT_EQ(words(own, 2510), expected) << icd_row(silent).name;
  }
}

TEST(Availability, implausible_and_invalid_values_remove) {
  Ownship own = complete(0);
  own.feed(float_of(P::roll, 120.0, 10));
  EXPECT_EQ(words(own, 11), Words{"attitude_implausible"});
  own.feed(float_of(P::true_heading, std::numeric_limits<double>::quiet_NaN(), 12));
  own.feed_fix(47.5, 8.0, 20);
  own.feed(float_of(P::gps_height, 29000.0, 22));
  EXPECT_EQ(words(own, 23), (Words{"attitude_implausible", "heading_invalid",
                                   "position_implausible", "height_implausible"}));
}

TEST(Availability, unknown_heading_reference_removes) {
  Ownship own = complete(0);
  own.state.samples[static_cast<std::size_t>(P::true_heading)] = Sample{};
  own.feed(float_of(P::heading, 10.0, 5));
  EXPECT_EQ(words(own, 10), Words{"heading_reference_unknown"});
}

TEST(Availability, airspeed_rates_and_clock_are_not_needed) {
  Ownship own = complete(0);
  own.feed(float_of(P::true_airspeed, 50.0, 0));
  own.feed(float_of(P::true_airspeed, std::numeric_limits<double>::quiet_NaN(), 1));
  EXPECT_EQ(words(own, 100), Words{});
}

TEST(Availability, reasons_are_kept_once_and_the_worst_decides_the_mode) {
  Availability result;
  add_reason(result, Reason::bound_exceeded);
  EXPECT_EQ(result.mode, Mode::degraded);
  add_reason(result, Reason::no_bound);
  EXPECT_EQ(result.mode, Mode::removed);
  add_reason(result, Reason::tile_refused);
  add_reason(result, Reason::bound_exceeded);
  EXPECT_EQ(result.mode, Mode::removed);
  EXPECT_EQ(result.reasons.size(), 3U);
}

TEST(Availability, every_reason_has_its_own_word_and_a_text_and_all_fit) {
  std::set<std::string> seen;
  Availability all;
  for (std::size_t index = 0; index < reason_count; ++index) {
    const auto reason = static_cast<Reason>(index);
    const std::string word(reason_word(reason));
    EXPECT_TRUE(seen.insert(word).second) << word;
    EXPECT_EQ(word.find(' '), std::string::npos);
    EXPECT_FALSE(reason_text(reason).empty()) << word;
    add_reason(all, reason);
  }
  EXPECT_EQ(all.reasons.size(), reason_count);
  EXPECT_EQ(all.reasons.refused_count(), 0U);
  EXPECT_EQ(mode_word(all.mode), "removed");
}

}  // namespace
}  // namespace ridgeline
