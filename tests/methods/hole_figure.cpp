#include "tests/methods/hole_figure.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "sim/methods/loffler.hpp"
#include "sim/output/image_file.hpp"

namespace ridgeline::test {
namespace {

constexpr int gap_px = 3;        ///< white, between panels
constexpr double most_px = 128;  ///< errors are measured up to this

using Colour = std::array<std::uint8_t, 3>;

/// Three panels of a crop, one below the other.
class Panels {
 public:
  Panels(const PixelSet& crop, int zoom)
      : crop_(crop),
        zoom_(zoom),
        columns_(zoom * (crop.right - crop.left)),
        rows_(3 * zoom * (crop.bottom - crop.top) + 2 * gap_px),
        rgb_(static_cast<std::size_t>(columns_) * rows_ * 3, 255) {}

  void put(int panel, int u, int v, const Colour& colour) {
    const int top = panel * (zoom_ * (crop_.bottom - crop_.top) + gap_px);
    for (int y = 0; y < zoom_; ++y) {
      for (int x = 0; x < zoom_; ++x) {
        const int row = top + zoom_ * (v - crop_.top) + y, column = zoom_ * (u - crop_.left) + x;
        for (std::size_t c = 0; c < 3; ++c) {
          rgb_[(static_cast<std::size_t>(row) * columns_ + column) * 3 + c] = colour[c];
        }
      }
    }
  }
  [[nodiscard]] sim::Outcome write(const std::string& path) const {
    return sim::write_png(path, columns_, rows_, rgb_);
  }

 private:
  PixelSet crop_;
  int zoom_, columns_, rows_;
  std::vector<std::uint8_t> rgb_;
};

Colour colour_at(const sim::Picture& picture, int width, int u, int v) {
  const std::size_t at = 3 * (static_cast<std::size_t>(v) * width + u);
  return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

float at(const sim::Picture& picture, int width, const JudgedPixel& pixel) {
  return picture.range_m[static_cast<std::size_t>(pixel.v) * width + pixel.u];
}

Colour verdict_colour(const JudgedPixel& pixel, bool is_cast, const Colour& ours) {
  if (pixel.unsound) return {230, 30, 30};
  if (pixel.incomplete) return {250, 210, 40};
  const int grey = (ours[0] + 2 * ours[1] + ours[2]) / 10;
  const auto value = static_cast<std::uint8_t>(grey);
  return {value, value, static_cast<std::uint8_t>(is_cast ? value + 110 : value)};
}

/// Draws with the method in use; a picture that was not drawn is a fault of the tool.
sim::Picture drawn(Scene& scene, const Hole& hole) {
  sim::Picture picture = scene.draw(hole.pose);
  if (picture.problem.ok() && picture.report.availability.mode != Mode::removed) return picture;
  std::fprintf(stderr, "%s: not drawn: %s\n", hole.file.c_str(), picture.problem.message.c_str());
  std::abort();
}

}  // namespace

sim::Outcome draw_hole(const Hole& hole, const std::string& folder, HoleNumbers& numbers) {
  Land land(hole.height_m);
  for (const auto& [south, west] : hole.tiles) land.add_tile(south, west);
  Scene scene(land, hole.image, 1.0, hole.range_m, hole.pose.eye);
  scene.settings().cast_every_pixel = true;  // ours with a ray for every pixel: the truth's place
  const sim::Picture ours = drawn(scene, hole);
  sim::MethodSpec spec;
  sim::Outcome parsed = sim::parse_method("loffler:" + hole.settings, spec);
  if (!parsed.ok()) return parsed;
  std::string problem;
  auto method = std::make_unique<sim::Loffler>(sim::loffler_settings(spec, problem));
  if (!problem.empty()) return {Fault::file_malformed, problem};
  sim::Loffler& loffler = *method;
  scene.session().use(&scene.session().keep(std::move(method)));
  const sim::Picture theirs = drawn(scene, hole);
  std::vector<float> errors(theirs.range_m.size());
  loffler.read_errors(errors);

  const MethodJudge judge(land.path());
  const JudgedPicture judged = judge.judge(theirs, hole.crop, hole.claim_px, most_px);
  const JudgedPicture our_judged = judge.judge(ours, hole.crop, hole.claim_px, most_px);
  Panels panels(hole.crop, hole.zoom);
  const int width = hole.image.width_px;
  for (const JudgedPixel& pixel : judged.pixels) {
    const bool is_cast = errors[static_cast<std::size_t>(pixel.v) * width + pixel.u] > 0;
    const Colour own = colour_at(ours, width, pixel.u, pixel.v);
    const bool wrong = pixel.unsound || pixel.incomplete;
    numbers.wrong += wrong ? 1 : 0;
    numbers.wrong_uncast += wrong && !is_cast ? 1 : 0;
    numbers.lost += std::isinf(at(theirs, width, pixel)) && at(ours, width, pixel) > 0 &&
                            !std::isinf(at(ours, width, pixel))
                        ? 1
                        : 0;
    numbers.cast_percent += is_cast ? 100.0 / static_cast<double>(judged.pixels.size()) : 0.0;
    panels.put(0, pixel.u, pixel.v, colour_at(theirs, width, pixel.u, pixel.v));
    panels.put(1, pixel.u, pixel.v, own);
    panels.put(2, pixel.u, pixel.v, verdict_colour(pixel, is_cast, own));
  }
  numbers.judged = static_cast<int>(judged.pixels.size());
  numbers.unsound = judged.unsound();
  numbers.incomplete = judged.incomplete();
  numbers.max_px = judged.max_px();
  numbers.max_is_more = numbers.max_px >= 0.99 * most_px;
  for (const JudgedPixel& pixel : our_judged.pixels) {
    numbers.ours_wrong += pixel.unsound || pixel.incomplete ? 1 : 0;
  }
  return panels.write(folder + "/" + hole.file);
}

}  // namespace ridgeline::test
