#include "platform/display/json_text.hpp"

#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace ridgeline {

void JsonText::put(std::string_view text) {
  if (cut_ || text.size() > text_.size() - length_) {
    cut_ = true;
    return;
  }
  std::memcpy(text_.data() + length_, text.data(), text.size());
  length_ += text.size();
}

void JsonText::put_quoted(std::string_view text) {
  put("\"");
  for (const char c : text) {
    char escaped[8];
    if (c == '"' || c == '\\') {
      std::snprintf(escaped, sizeof escaped, "\\%c", c);
    } else if (static_cast<unsigned char>(c) < 0x20) {
      std::snprintf(escaped, sizeof escaped, "\\u%04x", static_cast<unsigned>(c));
    } else {
      std::snprintf(escaped, sizeof escaped, "%c", c);
    }
    put(escaped);
  }
  put("\"");
}

void JsonText::begin(const char* name) {
  if (after_value_) put(",");
  if (depth_ > 0) put("\n");
  for (int i = 0; i < depth_; ++i) put(" ");
  if (name != nullptr) {
    put_quoted(name);
    put(": ");
  }
  after_value_ = true;
}

void JsonText::open(const char* name, char bracket) {
  begin(name);
  put({&bracket, 1});
  ++depth_;
  after_value_ = false;
}

void JsonText::close(char bracket) {
  --depth_;
  put({&bracket, 1});
  after_value_ = true;
  if (depth_ == 0) put("\n");
}

void JsonText::add(const char* name, double value) {
  if (!std::isfinite(value)) return add_null(name);
  begin(name);
  char number[32];
  std::snprintf(number, sizeof number, "%.17g", value);
  put(number);
}

void JsonText::add(const char* name, std::uint64_t value) {
  begin(name);
  char number[32];
  std::snprintf(number, sizeof number, "%" PRIu64, value);
  put(number);
}

void JsonText::add(const char* name, std::int64_t value) {
  begin(name);
  char number[32];
  std::snprintf(number, sizeof number, "%" PRId64, value);
  put(number);
}

void JsonText::add(const char* name, bool value) {
  begin(name);
  put(value ? "true" : "false");
}

void JsonText::add(const char* name, std::string_view text) {
  begin(name);
  put_quoted(text);
}

void JsonText::add_null(const char* name) {
  begin(name);
  put("null");
}

}  // namespace ridgeline
