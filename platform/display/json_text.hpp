#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace ridgeline {

/// Writes one JSON value into memory of fixed size, without the heap. What does not fit is left out
/// and makes complete() false.
class JsonText {
 public:
  void open_object(const char* name = nullptr) { open(name, '{'); }
  void close_object() { close('}'); }
  void open_list(const char* name = nullptr) { open(name, '['); }
  void close_list() { close(']'); }
  /// Members of an object have a name, those of a list none.
  void add(const char* name, double value);  ///< not finite: null
  void add(const char* name, std::uint64_t value);
  void add(const char* name, std::int64_t value);
  void add(const char* name, bool value);
  void add(const char* name, std::string_view text);
  void add(const char* name, const char* text) { add(name, std::string_view(text)); }
  void add_null(const char* name);

  [[nodiscard]] std::string_view text() const { return {text_.data(), length_}; }
  [[nodiscard]] bool complete() const { return !cut_ && depth_ == 0; }
  void clear() { *this = JsonText(); }

 private:
  void open(const char* name, char bracket);
  void close(char bracket);
  void begin(const char* name);
  void put(std::string_view text);
  void put_quoted(std::string_view text);

  std::array<char, 16384> text_{};
  std::size_t length_ = 0;
  int depth_ = 0;
  bool after_value_ = false;
  bool cut_ = false;
};

}  // namespace ridgeline
