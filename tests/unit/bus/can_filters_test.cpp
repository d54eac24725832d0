#include "core/bus/can_filters.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/bus/bus_decoder.hpp"

namespace ridgeline {
namespace {

bool passes(const CanFilters& filters, std::uint32_t id, bool extended) {
  return std::any_of(filters.begin(), filters.end(), [&](const CanFilter& filter) {
    return filter.id == id && filter.extended == extended;
  });
}

/// Whether exactly those identifiers of a range pass that have a topic which is read.
void expect_the_table(const BusProfile& profile, std::uint32_t first, bool extended) {
  const CanFilters filters = can_filters(profile).value();
  std::size_t read = 0;
  for (std::uint32_t id = first; id < first + 2048; ++id) {
    BusFrame frame;
    frame.id = id;
    frame.extended = extended;
    frame.length = 8;
    frame.data[1] = profile.protocol == BusProtocol::canfix ? 0 : 2;
    const auto topic = frame_topic(frame, profile);
    const bool is_read = topic && topic->is_read;
    read += is_read ? 1u : 0u;
    const bool is_request = !extended && id == 128 && profile.protocol != BusProtocol::canfix;
    EXPECT_EQ(passes(filters, id, extended), is_read || is_request) << id;
  }
  EXPECT_GT(read, 5u);
}

TEST(CanFilters, follow_the_canaerospace_table_on_the_channels_that_are_read) {
  BusProfile profile;
  expect_the_table(profile, 0, false);
  EXPECT_FALSE(passes(can_filters(profile).value(), 0x10137, true));
  profile.channel_count = 2;
  expect_the_table(profile, 0x10000, true);
}

TEST(CanFilters, follow_the_canfix_table) {
  BusProfile profile;
  profile.protocol = BusProtocol::canfix;
  expect_the_table(profile, 0, false);
}

TEST(CanFilters, let_arinc_429_ports_through_that_are_connected) {
  BusProfile profile;
  profile.protocol = BusProtocol::arinc429;
  EXPECT_TRUE(can_filters(profile).value().empty());
  profile.arinc429.ports[3].equipment = 0x004;
  const CanFilters filters = can_filters(profile).value();
  ASSERT_EQ(filters.size(), 1u);
  EXPECT_TRUE(passes(filters, arinc429_default_id_base + 3, true));
}

TEST(CanFilters, more_identifiers_than_a_socket_takes_are_refused) {
  BusProfile profile;
  profile.channel_count = 100;
  EXPECT_EQ(can_filters(profile).fault(), Fault::capacity_exceeded);
}

}  // namespace
}  // namespace ridgeline
