#include "platform/service_notify.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>

namespace ridgeline {

ServiceNotify::ServiceNotify() {
  const char* path = std::getenv("NOTIFY_SOCKET");
  if (path == nullptr || (path[0] != '/' && path[0] != '@')) return;
  const std::size_t length = std::strlen(path);
  if (length >= sizeof address_.sun_path) return;
  address_.sun_family = AF_UNIX;
  std::memcpy(address_.sun_path, path, length);
  if (path[0] == '@') address_.sun_path[0] = '\0';  // an abstract name
  address_bytes_ = offsetof(sockaddr_un, sun_path) + length;
  descriptor_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
}

ServiceNotify::~ServiceNotify() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool ServiceNotify::tell(const char* state) const {
  if (descriptor_ < 0) return true;
  const std::size_t length = std::strlen(state);
  return ::sendto(descriptor_, state, length, MSG_NOSIGNAL,
                  reinterpret_cast<const sockaddr*>(&address_),
                  static_cast<socklen_t>(address_bytes_)) == static_cast<ssize_t>(length);
}

}  // namespace ridgeline
