#pragma once
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace ridgeline::rig {

namespace fs = std::filesystem;

inline void put(const fs::path& file, const std::string& text) {
  std::ofstream(file) << text;
}
inline std::string text_of(const fs::path& file) {
  std::string text;
  std::ifstream(file) >> text;
  return text;
}

/// A simulated chip of seven named lines as long as the object lives.
class SimulatedChip {
 public:
  SimulatedChip() {
    fs::create_directories(folder_ / "bank");
    put(folder_ / "bank/num_lines", "8");
    for (std::size_t i = 0; i < std::size(names); ++i) {
      const fs::path line = folder_ / ("bank/line" + std::to_string(i));
      fs::create_directory(line);
      put(line / "name", names[i]);
    }
    put(folder_ / "live", "1");
    lines_ = fs::path("/sys/devices/platform") / text_of(folder_ / "dev_name") /
             text_of(folder_ / "bank/chip_name");
  }
  ~SimulatedChip() {
    vanish();
    for (std::size_t i = 0; i < std::size(names); ++i) {
      fs::remove(folder_ / ("bank/line" + std::to_string(i)));
    }
    fs::remove(folder_ / "bank");
    fs::remove(folder_);
  }
  void vanish() { put(folder_ / "live", "0"); }
  void pull(int line, bool up) {
    put(lines_ / ("sim_gpio" + std::to_string(line)) / "pull", up ? "pull-up" : "pull-down");
  }
  [[nodiscard]] bool value(int line) const { return text_of(value_file(line)) == "1"; }
  /// What a line is at, as the kernel tells it: "0" or "1".
  [[nodiscard]] fs::path value_file(int line) const {
    return lines_ / ("sim_gpio" + std::to_string(line)) / "value";
  }

  /// Lines by their place.
  enum Place { heartbeat, svs_valid, svs_fail, display_on, declutter, night, on_ground };
  static constexpr const char* names[] = {"rig-beat", "rig-valid", "rig-fail",  "rig-on",
                                          "rig-decl", "rig-night", "rig-ground"};

 private:
  fs::path folder_ = "/sys/kernel/config/gpio-sim/ridgeline";
  fs::path lines_;
};

}  // namespace ridgeline::rig
