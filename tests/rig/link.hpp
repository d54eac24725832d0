#pragma once
#include <cstdlib>
#include <string>

namespace ridgeline::rig {

/// Runs a shell command; whether it ended with 0.
inline bool shell(const std::string& command) {
  return std::system(command.c_str()) == 0;
}

/// A virtual CAN interface as long as the object lives.
class VirtualCan {
 public:
  explicit VirtualCan(std::string name) : name_(std::move(name)) { plug(); }
  VirtualCan(const VirtualCan&) = delete;
  VirtualCan& operator=(const VirtualCan&) = delete;
  ~VirtualCan() { unplug(); }

  bool plug() const { return shell("ip link add dev " + name_ + " mtu 72 type vcan") && up(); }
  bool unplug() const { return shell("ip link del dev " + name_ + " 2>/dev/null"); }
  bool up() const { return shell("ip link set dev " + name_ + " up"); }
  bool down() const { return shell("ip link set dev " + name_ + " down"); }
  bool send(const std::string& frame) const { return shell("cansend " + name_ + " " + frame); }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  std::string name_;
};

}  // namespace ridgeline::rig
