#pragma once
#include <cstddef>
#include <functional>
#include <iosfwd>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "tests/oracle/verify.hpp"
#include "tests/unit/oracle/scenes.hpp"

/// A folder of terrain, frames drawn over it and spoiled, and the word of a whole run on them.
namespace ridgeline::oracle::scenes {

inline constexpr float sky = std::numeric_limits<float>::infinity();
inline constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

/// One 3" tile at 46 N 8 E.
class VerifiedScene {
 public:
  explicit VerifiedScene(const Surface& surface);

  [[nodiscard]] Frame drawn(const Shot& shot) const { return scenes::drawn(*truth_, shot); }
  [[nodiscard]] const Terrain& truth() const { return *truth_; }

  [[nodiscard]] VerifySummary verified(const Frame& frame, int threads = 2, int pixels = 400) const;
  /// The same with any options, which get their folders here.
  [[nodiscard]] VerifySummary verified(const std::vector<Frame>& frames, VerifyOptions& options,
                                       std::ostream* told = nullptr) const;

 private:
  TemporaryFolder terrain_;
  std::optional<Terrain> truth_;
};

/// Mountains with a void island in them, and a view of it.
[[nodiscard]] const VerifiedScene& mountain_scene();
[[nodiscard]] Shot mountain_shot();

/// A plain at 500 m with a large void in it.
[[nodiscard]] double plain_with_void(double lat_deg, double lon_deg);

[[nodiscard]] std::string report(const VerifySummary& summary);

/// The frame whose pixel (u, v) shows what `frame` shows at (u + du, v + dv).
[[nodiscard]] Frame shifted(const Frame& frame, int du, int dv);
[[nodiscard]] Frame changed(const Frame& frame, const std::function<float(float)>& change);
[[nodiscard]] std::size_t count(const Frame& frame, const std::function<bool(float)>& is);

}  // namespace ridgeline::oracle::scenes
