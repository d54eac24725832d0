#pragma once
#include <cmath>
#include <cstdio>
#include <string>

/// IGC records for the tests, made from numbers.
namespace ridgeline::testing {

inline std::string angle_text(double angle_deg, int degree_digits, char positive, char negative) {
  const double magnitude = std::abs(angle_deg);
  long milliminutes = std::lround(magnitude * 60000.0);
  char text[32];
  std::snprintf(text, sizeof text, "%0*ld%05ld%c", degree_digits, milliminutes / 60000,
                milliminutes % 60000, angle_deg < 0.0 ? negative : positive);
  return text;
}

/// A B record; `extension` follows the 35 fixed columns.
inline std::string fix_text(int time_s, double latitude_deg, double longitude_deg,
                            double altitude_m, const std::string& extension = "",
                            char validity = 'A') {
  char text[64];
  std::snprintf(text, sizeof text, "B%02d%02d%02d", time_s / 3600 % 24, time_s / 60 % 60,
                time_s % 60);
  std::string line = text;
  line += angle_text(latitude_deg, 2, 'N', 'S') + angle_text(longitude_deg, 3, 'E', 'W');
  std::snprintf(text, sizeof text, "%c%05ld%05ld", validity, std::lround(altitude_m),
                std::lround(altitude_m));
  return line + text + extension + "\r\n";
}

}  // namespace ridgeline::testing
