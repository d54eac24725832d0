#include "tests/oracle/dump.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/oracle/input_error.hpp"
#include "tests/oracle/verify.hpp"
#include "tests/unit/oracle/scenes.hpp"

namespace ridgeline::oracle {
namespace {

Frame small_frame() {
  Frame frame;
  frame.name = "000042";
  frame.time_s = 1.5;
  frame.eye = {46.5, 8.5, 2000};
  frame.heading_deg = 90;
  const CameraAxes a = camera_axes(level_frame(46.5, 8.5), 0, 0, 90);
  frame.ecef_from_camera = {a.right.x,   a.down.x,  a.forward.x, a.right.y,  a.down.y,
                            a.forward.y, a.right.z, a.down.z,    a.forward.z};
  frame.width = 3;
  frame.height = 2;
  frame.fx = frame.fy = 3;
  frame.cx = 1.5;
  frame.cy = 1;
  frame.range_m = 1000;
  frame.bound_px = 1;
  frame.geoid = "none";
  frame.has_range_file = true;
  frame.range = {1, 2, 3, 4, std::numeric_limits<float>::infinity(), std::nanf("")};
  return frame;
}

class Dump : public testing::Test {
 protected:
  Dump() { scenes::write_frame(folder_.path(), small_frame()); }

  [[nodiscard]] std::filesystem::path json() const { return folder_.path() / "000042.json"; }
  [[nodiscard]] std::filesystem::path range() const { return folder_.path() / "000042_range.npy"; }
  [[nodiscard]] std::filesystem::path color() const { return folder_.path() / "000042_color.png"; }

  void edit(const std::function<void(nlohmann::json&)>& change) const {
    std::ifstream in(json());
    nlohmann::json root = nlohmann::json::parse(in);
    change(root);
    std::ofstream(json()) << root.dump();
  }

  /// The message with which a frame is refused; empty when it is accepted.
  [[nodiscard]] std::string refusal() const {
    try {
      (void)read_frame(json());
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  scenes::TemporaryFolder folder_;
};

TEST_F(Dump, is_read_as_it_was_written) {
  ASSERT_EQ(frame_files(folder_.path()).size(), 1U);
  const Frame frame = read_frame(json());
  EXPECT_EQ(frame.name, "000042");
  EXPECT_EQ(frame.z(2, 0), 3);
  EXPECT_EQ(frame.z(0, 1), 4);
  EXPECT_TRUE(std::isinf(frame.z(1, 1)));
  EXPECT_TRUE(std::isnan(frame.z(2, 1)));
  EXPECT_EQ(frame.range_m, 1000);
  EXPECT_TRUE(frame_faults(frame).empty());
}

TEST_F(Dump, a_missing_field_is_named) {
  for (const char* field :
       {"time_s", "eye", "attitude", "ecef_from_camera", "width", "height", "fx", "fy", "cx", "cy",
        "range_m", "bound_px", "mode", "reasons", "crc32", "geoid"}) {
    scenes::write_frame(folder_.path(), small_frame());
    edit([&](nlohmann::json& root) { root.erase(field); });
    const std::string message = refusal();
    EXPECT_NE(message.find(field), std::string::npos) << field << ": " << message;
    EXPECT_NE(message.find("000042.json"), std::string::npos);
  }
}

TEST_F(Dump, fields_of_the_wrong_kind_are_refused) {
  const std::vector<std::pair<const char*, nlohmann::json>> wrong = {
      {"width", 2.5},
      {"height", -1},
      {"fx", 0},
      {"mode", "sunny"},
      {"reasons", "x"},
      {"crc32", "zzz"},
      {"bound_px", "1"},
      {"bound_px", 1e9},
      {"proven_px", "1"},
      {"geometry_px", true},
      {"range_m", nullptr},
      {"geoid", 7},
      {"ecef_from_camera", {1, 2, 3}},
      {"eye", 5}};
  for (const auto& [field, value] : wrong) {
    scenes::write_frame(folder_.path(), small_frame());
    edit([&name = field, &content = value](nlohmann::json& root) { root[name] = content; });
    EXPECT_FALSE(refusal().empty()) << field;
  }
  std::ofstream(json()) << "{ not json";
  EXPECT_NE(refusal().find("000042.json"), std::string::npos);
}

TEST_F(Dump, a_range_file_that_does_not_fit_is_refused_by_name) {
  edit([](nlohmann::json& root) { root["width"] = 4; });
  EXPECT_NE(refusal().find("000042_range.npy: shape (2,3)"), std::string::npos) << refusal();
  scenes::write_frame(folder_.path(), small_frame());
  std::filesystem::resize_file(range(), std::filesystem::file_size(range()) - 4);
  EXPECT_NE(refusal().find("000042_range.npy"), std::string::npos);
  std::ofstream(range()) << "nothing";
  EXPECT_NE(refusal().find("000042_range.npy"), std::string::npos);
  std::filesystem::remove(range());
  EXPECT_NE(refusal().find("000042_range.npy: is missing"), std::string::npos) << refusal();
}

TEST_F(Dump, a_missing_or_broken_image_is_refused_by_name) {
  std::ofstream(color()) << "nothing";
  EXPECT_NE(refusal().find("000042_color.png"), std::string::npos);
  std::filesystem::remove(color());
  EXPECT_NE(refusal().find("000042_color.png"), std::string::npos);
}

/// Found by fuzzing: memory was taken for whatever size the header claims.
TEST_F(Dump, an_image_larger_than_any_screen_is_refused_before_it_is_read) {
  std::string png;
  {
    std::ifstream in(color(), std::ios::binary);
    png.assign(std::istreambuf_iterator<char>(in), {});
  }
  constexpr std::size_t header_at = 12, header_bytes = 17;
  png.replace(header_at + 4, 8, std::string("\0\x0f\x42\x40\0\x0f\x42\x40", 8));
  const auto* header = reinterpret_cast<const unsigned char*>(png.data()) + header_at;
  const std::uint32_t crc = crc32_of(header, header_bytes);
  for (std::size_t byte = 0; byte < 4; ++byte) {
    png[header_at + header_bytes + byte] = static_cast<char>(crc >> (24 - 8 * byte));
  }
  std::ofstream(color(), std::ios::binary) << png;
  EXPECT_NE(refusal().find("000042_color.png: is larger than"), std::string::npos) << refusal();
}

TEST_F(Dump, a_folder_without_frames_is_refused) {
  EXPECT_THROW((void)frame_files(folder_.path() / "none"), InputError);
  std::filesystem::rename(json(), folder_.path() / "42.json");
  EXPECT_THROW((void)frame_files(folder_.path()), InputError);
}

TEST_F(Dump, the_crc_is_that_of_the_image_as_number_or_digits) {
  const std::uint32_t crc = read_frame(json()).crc32;
  std::ostringstream digits;
  digits << std::hex << crc;
  edit([&](nlohmann::json& root) { root["crc32"] = digits.str(); });
  EXPECT_EQ(read_frame(json()).crc32, crc);
  EXPECT_TRUE(frame_faults(read_frame(json())).empty());
  edit([&](nlohmann::json& root) { root["crc32"] = crc ^ 1U; });
  EXPECT_EQ(frame_faults(read_frame(json())).size(), 1U);
  const unsigned char check[] = "123456789";
  EXPECT_EQ(crc32_of(check, 9), 0xCBF43926U);
}

TEST_F(Dump, faults_of_a_whole_frame_are_found) {
  Frame frame = read_frame(json());
  frame.range[0] = -5;
  frame.range[1] = 1001;
  EXPECT_EQ(frame_faults(frame).size(), 2U);
  frame = read_frame(json());
  frame.ecef_from_camera[0] *= 1.001;
  EXPECT_GE(frame_faults(frame).size(), 1U);
  frame = read_frame(json());
  frame.mode = Mode::degraded;
  EXPECT_EQ(frame_faults(frame).size(), 1U);
  frame.reasons = {"budget"};
  EXPECT_TRUE(frame_faults(frame).empty());
}

}  // namespace
}  // namespace ridgeline::oracle
