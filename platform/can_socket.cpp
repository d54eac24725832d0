#include "platform/can_socket.hpp"

#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace ridgeline {
namespace {

template <typename T>
bool set_option(int descriptor, int level, int name, const T& value) {
  return ::setsockopt(descriptor, level, name, &value, sizeof value) == 0;
}

ifreq request_for(const std::array<char, 16>& name) {
  ifreq request = {};
  std::copy(name.begin(), name.end(), request.ifr_name);
  return request;
}

/// The kernel's number of an interface; 0 where there is none of that name.
int interface_number(int descriptor, const std::array<char, 16>& name) {
  ifreq request = request_for(name);
  return ::ioctl(descriptor, SIOCGIFINDEX, &request) == 0 ? request.ifr_ifindex : 0;
}

bool interface_is_up(int descriptor, const std::array<char, 16>& name) {
  ifreq request = request_for(name);
  return ::ioctl(descriptor, SIOCGIFFLAGS, &request) == 0 && (request.ifr_flags & IFF_UP) != 0;
}

/// Both flags are in the mask: without them an 11-bit filter lets 29-bit and remote frames through.
bool set_filters(int descriptor, const CanFilters& filters) {
  std::array<can_filter, can_filter_capacity> list{};
  for (std::size_t i = 0; i < filters.size(); ++i) {
    const CanFilter& wanted = filters[i];
    const std::uint32_t mask = wanted.extended ? CAN_EFF_MASK : CAN_SFF_MASK;
    list[i].can_id = (wanted.id & mask) | (wanted.extended ? CAN_EFF_FLAG : 0u);
    list[i].can_mask = mask | CAN_EFF_FLAG | CAN_RTR_FLAG;
  }
  const auto size_bytes = static_cast<socklen_t>(filters.size() * sizeof list[0]);
  const can_err_mask_t errors = CAN_ERR_TX_TIMEOUT | CAN_ERR_CRTL | CAN_ERR_TRX | CAN_ERR_ACK |
                                CAN_ERR_BUSOFF | CAN_ERR_RESTARTED;
  return ::setsockopt(descriptor, SOL_CAN_RAW, CAN_RAW_FILTER, list.data(), size_bytes) == 0 &&
         set_option(descriptor, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, errors);
}

}  // namespace

std::int64_t can_buffer_bytes(std::int64_t stall_ns) {
  const std::int64_t frames = stall_ns * limits::can_frames_per_second / limits::second_ns + 1;
  return frames * limits::can_buffer_frame_bytes;
}

CanSocket::Descriptor::~Descriptor() {
  if (number >= 0) ::close(number);
}

Result<CanSocket> CanSocket::open(const CanSettings& settings) {
  CanSocket made;
  if (settings.interface.empty() || settings.interface.size() >= made.name_.size()) {
    return Fault::can_interface_missing;
  }
  std::copy(settings.interface.begin(), settings.interface.end(), made.name_.begin());
  made.index_ = settings.index;
  made.filters_ = settings.filters;
  made.descriptor_.number = ::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, CAN_RAW);
  if (made.descriptor_.number < 0) return Fault::can_unsupported;
  const int number = interface_number(made.descriptor_.number, made.name_);
  if (number == 0) return Fault::can_interface_missing;
  if (const Status status = made.set_options(settings.stall_ns); !status) return status.fault();
  if (const Status status = made.bind_interface(number); !status) return status.fault();
  made.link_ = interface_is_up(made.descriptor_.number, made.name_) ? CanLink::up : CanLink::down;
  made.checked_ns_ = monotonic_now_ns();
  return made;
}

Status CanSocket::set_options(std::int64_t stall_ns) {
  const int on = 1;
  // FD frames are received so that they can be counted; without this they vanish unseen.
  const bool done = set_option(descriptor_.number, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, on) &&
                    set_option(descriptor_.number, SOL_SOCKET, SO_TIMESTAMPNS, on) &&
                    set_option(descriptor_.number, SOL_SOCKET, SO_RXQ_OVFL, on);
  if (!done) return Fault::can_option;
  return grow_buffer(stall_ns);
}

Status CanSocket::grow_buffer(std::int64_t stall_ns) {
  const std::int64_t needed_bytes = can_buffer_bytes(stall_ns);
  constexpr std::int64_t most_bytes = 1 << 30;
  if (needed_bytes > most_bytes) return Fault::can_buffer_small;
  // The kernel doubles what it is asked for, and cuts it without a word: so it is asked again.
  const int wanted = static_cast<int>((needed_bytes + 1) / 2);
  if (!set_option(descriptor_.number, SOL_SOCKET, SO_RCVBUFFORCE, wanted)) {
    if (!set_option(descriptor_.number, SOL_SOCKET, SO_RCVBUF, wanted)) return Fault::can_option;
  }
  int granted = 0;
  socklen_t size_bytes = sizeof granted;
  if (::getsockopt(descriptor_.number, SOL_SOCKET, SO_RCVBUF, &granted, &size_bytes) != 0) {
    return Fault::can_option;
  }
  buffer_bytes_ = granted;
  return granted >= needed_bytes ? Status{} : Status{Fault::can_buffer_small};
}

Status CanSocket::bind_interface(int number) {
  // The kernel emptied the filter list when the interface went: bound again without it, the socket
  // would receive nothing for ever. Filters first, so that nothing unwanted comes in between.
  if (!set_filters(descriptor_.number, filters_)) return Fault::can_option;
  sockaddr_can address = {};
  address.can_family = AF_CAN;
  address.can_ifindex = number;
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): what the interface of bind() asks
  const auto* pointer = reinterpret_cast<const sockaddr*>(&address);
  if (::bind(descriptor_.number, pointer, sizeof address) != 0) return Fault::can_interface_missing;
  bound_ = number;
  return {};
}

Fault CanSocket::lose(CanLink link) {
  if (link_ == link || (link == CanLink::down && link_ == CanLink::absent)) return Fault::none;
  link_ = link;
  if (link == CanLink::down) {
    ++counters_.link_downs;
    return Fault::can_link_down;
  }
  ++counters_.unplugs;
  return Fault::can_unplugged;
}

Fault CanSocket::check_link() {
  const int number = interface_number(descriptor_.number, name_);
  Fault fault = Fault::none;
  // Unplugged and back between two looks: another number under the same name.
  if (number == 0 || number != bound_) fault = lose(CanLink::absent);
  if (number == 0) return fault;
  if (link_ == CanLink::absent) {
    if (!bind_interface(number)) return fault;
    ++counters_.rebinds;
    controller_ = CanController::active;
    link_ = CanLink::down;
  }
  if (interface_is_up(descriptor_.number, name_)) {
    link_ = CanLink::up;
  } else if (link_ == CanLink::up) {
    fault = lose(CanLink::down);
  }
  return fault;
}

void CanSocket::count_errors() {
  for (const ReceivedFrame& received : batch_.frames()) {
    const Result<CanErrorReport> report = can_error_report(received.frame);
    if (!report) continue;
    const CanErrorReport& says = report.value();
    counters_.receive_overflows += says.receive_overflow ? 1u : 0u;
    counters_.warnings += says.warning ? 1u : 0u;
    counters_.passives += says.passive ? 1u : 0u;
    counters_.bus_offs += says.bus_off ? 1u : 0u;
    counters_.restarts += says.restarted ? 1u : 0u;
    counters_.not_acknowledged += says.not_acknowledged ? 1u : 0u;
    controller_ = next_controller(controller_, says);
  }
}

Status CanSocket::receive() {
  Fault fault = Fault::none;
  switch (batch_.receive(descriptor_.number, index_)) {
    case 0:
    case EAGAIN:
    case EINTR:
      break;
    case ENETDOWN:
      fault = lose(CanLink::down);
      break;
    case ENODEV:
    case ENXIO:
      fault = lose(CanLink::absent);
      break;
    default:
      ++counters_.read_faults;
      fault = Fault::can_read;
  }
  count_errors();
  const std::int64_t now_ns = monotonic_now_ns();
  if (fault == Fault::none && now_ns - checked_ns_ >= limits::can_link_check_ns) {
    checked_ns_ = now_ns;
    fault = check_link();
  }
  return fault;
}

Status CanSocket::send(const BusFrame& frame) {
  const bool is_classic = !frame.error && !frame.remote && !frame.fd && frame.length <= 8;
  can_frame raw = {};
  raw.can_id = frame.id | (frame.extended ? CAN_EFF_FLAG : 0u);
  raw.len = frame.length;
  if (is_classic) std::copy_n(frame.data.begin(), frame.length, raw.data);
  const bool sent = is_classic && ::send(descriptor_.number, &raw, sizeof raw,
                                         MSG_DONTWAIT | MSG_NOSIGNAL) == sizeof raw;
  if (sent) return {};
  ++counters_.send_faults;
  return Fault::can_send;
}

}  // namespace ridgeline
