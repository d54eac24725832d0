#pragma once
#include <sys/un.h>

#include <cstddef>
#include <cstdint>

namespace ridgeline {

/// Tells a service manager how the program is, by the datagram protocol of sd_notify(3). Without
/// NOTIFY_SOCKET in the environment nobody is told, which is fine.
/// Cost: one system call a message, never blocking; no allocation.
class ServiceNotify {
 public:
  /// Looks at NOTIFY_SOCKET.
  ServiceNotify();
  ~ServiceNotify();
  ServiceNotify(const ServiceNotify&) = delete;
  ServiceNotify& operator=(const ServiceNotify&) = delete;

  /// Such as "READY=1"; whether it was delivered or nobody listens.
  bool tell(const char* state) const;
  [[nodiscard]] bool listened_to() const { return descriptor_ >= 0; }

 private:
  int descriptor_ = -1;
  sockaddr_un address_{};
  std::size_t address_bytes_ = 0;
};

}  // namespace ridgeline
