// The flips of a graphics card, told by a pipe in its place.
#include "platform/flip_events.hpp"

#include <drm.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <thread>

#include "platform/screen_output.hpp"

namespace ridgeline {
namespace {

constexpr std::int64_t short_ns = 20'000'000;

class Card {
 public:
  Card() { EXPECT_EQ(::pipe(ends_.data()), 0); }
  ~Card() {
    ::close(ends_[0]);
    unplug();
  }
  void tell(const void* event, std::size_t bytes) const {
    EXPECT_EQ(::write(ends_[1], event, bytes), static_cast<ssize_t>(bytes));
  }
  void unplug() {
    if (ends_[1] >= 0) ::close(ends_[1]);
    ends_[1] = -1;
  }
  [[nodiscard]] int file() const { return ends_[0]; }

 private:
  std::array<int, 2> ends_{-1, -1};
};

drm_event_vblank flip(std::uint64_t picture) {
  drm_event_vblank event{};
  event.base = {DRM_EVENT_FLIP_COMPLETE, sizeof event};
  event.user_data = picture;
  event.tv_sec = 3;
  event.tv_usec = 250'000;
  event.sequence = 77;
  return event;
}

TEST(FlipEvents, a_flip_is_told_with_its_picture_time_and_blank) {
  const Card card;
  const auto told = flip(0x1'0000'0002);
  card.tell(&told, sizeof told);
  FlipEvents events(card.file());
  const auto next = events.next(short_ns);
  ASSERT_TRUE(next);
  EXPECT_EQ(next.value().picture, 0x1'0000'0002U);
  EXPECT_EQ(next.value().time_ns, 3'250'000'000);
  EXPECT_EQ(next.value().vertical_blank, 77U);
}

TEST(FlipEvents, a_flip_that_never_comes_is_late_after_the_limit) {
  const Card card;
  FlipEvents events(card.file());
  const std::int64_t begin_ns = screen_time_ns();
  EXPECT_EQ(events.next(short_ns).fault(), Fault::screen_flip_late);
  EXPECT_GE(screen_time_ns() - begin_ns, short_ns);
  EXPECT_EQ(events.next(0).fault(), Fault::screen_flip_late);
}

TEST(FlipEvents, a_flip_that_comes_while_waited_for_is_taken) {
  const Card card;
  FlipEvents events(card.file());
  std::jthread later([&] {
    ::usleep(5000);
    const auto told = flip(9);
    card.tell(&told, sizeof told);
  });
  const auto next = events.next(10'000'000'000);
  ASSERT_TRUE(next);
  EXPECT_EQ(next.value().picture, 9U);
}

TEST(FlipEvents, several_at_once_come_in_order_and_others_are_passed_over) {
  const Card card;
  std::array<drm_event_vblank, 3> told{flip(1), flip(2), flip(3)};
  told[1].base.type = DRM_EVENT_VBLANK;
  card.tell(told.data(), sizeof told);
  FlipEvents events(card.file());
  EXPECT_EQ(events.next(short_ns).value().picture, 1U);
  EXPECT_EQ(events.next(short_ns).value().picture, 3U);
  EXPECT_EQ(events.next(0).fault(), Fault::screen_flip_late);
}

TEST(FlipEvents, a_card_that_is_gone_or_tells_nonsense_is_lost) {
  Card card;
  FlipEvents events(card.file());
  for (const std::uint32_t length : {0U, 7U, 4096U}) {
    auto told = flip(1);
    told.base.length = length;
    card.tell(&told, sizeof told);
    EXPECT_EQ(events.next(short_ns).fault(), Fault::screen_lost) << length;
    events = FlipEvents(card.file());
  }
  card.unplug();
  EXPECT_EQ(events.next(short_ns).fault(), Fault::screen_lost);
  EXPECT_EQ(FlipEvents(-1).next(short_ns).fault(), Fault::screen_flip_late);  // no card, no flip
}

}  // namespace
}  // namespace ridgeline
