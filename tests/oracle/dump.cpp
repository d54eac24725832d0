#include "tests/oracle/dump.hpp"

#include <png.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "tests/oracle/input_error.hpp"

namespace ridgeline::oracle {
namespace {

using Json = nlohmann::json;

/// Beyond this a bound says nothing, and looking for the pixels within it takes for ever.
constexpr double largest_bound_px = 1024;
constexpr png_uint_32 largest_picture_side = 8192;

std::string file_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(file.string(), "cannot be opened");
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Fields of one JSON object, each fault naming the file and the field.
class Fields {
 public:
  Fields(const std::string& file, const Json& object) : file_(file), object_(object) {}

  [[nodiscard]] const Json& field(const char* name) const {
    if (!object_.is_object() || !object_.contains(name)) {
      throw InputError(file_, std::string("field '") + name + "' is missing");
    }
    return object_.at(name);
  }

  [[nodiscard]] double real(const char* name) const {
    const Json& value = field(name);
    if (!value.is_number()) wrong(name, "is not a number");
    return value.get<double>();
  }

  /// Nothing where the field is absent or null.
  [[nodiscard]] std::optional<double> real_if_any(const char* name) const {
    if (!object_.contains(name) || object_.at(name).is_null()) return std::nullopt;
    return real(name);
  }

  [[nodiscard]] int count(const char* name) const {
    const double value = real(name);
    if (!(value >= 1) || value > 65536 || value != std::floor(value)) wrong(name, "is not a size");
    return static_cast<int>(value);
  }

  [[nodiscard]] std::string word(const char* name) const {
    const Json& value = field(name);
    if (!value.is_string()) wrong(name, "is not a string");
    return value.get<std::string>();
  }

  [[noreturn]] void wrong(const char* name, const char* fault) const {
    throw InputError(file_, std::string("field '") + name + "' " + fault);
  }

 private:
  const std::string& file_;
  const Json& object_;
};

void read_rotation(const Fields& fields, Frame& frame) {
  const Json& rows = fields.field("ecef_from_camera");
  const char* const fault = "is not a 3x3 matrix of numbers";
  if (!rows.is_array() || rows.size() != 3) fields.wrong("ecef_from_camera", fault);
  for (std::size_t row = 0; row < 3; ++row) {
    if (!rows[row].is_array() || rows[row].size() != 3) fields.wrong("ecef_from_camera", fault);
    for (std::size_t column = 0; column < 3; ++column) {
      if (!rows[row][column].is_number()) fields.wrong("ecef_from_camera", fault);
      frame.ecef_from_camera[3 * row + column] = rows[row][column].get<double>();
    }
  }
}

std::uint32_t read_crc(const Fields& fields) {
  const Json& value = fields.field("crc32");
  if (value.is_number_unsigned() && value.get<std::uint64_t>() <= 0xFFFFFFFFU) {
    return value.get<std::uint32_t>();
  }
  if (value.is_string()) {
    std::string digits = value.get<std::string>();
    if (digits.starts_with("0x")) digits.erase(0, 2);
    const bool is_hex = !digits.empty() && digits.size() <= 8 &&
                        std::all_of(digits.begin(), digits.end(),
                                    [](unsigned char c) { return std::isxdigit(c) != 0; });
    if (is_hex) return static_cast<std::uint32_t>(std::stoul(digits, nullptr, 16));
  }
  fields.wrong("crc32", "is neither a 32-bit number nor its hexadecimal digits");
}

Mode read_mode(const Fields& fields) {
  const std::string word = fields.word("mode");
  if (word == "svs") return Mode::svs;
  if (word == "degraded") return Mode::degraded;
  if (word == "removed") return Mode::removed;
  fields.wrong("mode", "is none of svs, degraded, removed");
}

/// The value of a key in the dictionary of an NPY header, up to the comma or brace that ends it.
std::string npy_value(const std::string& file, const std::string& header, const std::string& key) {
  const std::size_t at = header.find("'" + key + "'");
  const std::size_t colon = at == std::string::npos ? at : header.find(':', at);
  if (colon == std::string::npos) throw InputError(file, "NPY header has no '" + key + "'");
  const std::size_t start = header.find_first_not_of(' ', colon + 1);
  if (start == std::string::npos) throw InputError(file, "NPY header is corrupt");
  const char last = header[start] == '(' ? ')' : ',';
  const std::size_t end = header.find(last, start);
  if (end == std::string::npos) throw InputError(file, "NPY header is corrupt");
  return header.substr(start, end - start + (last == ')' ? 1 : 0));
}

}  // namespace

std::vector<float> range_in(const std::string& file, const std::string& bytes, int width,
                            int height) {
  if (bytes.size() < 10 || bytes.compare(0, 6, "\x93NUMPY") != 0) {
    throw InputError(file, "is not an NPY file");
  }
  if (bytes[6] != 1 || bytes[7] != 0) throw InputError(file, "is not NPY format 1.0");
  const std::size_t header_size =
      static_cast<unsigned char>(bytes[8]) +
      256U * static_cast<std::size_t>(static_cast<unsigned char>(bytes[9]));
  if (bytes.size() < 10 + header_size) throw InputError(file, "NPY header is truncated");
  const std::string header = bytes.substr(10, header_size);
  if (npy_value(file, header, "descr") != "'<f4'") throw InputError(file, "is not float32");
  if (npy_value(file, header, "fortran_order") != "False") {
    throw InputError(file, "is not in C order");
  }
  std::string shape = npy_value(file, header, "shape");
  std::erase(shape, ' ');
  const std::string expected = "(" + std::to_string(height) + "," + std::to_string(width) + ")";
  if (shape != expected) {
    throw InputError(file, "shape " + shape + " is not the frame's " + expected);
  }
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (bytes.size() != 10 + header_size + 4 * count) {
    throw InputError(file, "size is not what its shape says");
  }
  std::vector<float> values(count);
  static_assert(std::endian::native == std::endian::little, "the file is read as it lies");
  std::memcpy(values.data(), bytes.data() + 10 + header_size, 4 * count);
  return values;
}

void take_color(const std::string& file, const std::string& bytes, Frame& frame) {
  png_image image;
  std::memset(&image, 0, sizeof image);
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) {
    throw InputError(file, image.message);
  }
  // A header may claim any size; memory is for pictures that a screen can have.
  if (image.width > largest_picture_side || image.height > largest_picture_side) {
    png_image_free(&image);
    throw InputError(file, "is larger than any picture of a frame");
  }
  image.format = PNG_FORMAT_RGB;
  std::vector<unsigned char> pixels(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr) == 0) {
    throw InputError(file, image.message);
  }
  frame.color_width = static_cast<int>(image.width);
  frame.color_height = static_cast<int>(image.height);
  frame.color_crc32 = crc32_of(pixels.data(), pixels.size());
}

namespace {

std::filesystem::path sibling(const std::filesystem::path& json, const char* ending) {
  return json.parent_path() / (json.stem().string() + ending);
}

}  // namespace

std::uint32_t crc32_of(const unsigned char* bytes, std::size_t count) {
  static const std::array<std::uint32_t, 256> table = [] {
    std::array<std::uint32_t, 256> made{};
    for (std::uint32_t i = 0; i < made.size(); ++i) {
      std::uint32_t value = i;
      for (int bit = 0; bit < 8; ++bit) {
        value = (value & 1U) != 0 ? 0xEDB88320U ^ (value >> 1U) : value >> 1U;
      }
      made[i] = value;
    }
    return made;
  }();
  std::uint32_t crc = 0xFFFFFFFFU;
  for (std::size_t i = 0; i < count; ++i) crc = table[(crc ^ bytes[i]) & 0xFFU] ^ (crc >> 8U);
  return ~crc;
}

std::vector<std::filesystem::path> frame_files(const std::filesystem::path& folder) {
  std::error_code fault;
  std::vector<std::filesystem::path> files;
  for (std::filesystem::directory_iterator it(folder, fault), end; !fault && it != end;
       it.increment(fault)) {
    const std::string stem = it->path().stem().string();
    const bool is_number =
        stem.size() == 6 &&
        std::all_of(stem.begin(), stem.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
    if (is_number && it->path().extension() == ".json") files.push_back(it->path());
  }
  if (fault) throw InputError(folder.string(), "folder cannot be read");
  if (files.empty()) throw InputError(folder.string(), "holds no dumped frame");
  std::sort(files.begin(), files.end());
  return files;
}

Frame read_frame_header(const std::filesystem::path& json) {
  return frame_header_in(json, file_text(json),
                         std::filesystem::exists(sibling(json, "_range.npy")));
}

Frame frame_header_in(const std::filesystem::path& json, const std::string& text,
                      bool has_range_file) {
  const std::string file = json.string();
  const Json root = Json::parse(text, nullptr, false);
  if (root.is_discarded() || !root.is_object()) throw InputError(file, "is not a JSON object");
  const Fields fields(file, root);
  Frame frame;
  frame.name = json.stem().string();
  frame.mode = read_mode(fields);
  frame.time_s = fields.real("time_s");
  const Json& reasons = fields.field("reasons");
  if (!reasons.is_array()) fields.wrong("reasons", "is not a list");
  for (const Json& reason : reasons) {
    if (!reason.is_string()) fields.wrong("reasons", "holds something that is not a word");
    frame.reasons.push_back(reason.get<std::string>());
  }
  frame.crc32 = read_crc(fields);
  frame.geoid = fields.word("geoid");
  frame.width = fields.count("width");
  frame.height = fields.count("height");
  (void)fields.field("bound_px");
  frame.bound_px = fields.real_if_any("bound_px");
  if (frame.bound_px && *frame.bound_px > largest_bound_px) fields.wrong("bound_px", "is no bound");
  frame.proven_px = fields.real_if_any("proven_px");
  frame.geometry_px = fields.real_if_any("geometry_px");
  frame.has_range_file = has_range_file;
  // A frame is removed because its input is not valid, so the pose may be missing there.
  if (frame.mode == Mode::removed) return frame;
  const Fields eye(file, fields.field("eye"));
  frame.eye = {eye.real("lat_deg"), eye.real("lon_deg"), eye.real("height_m")};
  const Fields attitude(file, fields.field("attitude"));
  frame.roll_deg = attitude.real("roll_deg");
  frame.pitch_deg = attitude.real("pitch_deg");
  frame.heading_deg = attitude.real("heading_deg");
  read_rotation(fields, frame);
  frame.fx = fields.real("fx");
  frame.fy = fields.real("fy");
  frame.cx = fields.real("cx");
  frame.cy = fields.real("cy");
  frame.range_m = fields.real("range_m");
  if (!(std::abs(frame.eye.lat_deg) <= 90)) eye.wrong("lat_deg", "is not a latitude");
  if (!(std::abs(frame.eye.lon_deg) <= 360)) eye.wrong("lon_deg", "is not a longitude");
  if (!(frame.fx > 0)) fields.wrong("fx", "is not positive");
  if (!(frame.fy > 0)) fields.wrong("fy", "is not positive");
  if (!(frame.range_m > 0) || frame.range_m > 2e6) fields.wrong("range_m", "is not a range");
  return frame;
}

Frame read_frame(const std::filesystem::path& json) {
  Frame frame = read_frame_header(json);
  const std::filesystem::path color = sibling(json, "_color.png");
  take_color(color.string(), file_text(color), frame);
  if (frame.mode == Mode::removed) return frame;
  if (!frame.has_range_file) {
    throw InputError(sibling(json, "_range.npy").string(), "is missing");
  }
  const std::filesystem::path range = sibling(json, "_range.npy");
  frame.range = range_in(range.string(), file_text(range), frame.width, frame.height);
  return frame;
}

}  // namespace ridgeline::oracle
