#include "tests/unit/oracle/verify_scene.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace ridgeline::oracle::scenes {

VerifiedScene::VerifiedScene(const Surface& surface) {
  write_hgt(terrain_.path(), 46, 8, surface);
  truth_.emplace(Terrain::load(terrain_.path(), Geoid(), {}));
}

VerifySummary VerifiedScene::verified(const Frame& frame, int threads, int pixels) const {
  VerifyOptions options;
  options.pixels_per_frame = pixels;
  options.threads = threads;
  return verified({frame}, options);
}

VerifySummary VerifiedScene::verified(const std::vector<Frame>& frames, VerifyOptions& options,
                                      std::ostream* told) const {
  const TemporaryFolder dump;
  for (const Frame& frame : frames) write_frame(dump.path(), frame);
  options.dump_folder = dump.path();
  options.terrain_folder = terrain_.path();
  std::ostringstream progress;
  return run_verify(options, told == nullptr ? progress : *told);
}

const VerifiedScene& mountain_scene() {
  static const VerifiedScene scene([](double lat, double lon) {
    static const Surface hills = rugged(2500, 21);
    const bool is_void = std::hypot(lat - 46.45, (lon - 8.48) * 0.69) < 0.03;
    return is_void ? std::nan("") : hills(lat, lon);
  });
  return scene;
}

Shot mountain_shot() {
  Shot shot;
  shot.eye = {46.3, 8.5, 2400};
  shot.roll_deg = 12;
  shot.pitch_deg = -4;
  shot.heading_deg = 350;
  return shot;
}

double plain_with_void(double lat_deg, double lon_deg) {
  const bool is_void = lat_deg > 46.35 && lat_deg < 46.6 && lon_deg > 8.3 && lon_deg < 8.7;
  return is_void ? std::nan("") : 500.0;
}

std::string report(const VerifySummary& summary) {
  std::ostringstream text;
  print_summary(summary, text);
  return text.str();
}

Frame shifted(const Frame& frame, int du, int dv) {
  Frame result = frame;
  for (int v = 0; v < frame.height; ++v) {
    for (int u = 0; u < frame.width; ++u) {
      const int from_u = std::min(std::max(u + du, 0), frame.width - 1);
      const int from_v = std::min(std::max(v + dv, 0), frame.height - 1);
      result.range[static_cast<std::size_t>(v * frame.width + u)] =
          static_cast<float>(frame.z(from_u, from_v));
    }
  }
  return result;
}

Frame changed(const Frame& frame, const std::function<float(float)>& change) {
  Frame result = frame;
  for (float& z : result.range) z = change(z);
  return result;
}

std::size_t count(const Frame& frame, const std::function<bool(float)>& is) {
  return static_cast<std::size_t>(std::count_if(frame.range.begin(), frame.range.end(), is));
}

}  // namespace ridgeline::oracle::scenes
