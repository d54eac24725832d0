#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ridgeline::test {

/// What a simulated graphics card (vkms) is really showing, seen through a file of its own, as
/// root.
class Scanout {
 public:
  /// The first card of that kind. Ends the program when there is none.
  Scanout();
  Scanout(const Scanout&) = delete;
  Scanout& operator=(const Scanout&) = delete;
  ~Scanout();

  [[nodiscard]] const char* card() const { return card_.c_str(); }
  /// Such as "Virtual-1".
  [[nodiscard]] const char* connector() const { return connector_.c_str(); }

  struct Picture {
    int width_px = 0, height_px = 0;  ///< of the mode; 0: nothing is shown
    std::uint32_t buffer = 0;
    std::vector<std::uint32_t> rows;  ///< XRGB8888 from the top, width_px a row
    [[nodiscard]] std::uint32_t at(int x, int y) const {
      return rows[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) +
                  static_cast<std::size_t>(x)] &
             0xFFFFFF;
    }
  };
  /// The buffer the card shows, by way of the kernel.
  [[nodiscard]] Picture picture() const;
  /// The checksum that the card makes of what it puts out, and the same made of a picture.
  [[nodiscard]] std::optional<std::uint32_t> checksum() const;
  [[nodiscard]] static std::uint32_t checksum(const Picture& picture);

  /// Takes the card for this file, or gives it back. False when another has it.
  [[nodiscard]] bool take() const;
  void give_back() const;
  /// Turns the monitor off or on again, as a cable would.
  void plug(bool in) const;

  /// The file that the screen under test has the card open with: what happens to it from outside.
  [[nodiscard]] int file_of_screen() const;
  /// On that file: switches the output off.
  void switch_off() const;

 private:
  [[nodiscard]] std::uint32_t crtc() const;
  std::string card_, connector_;
  int file_ = -1;
};

}  // namespace ridgeline::test
