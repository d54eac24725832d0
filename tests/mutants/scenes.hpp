#pragma once
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/session/session.hpp"

namespace ridgeline::test {

struct ScenePose {
  GeodeticPosition eye;
  Attitude attitude;
  double time_s = 0;
};

/// Tiles, and files beside them, that several scenes share.
struct DesignedLand {
  std::string_view name;
  std::function<void(const std::string& folder)> write;  ///< into an empty folder
};

/// A view made to show one weakness, and small enough to judge all of it or a good part.
struct DesignedScene {
  std::string_view name;
  std::string_view shows;  ///< what it is made for, in a few words
  DesignedLand land;
  sim::SceneOptions options;     ///< geoid and edits by their names in the land's folder
  std::vector<ScenePose> poses;  ///< drawn in this order by one session
  int pixels = 7000;             ///< judged of each frame, half of them at jumps of distance
  std::size_t removed = 0;       ///< frames for which there is no terrain yet
};

[[nodiscard]] const std::vector<DesignedScene>& designed_scenes();
/// Null where there is none of that name.
[[nodiscard]] const DesignedScene* find_scene(std::string_view name);

}  // namespace ridgeline::test
