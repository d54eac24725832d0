#include <algorithm>

#include "config/limits.hpp"
#include "sim/methods/clipmap.hpp"
#include "sim/methods/embree.hpp"
#include "sim/methods/hybrid.hpp"
#include "sim/methods/loffler.hpp"
#include "sim/methods/mesh.hpp"
#include "sim/methods/method.hpp"
#include "sim/methods/pgm.hpp"
#include "sim/methods/setting_reader.hpp"
#include "sim/methods/warp.hpp"

namespace ridgeline::sim {
namespace {

using Factory = std::unique_ptr<Method> (*)(const MethodSpec& spec, std::string& problem);

/// Every method, in the order of the tables; without a factory: one of the module's own ways.
struct Entry {
  std::string_view name;
  Factory make;
};
constexpr Entry entries[] = {
    {"pgm", make_pgm},       {"loffler", make_loffler}, {"warp", make_warp},
    {"hybrid", make_hybrid}, {"clipmap", make_clipmap}, {"raycast", nullptr},
    {"mesh", make_mesh},     {"embree", make_embree},   {"ridgeline", nullptr},
};

const Entry* find(std::string_view name) {
  const auto* const entry = std::find_if(std::begin(entries), std::end(entries),
                                         [&](const Entry& e) { return e.name == name; });
  return entry == std::end(entries) ? nullptr : entry;
}

std::string unknown_method(const std::string& name) {
  std::string text = "'" + name + "' is no method; there are";
  for (const Entry& entry : entries) {
    text += (&entry == std::begin(entries) ? " " : ", ") + std::string(entry.name);
  }
  return text;
}

}  // namespace

bool is_own_method(const MethodSpec& spec) {
  const Entry* const entry = find(spec.name);
  return entry != nullptr && entry->make == nullptr;
}

std::string apply_own_method(const MethodSpec& spec, FrameSettings& settings) {
  FrameSettings given = settings;
  SettingReader reader(spec);
  reader.number("error", given.error_px, 0.0, limits::max_error_px);
  given.cast_every_pixel = spec.name == "raycast";
  if (!given.cast_every_pixel) {
    reader.number("planes", given.node_spacing.planes_px, 0.25, 64.0);
    reader.number("rows", given.node_spacing.rows_px, 0.25, 64.0);
  }
  const std::string problem = is_own_method(spec) ? reader.problem() : unknown_method(spec.name);
  if (problem.empty()) settings = given;
  return problem;
}

std::unique_ptr<Method> make_method(const MethodSpec& spec, std::string& problem) {
  problem.clear();
  const Entry* const entry = find(spec.name);
  if (entry == nullptr) {
    problem = unknown_method(spec.name);
    return nullptr;
  }
  if (entry->make == nullptr) {
    problem = spec.name + " is drawn by the module itself";
    return nullptr;
  }
  return entry->make(spec, problem);
}

std::string method_problem(const MethodSpec& spec) {
  FrameSettings settings;
  if (is_own_method(spec)) return apply_own_method(spec, settings);
  std::string problem;
  const bool made = make_method(spec, problem) != nullptr;
  const bool absent = problem.find("absent") != std::string::npos;
  return made || absent ? std::string{} : problem;
}

std::vector<std::string_view> method_names() {
  std::vector<std::string_view> names;
  for (const Entry& entry : entries) names.push_back(entry.name);
  return names;
}

}  // namespace ridgeline::sim
