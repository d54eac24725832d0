#include "sim/bench/bench_method.hpp"

#include <algorithm>
#include <cstdio>

#include "core/base/assert.hpp"
#include "sim/bench/bench.hpp"

namespace ridgeline::sim {
namespace {

std::string own_params_of(const FrameSettings& settings) {
  char text[96];
  if (settings.cast_every_pixel) {
    std::snprintf(text, sizeof text, "max pyramid, every pixel from the eye");
  } else {
    std::snprintf(text, sizeof text, "error %g px, grid %g x %g px", settings.error_px,
                  settings.node_spacing.planes_px, settings.node_spacing.rows_px);
  }
  return text;
}

bool is_known(const std::string& name) {
  const auto names = method_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::vector<MethodSpec> default_bench_methods() {
  constexpr const char* text =
      "pgm:grid=512x256,pgm:grid=1024x512,pgm:grid=400x1600,"
      "loffler:grid=512x256,loffler:grid=1024x512,"
      "warp,hybrid,clipmap,raycast,mesh,embree,"
      "ridgeline:error=0.25,ridgeline:error=0.5,ridgeline:error=1,ridgeline:error=2,"
      "ridgeline:error=4,ridgeline:error=8";
  std::vector<MethodSpec> specs;
  const Outcome parsed = parse_methods(text, specs);
  RL_ASSERT(parsed.ok());
  return specs;
}

Outcome make_bench_methods(const std::vector<MethodSpec>& specs, bool tolerant, Session& session,
                           std::vector<BenchMethod>& methods, std::vector<AbsentMethod>& absent) {
  for (const MethodSpec& spec : specs) {
    BenchMethod one{spec, session.settings(), nullptr, {}, nullptr};
    if (is_own_method(spec)) {
      const std::string wrong = apply_own_method(spec, one.settings);
      if (!wrong.empty()) return {Fault::file_malformed, wrong};
      one.own_params = own_params_of(one.settings);
      one.bearing = std::make_unique<BlockBearing>();
      methods.push_back(std::move(one));
      continue;
    }
    std::string problem;
    std::unique_ptr<Method> method = make_method(spec, problem);
    if (method != nullptr) {
      one.method = &session.keep(std::move(method));
      methods.push_back(std::move(one));
    } else if (problem.find("absent") != std::string::npos || (tolerant && !is_known(spec.name))) {
      absent.push_back({method_text(spec), problem});
    } else {
      return {Fault::file_malformed, problem};
    }
  }
  return {};
}

}  // namespace ridgeline::sim
