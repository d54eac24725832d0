#pragma once
#include <string>

namespace ridgeline::rig {

/// What a shell command writes to its standard output, without the last end of line.
[[nodiscard]] std::string output_of(const std::string& command);

/// The unit as it is shipped, under the systemd that is this machine's first process. The program
/// is put where the unit looks for it; ended at the end.
class Service {
 public:
  Service();
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;
  ~Service();

  /// Gives a configuration to it, a file.
  static void configure(const std::string& file);
  /// Whether systemctl did as it was told: "start", "kill -s USR1".
  static bool control(const std::string& verb);
  /// As systemctl knows it, such as ActiveState.
  [[nodiscard]] static std::string property(const std::string& name);
  [[nodiscard]] static bool is(const std::string& state) {
    return property("ActiveState") == state;
  }
  /// The process that systemd takes for the program; 0: none.
  [[nodiscard]] static int main_process();
  /// How often the journal has held the text since this object was made, said by or about the unit.
  /// `options`: more for journalctl.
  [[nodiscard]] int times_told(const std::string& text, const std::string& options = "") const;

  static constexpr const char* configuration = "/etc/ridgeline/cockpit.toml";
  static constexpr const char* unit_file = "/usr/lib/systemd/system/ridgeline-display.service";

 private:
  std::string cursor_;  ///< of the journal
};

}  // namespace ridgeline::rig
