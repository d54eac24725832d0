#include "platform/flip_events.hpp"

#include <drm.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "platform/screen_output.hpp"

namespace ridgeline {

Result<FlipEvent> FlipEvents::next(std::int64_t timeout_ns) {
  const std::int64_t deadline_ns = screen_time_ns() + timeout_ns;
  for (;;) {
    while (end_ - begin_ >= sizeof(drm_event)) {
      drm_event head{};
      std::memcpy(&head, told_.data() + begin_, sizeof head);
      if (head.length < sizeof head || head.length > end_ - begin_) return Fault::screen_lost;
      drm_event_vblank flip{};
      const bool whole = head.length >= sizeof flip;
      if (whole) std::memcpy(&flip, told_.data() + begin_, sizeof flip);
      begin_ += head.length;
      if (head.type != DRM_EVENT_FLIP_COMPLETE || !whole) continue;
      return FlipEvent{flip.user_data,
                       static_cast<std::int64_t>(flip.tv_sec) * 1'000'000'000 +
                           static_cast<std::int64_t>(flip.tv_usec) * 1000,
                       flip.sequence};
    }
    if (const Status filled = fill(deadline_ns); !filled) return filled.fault();
  }
}

/// The kernel hands out whole events only, so nothing is left over from the last time.
Status FlipEvents::fill(std::int64_t deadline_ns) {
  begin_ = end_ = 0;
  for (;;) {
    const std::int64_t left_ns = std::max<std::int64_t>(deadline_ns - screen_time_ns(), 0);
    pollfd card{card_, POLLIN, 0};
    const timespec left{left_ns / 1'000'000'000, left_ns % 1'000'000'000};
    const int ready = ::ppoll(&card, 1, &left, nullptr);
    if (ready < 0 && errno == EINTR) continue;
    if (ready < 0) return Fault::screen_lost;
    if (ready == 0) return Fault::screen_flip_late;
    if ((card.revents & POLLIN) == 0) return Fault::screen_lost;
    const ssize_t count = ::read(card_, told_.data(), told_.size());
    if (count > 0) {
      end_ = static_cast<std::size_t>(count);
      return {};
    }
    if (count == 0 || (errno != EINTR && errno != EAGAIN)) return Fault::screen_lost;
  }
}

}  // namespace ridgeline
