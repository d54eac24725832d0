#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

#include "config/limits_bus.hpp"
#include "core/base/result.hpp"
#include "core/bus/can_error.hpp"
#include "core/bus/can_filters.hpp"
#include "platform/can_batch.hpp"

namespace ridgeline {

/// What an installer says about one CAN interface.
struct CanSettings {
  std::string_view interface;                    ///< name, 1..15 characters
  std::uint8_t index = 0;                        ///< becomes BusFrame::interface
  CanFilters filters;                            ///< none: nothing but error frames is received
  std::int64_t stall_ns = limits::can_stall_ns;  ///< what the receive buffer must outlast
};

enum class CanLink : std::uint8_t { up, down, absent };

struct CanCounters {
  std::uint64_t receive_overflows = 0;  ///< in the controller, before the kernel saw the frame
  std::uint64_t warnings = 0;
  std::uint64_t passives = 0;
  std::uint64_t bus_offs = 0;
  std::uint64_t restarts = 0;
  std::uint64_t not_acknowledged = 0;
  std::uint64_t link_downs = 0;
  std::uint64_t unplugs = 0;
  std::uint64_t rebinds = 0;  ///< after the interface came back
  std::uint64_t read_faults = 0;
  std::uint64_t send_faults = 0;
};

/// One raw CAN socket that outlives its interface: down and up, unplugged and back.
/// Cost: open() makes everything; after it nothing allocates and nothing blocks.
class CanSocket {
 public:
  /// Domain: an interface of that name, else Fault::can_interface_missing; a kernel with CAN, else
  /// can_unsupported; a receive buffer granted for `stall_ns`, else can_buffer_small. Down is fine.
  [[nodiscard]] static Result<CanSocket> open(const CanSettings& settings);

  /// What waits, error frames included, at most CanBatch::capacity; valid until the next call.
  /// Looks after the link as well. Returns can_link_down, can_unplugged or can_read once, when it
  /// happens.
  [[nodiscard]] Status receive();
  [[nodiscard]] std::span<const ReceivedFrame> frames() const { return batch_.frames(); }

  /// Domain: a classic data frame, else Fault::can_send; also when the kernel cannot take it now.
  [[nodiscard]] Status send(const BusFrame& frame);

  [[nodiscard]] CanLink link() const { return link_; }
  [[nodiscard]] CanController controller() const { return controller_; }
  [[nodiscard]] const CanCounters& counters() const { return counters_; }
  [[nodiscard]] const BatchCounters& received() const { return batch_.counters(); }
  /// Bytes of the receive buffer that the kernel granted, as it counts them.
  [[nodiscard]] std::int64_t buffer_bytes() const { return buffer_bytes_; }
  /// For poll(): readable when receive() has something to say.
  [[nodiscard]] int descriptor() const { return descriptor_.number; }

 private:
  CanSocket() = default;
  Status set_options(std::int64_t stall_ns);
  Status grow_buffer(std::int64_t stall_ns);
  Status bind_interface(int index);
  void count_errors();
  Fault check_link();
  Fault lose(CanLink link);

  /// Closes it; moves leave nothing to close.
  struct Descriptor {
    int number = -1;
    Descriptor() = default;
    Descriptor(Descriptor&& other) noexcept : number(std::exchange(other.number, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
      std::swap(number, other.number);
      return *this;
    }
    ~Descriptor();
  };

  Descriptor descriptor_;
  std::array<char, 16> name_{};
  std::uint8_t index_ = 0;
  int bound_ = 0;  ///< the kernel's number of the interface; a new one each time it is plugged in
  CanFilters filters_;
  CanBatch batch_;
  CanLink link_ = CanLink::absent;
  CanController controller_ = CanController::active;
  CanCounters counters_;
  std::int64_t buffer_bytes_ = 0;
  std::int64_t checked_ns_ = 0;
};

/// Bytes of receive buffer that a stall of this length needs.
[[nodiscard]] std::int64_t can_buffer_bytes(std::int64_t stall_ns);

}  // namespace ridgeline
