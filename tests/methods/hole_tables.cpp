#include "tests/methods/hole_tables.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "sim/methods/loffler.hpp"
#include "sim/synthetic/make_demo.hpp"
#include "tests/methods/method_judge.hpp"

namespace ridgeline::test {
namespace {

constexpr ImageGeometry image{1024, 800, 60};
constexpr PixelSet sample{3, 3, 1024, 800, 13};
constexpr double most_px = 64;

/// Views over the synthetic island: its middle, 100 to 9000 m over the ground, and a valley.
struct View {
  const char* name;
  GeodeticPosition eye;
  Attitude attitude;
};
constexpr View views[] = {{"low", {-47.5, -123.5, 1017}, {0, -2, 30}},
                          {"valley", {-47.448333, -123.666667, 200}, {0, -1, 150}},
                          {"high", {-47.5, -123.5, 3917}, {0, -10, 250}},
                          {"steep down", {-47.5, -123.5, 4917}, {0, -60, 10}},
                          {"banked", {-47.5, -123.5, 2417}, {40, -5, 80}},
                          {"wide horizon", {-47.5, -123.5, 9917}, {0, -3, 330}}};
constexpr double view_count = 6;
static_assert(std::size(views) == 6);

/// One variant of the method over all views.
struct Row {
  std::string settings;
  double over_percent = 0, mean_px = 0, max_px = 0, cast_percent = 0;
  int wrong = 0, judged = 0;
  int cast = 0, cast_wrong = 0;  ///< of the judged pixels, those with an error in the buffer
};

struct Ground {
  sim::Session session;
  std::unique_ptr<MethodJudge> judge;
};

void add(Row& row, const JudgedPicture& judged, const std::vector<float>& errors) {
  row.over_percent += judged.percent_over(judged.claim_px) / view_count;
  row.mean_px += judged.mean_px() / view_count;
  row.max_px = std::max(row.max_px, judged.max_px());
  for (const JudgedPixel& pixel : judged.pixels) {
    const bool wrong = pixel.unsound || pixel.incomplete;
    row.wrong += wrong ? 1 : 0;
    if (errors.empty()) continue;
    const bool is_cast = errors[static_cast<std::size_t>(pixel.v) * image.width_px + pixel.u] > 0;
    row.cast += is_cast ? 1 : 0;
    row.cast_wrong += is_cast && pixel.unsound ? 1 : 0;
  }
  row.judged += static_cast<int>(judged.pixels.size());
}

bool measure(Ground& ground, Row& row) {
  sim::MethodSpec spec;
  std::string problem = sim::parse_method("loffler:" + row.settings, spec).message;
  const sim::LofflerSettings settings = sim::loffler_settings(spec, problem);
  if (!problem.empty()) {
    std::fprintf(stderr, "%s\n", problem.c_str());
    return false;
  }
  auto method = std::make_unique<sim::Loffler>(settings);
  sim::Loffler& loffler = *method;
  ground.session.use(&ground.session.keep(std::move(method)));
  for (const View& view : views) {
    FrameInput input;
    input.eye = view.eye;
    input.attitude = view.attitude;
    const sim::Picture picture = ground.session.draw(input, true);
    if (picture.range_m.empty()) {
      std::fprintf(stderr, "%s: not drawn %s\n", view.name, picture.problem.message.c_str());
      return false;
    }
    std::vector<float> errors;
    if (settings.rays) {
      errors.resize(picture.range_m.size());
      loffler.read_errors(errors);
    }
    row.cast_percent += 100.0 * picture.method.ray_cast_share / view_count;
    add(row, ground.judge->judge(picture, sample, settings.gamma_px, most_px), errors);
  }
  return true;
}

}  // namespace

int print_hole_tables(const std::string& folder) {
  const std::string island = folder + "/island";
  if (const sim::Outcome made = sim::make_demo(island); !made.ok()) {
    std::fprintf(stderr, "%s\n", made.message.c_str());
    return 3;
  }
  Ground ground;
  sim::SceneOptions options;
  options.terrain_folder = island;
  options.settings.image = image;
  const sim::Outcome opened = ground.session.open(options, views[0].eye);
  if (!opened.ok()) {
    std::fprintf(stderr, "%s\n", opened.message.c_str());
    return 3;
  }
  ground.judge = std::make_unique<MethodJudge>(island);
  std::printf(
      "\n| loffler: | pixels over 1 px | mean error, px | largest error, px | ray cast | judged | "
      "beyond the claim | cast and unsound |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const char* settings :
       {"grid=512x256,warp=0,rays=0", "grid=512x256,rays=0", "grid=512x256,warp=0", "grid=512x256",
        "grid=1024x512,warp=0,rays=0", "grid=1024x512,rays=0", "grid=1024x512,warp=0",
        "grid=1024x512", "grid=400x1900,warp=0,rays=0", "grid=400x1900,rays=0",
        "grid=400x1900,warp=0", "grid=400x1900", "grid=1024x512,rays=0,lift=1",
        "grid=1024x512,from=eye"}) {
    Row row;
    row.settings = settings;
    if (!measure(ground, row)) return 3;
    std::printf("| `%s` | %.2f %% | %.3f | %.1f | %.1f %% | %d | %d | %d of %d |\n", settings,
                row.over_percent, row.mean_px, row.max_px, row.cast_percent, row.judged, row.wrong,
                row.cast_wrong, row.cast);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace ridgeline::test
