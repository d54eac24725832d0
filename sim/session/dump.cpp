#include <cstdio>
#include <nlohmann/json.hpp>

#include "sim/output/atomic_file.hpp"
#include "sim/output/image_file.hpp"
#include "sim/output/npy_file.hpp"
#include "sim/session/display_json.hpp"
#include "sim/session/session.hpp"

namespace ridgeline::sim {
namespace {

nlohmann::ordered_json frame_json(const Picture& picture, const std::string& geoid_name) {
  const FrameReport& report = picture.report;
  const Camera& camera = report.camera;
  const bool removed = report.availability.mode == Mode::removed;
  nlohmann::ordered_json json;
  json["time_s"] = static_cast<double>(report.time_ns) * 1e-9;
  json["eye"] = {{"lat_deg", report.local.eye.latitude_deg},
                 {"lon_deg", report.local.eye.longitude_deg},
                 {"height_m", report.local.eye.height_m}};
  json["attitude"] = {{"roll_deg", camera.attitude.roll_deg},
                      {"pitch_deg", camera.attitude.pitch_deg},
                      {"heading_deg", camera.attitude.heading_deg}};
  const auto axes = (report.local.ecef_from_enu * camera.enu_from_camera).columns;
  auto rows = nlohmann::ordered_json::array();
  for (int r = 0; r < 3; ++r) rows.push_back({axes[0][r], axes[1][r], axes[2][r]});
  json["ecef_from_camera"] = rows;
  json["width"] = camera.width_px;
  json["height"] = camera.height_px;
  json["fx"] = camera.fx;
  json["fy"] = camera.fy;
  json["cx"] = camera.cx;
  json["cy"] = camera.cy;
  json["range_m"] = report.range_m;
  const bool promised = !removed && report.bound_px > 0;  // methods without a proof promise none
  json["bound_px"] =
      promised ? nlohmann::ordered_json(report.bound_px) : nlohmann::ordered_json(nullptr);
  if (promised) {
    json["geometry_px"] = report.budget.geometry_px;
    json["proven_px"] = report.budget.smallest_px() + report.shared_px;
  }
  json["mode"] = mode_word(report.availability.mode);
  json["reasons"] = nlohmann::ordered_json::array();
  for (const Reason reason : report.availability.reasons) {
    json["reasons"].push_back(reason_word(reason));
  }
  if (auto display = display_json(report.display); !display.is_null()) json["display"] = display;
  json["crc32"] = crc32_of(picture.rgb);
  json["geoid"] = geoid_name;
  return json;
}

}  // namespace

nlohmann::ordered_json display_json(const DisplayState& display) {
  if (display == DisplayState{}) return nullptr;
  return {{"luminance", display.luminance},
          {"words_luminance", words_luminance(display)},
          {"declutter", display.declutter}};
}

Outcome write_dump(const std::string& folder, int index, const Picture& picture,
                   const std::string& geoid_name) {
  char stem[32];
  std::snprintf(stem, sizeof stem, "/%06d", index);
  const std::string path = folder + stem;
  const int width = picture.report.camera.width_px, height = picture.report.camera.height_px;
  if (!picture.range_m.empty()) {
    if (auto done = write_npy(path + "_range.npy", height, width, picture.range_m); !done.ok()) {
      return done;
    }
  }
  if (auto done = write_png(path + "_color.png", width, height, picture.rgb); !done.ok()) {
    return done;
  }
  return write_file(path + ".json", frame_json(picture, geoid_name).dump(1) + "\n");
}

}  // namespace ridgeline::sim
