#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/import_igc/igc_track.hpp"
#include "sim/import_igc/smoothing_spline.hpp"

namespace ridgeline {

/// Geoid undulation N (m) at a latitude and longitude (deg), or nothing where it is not known.
using GeoidUndulation = std::function<std::optional<double>(double, double)>;

/// Numbers of the derivation; every one ends up in the log's labels or in docs/icd.md.
struct DerivationRules {
  double smoothing_s3 = 1.0;         ///< of the spline, see SmoothingSpline
  double angle_of_attack_deg = 2.0;  ///< added to the flight path angle
  double roll_limit_deg = 60.0;      ///< of the derived roll
  double pitch_limit_deg = 30.0;     ///< of the derived pitch
  double heading_rate_limit_dps = 60.0;
  double heading_speed_mps = 3.0;    ///< below it the track says nothing and the heading is held
  double full_roll_speed_mps = 6.0;  ///< below it the derived roll fades to 0 at heading_speed_mps
};

/// Which recorded angles are used, and with which sign; 0 means derived instead.
struct RecordedSigns {
  int roll = 0;
  int pitch = 0;
  bool heading = false;
  double roll_correlation = 0.0;   ///< of recorded with derived roll
  double pitch_correlation = 0.0;  ///< of recorded with derived pitch
};

/// Flight state at one time.
struct FlightPoint {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double height_m = 0.0;  ///< above the ellipsoid
  double ground_speed_mps = 0.0;
  double track_deg = 0.0;  ///< true
  double climb_mps = 0.0;
  double roll_deg = 0.0;   ///< derived, right positive
  double pitch_deg = 0.0;  ///< derived, nose up positive
};

/// One unbroken piece of a track as a smooth flight.
class DerivedFlight {
 public:
  /// Domain: at least 4 fixes, ascending in time; heights[i] is the height above the ellipsoid of
  /// fix i.
  DerivedFlight(std::span<const IgcFix> fixes, std::span<const double> heights_m,
                const DerivationRules& rules);

  /// State at a time of the fixes' clock: position, velocity and acceleration from the spline
  /// (ECEF), roll from the acceleration across the track, tan(roll) = V * track rate / g, pitch
  /// from the flight path angle.
  [[nodiscard]] FlightPoint at(double time_s) const;

  [[nodiscard]] double first_time_s() const { return spline_.first_time_s(); }
  [[nodiscard]] double last_time_s() const { return spline_.last_time_s(); }

 private:
  DerivationRules rules_;
  std::array<double, 3> origin_m_{};
  SmoothingSpline spline_;
};

/// An angle recorded with the fixes, linear between them (the shorter way round); nothing where
/// either neighbour lacks it. `time_s` within the fixes.
[[nodiscard]] std::optional<double> recorded_angle(std::span<const IgcFix> fixes,
                                                   std::optional<double> IgcFix::*angle,
                                                   double time_s);

/// The IGC format names AOR and AOP but not their signs, and recorders differ. Recorded angles are
/// used if they correlate with the derived ones by more than 0.5 either way, with the sign of that
/// correlation.
[[nodiscard]] RecordedSigns recorded_signs(std::span<const IgcFix> fixes,
                                           const std::vector<DerivedFlight>& flights);

/// True heading that follows the track: held below heading_speed_mps, never turning faster than the
/// limit.
class HeadingFollower {
 public:
  HeadingFollower(const DerivationRules& rules, double first_heading_deg)
      : rules_(rules), heading_deg_(first_heading_deg) {}
  /// Heading after `step_s` more; [-180, 180).
  [[nodiscard]] double next(const FlightPoint& point, double step_s);

 private:
  DerivationRules rules_;
  double heading_deg_;
};

/// The first track that says something at or after `time_s`: the heading to stand with until then;
/// 0 when the flight never moves. Sampled every second.
[[nodiscard]] double first_heading_deg(const DerivedFlight& flight, double time_s,
                                       const DerivationRules& rules);

}  // namespace ridgeline
