#include "sim/import_igc/igc_track.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fstream>
#include <numbers>
#include <system_error>

namespace ridgeline {
namespace {

constexpr std::size_t shortest_fix = 35;
constexpr std::size_t longest_line = 1000;
constexpr std::size_t most_problems = 10;
constexpr double day_s = 86400.0;
/// Faster than any flight these recorders are carried on; what exceeds it is a bad fix.
constexpr double spike_speed_mps = 250.0;
constexpr double spike_climb_mps = 120.0;
/// A jump that lasts this many fixes is where the aircraft now is.
constexpr int spikes_believed = 5;

/// Columns of one extension in a B record; zero length when absent.
struct Columns {
  std::size_t start = 0;
  std::size_t length = 0;
};

struct Extensions {
  Columns lad, lod, hdt, aor, aop;
};

/// Decimal digits, with a sign where allowed; nothing for any other character.
std::optional<int> number(std::string_view text, bool is_signed = false) {
  const bool negative = is_signed && !text.empty() && text.front() == '-';
  if (negative || (is_signed && !text.empty() && text.front() == '+')) text.remove_prefix(1);
  if (text.empty() || text.size() > 9) return std::nullopt;
  int value = 0;
  for (const char c : text) {
    if (c < '0' || c > '9') return std::nullopt;
    value = value * 10 + (c - '0');
  }
  return negative ? -value : value;
}

std::string_view columns_of(std::string_view line, const Columns& columns) {
  if (columns.length == 0 || columns.start + columns.length > line.size()) return {};
  return line.substr(columns.start, columns.length);
}

/// "I" + count + per extension: first and last column (from 1) and a three-letter code.
bool read_extensions(std::string_view line, Extensions& extensions) {
  const std::optional<int> count = number(line.substr(1, 2));
  if (!count || line.size() < 3 + 7 * static_cast<std::size_t>(*count)) return false;
  extensions = Extensions{};
  for (int index = 0; index < *count; ++index) {
    const std::string_view entry = line.substr(3 + 7 * static_cast<std::size_t>(index), 7);
    const std::optional<int> first = number(entry.substr(0, 2));
    const std::optional<int> last = number(entry.substr(2, 2));
    if (!first || !last || *first <= static_cast<int>(shortest_fix) || *last < *first) return false;
    const Columns columns{static_cast<std::size_t>(*first - 1),
                          static_cast<std::size_t>(*last - *first + 1)};
    const std::string_view code = entry.substr(4, 3);
    if (code == "LAD") extensions.lad = columns;
    if (code == "LOD") extensions.lod = columns;
    if (code == "HDT") extensions.hdt = columns;
    if (code == "AOR") extensions.aor = columns;
    if (code == "AOP") extensions.aop = columns;
  }
  return true;
}

/// DDMMmmm or DDDMMmmm with its hemisphere and further digits of the minute.
std::optional<double> angle_deg(std::string_view digits, char hemisphere, std::string_view positive,
                                std::string_view more_digits, double limit_deg) {
  const std::size_t degree_digits = digits.size() - 5;
  const std::optional<int> degrees = number(digits.substr(0, degree_digits));
  const std::optional<int> milliminutes = number(digits.substr(degree_digits));
  if (!degrees || !milliminutes || *milliminutes >= 60000) return std::nullopt;
  double minutes = *milliminutes / 1000.0;
  if (const std::optional<int> more = number(more_digits)) {
    minutes += *more * std::pow(10.0, -3.0 - static_cast<double>(more_digits.size()));
  }
  const double angle = *degrees + minutes / 60.0;
  if (angle > limit_deg) return std::nullopt;
  if (hemisphere == positive[0]) return angle;
  if (hemisphere == positive[1]) return -angle;
  return std::nullopt;
}

/// The first six digits in a row, as DDMMYY; both forms of the date record have them first.
std::optional<std::int64_t> day_ns_of(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size() && (text[at] < '0' || text[at] > '9')) ++at;
  if (at + 6 > text.size()) return std::nullopt;
  const std::optional<int> day = number(text.substr(at, 2));
  const std::optional<int> month = number(text.substr(at + 2, 2));
  const std::optional<int> year = number(text.substr(at + 4, 2));
  if (!day || !month || !year) return std::nullopt;
  const int full_year = *year + (*year < 80 ? 2000 : 1900);
  const std::chrono::year_month_day date{std::chrono::year{full_year},
                                         std::chrono::month{static_cast<unsigned>(*month)},
                                         std::chrono::day{static_cast<unsigned>(*day)}};
  if (!date.ok()) return std::nullopt;
  const auto since_1970 = std::chrono::sys_days(date).time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(since_1970).count();
}

class TrackReader {
 public:
  explicit TrackReader(std::string name) : name_(std::move(name)) {}

  void take_line(std::string_view line) {
    ++track_.counters.lines;
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
    if (line.size() > longest_line) return refuse("line is longer than any record");
    const char record = line.empty() ? ' ' : line.front();
    if (record == 'B') return take_fix(line);
    if (record == 'I' && !(line.size() >= 3 && read_extensions(line, extensions_))) {
      return refuse("extension record cannot be read");
    }
    if (record == 'H') take_header(line);
    ++track_.counters.other_lines;
  }

  Result<IgcTrack> track() && {
    if (track_.fixes.empty()) return Fault::track_without_fixes;
    bool has_height = false;
    for (const IgcFix& fix : track_.fixes) has_height = has_height || fix.altitude_m != 0.0;
    if (!has_height) return Fault::track_without_height;
    return std::move(track_);
  }

 private:
  void refuse(std::string_view why) {
    ++track_.counters.bad_lines;
    if (track_.problems.size() >= most_problems) return;
    track_.problems.push_back(name_ + ":" + std::to_string(track_.counters.lines) + ": " +
                              std::string(why));
  }

  void take_header(std::string_view line) {
    const std::string_view subject = line.size() >= 5 ? line.substr(2, 3) : std::string_view{};
    if (subject == "DTE" && !track_.has_date) {
      if (const std::optional<std::int64_t> day_ns = day_ns_of(line.substr(5))) {
        track_.day_ns = *day_ns;
        track_.has_date = true;
      }
    }
    if (subject == "ALG") {
      if (line.find("GEO") != std::string_view::npos) track_.altitude_is_msl = true;
      if (line.find("ELL") != std::string_view::npos) track_.altitude_is_msl = false;
    }
  }

  void take_fix(std::string_view line) {
    if (line.size() < shortest_fix) return refuse("fix is shorter than 35 characters");
    const std::optional<int> hour = number(line.substr(1, 2));
    const std::optional<int> minute = number(line.substr(3, 2));
    const std::optional<int> second = number(line.substr(5, 2));
    if (!hour || !minute || !second || *hour > 23 || *minute > 59 || *second > 60) {
      return refuse("time of the fix is not HHMMSS");
    }
    const std::optional<double> latitude =
        angle_deg(line.substr(7, 7), line[14], "NS", columns_of(line, extensions_.lad), 90.0);
    const std::optional<double> longitude =
        angle_deg(line.substr(15, 8), line[23], "EW", columns_of(line, extensions_.lod), 180.0);
    if (!latitude) return refuse("latitude of the fix is not DDMMmmmN/S");
    if (!longitude) return refuse("longitude of the fix is not DDDMMmmmE/W");
    if (line[24] != 'A' && line[24] != 'V') return refuse("validity of the fix is neither A nor V");
    const std::optional<int> altitude = number(line.substr(30, 5), true);
    if (!altitude) return refuse("GNSS altitude of the fix is not a number");
    if (line[24] == 'V') {
      ++track_.counters.flat_fixes;
      return;
    }
    IgcFix fix;
    fix.time_s = 3600.0 * *hour + 60.0 * *minute + *second;
    fix.latitude_deg = *latitude;
    fix.longitude_deg = *longitude;
    fix.altitude_m = *altitude;
    fix.roll_deg = optional_angle(line, extensions_.aor);
    fix.pitch_deg = optional_angle(line, extensions_.aop);
    fix.heading_deg = optional_angle(line, extensions_.hdt);
    take_in_time(fix);
  }

  static std::optional<double> optional_angle(std::string_view line, const Columns& columns) {
    const std::optional<int> value = number(columns_of(line, columns), true);
    if (!value || std::abs(*value) > 360) return std::nullopt;
    return static_cast<double>(*value);
  }

  void take_in_time(IgcFix fix) {
    if (!track_.fixes.empty()) {
      fix.time_s += day_offset_s_;
      const double previous_s = track_.fixes.back().time_s;
      if (fix.time_s < previous_s - day_s / 2.0) {
        day_offset_s_ += day_s;
        fix.time_s += day_s;
      }
      if (fix.time_s <= previous_s) {
        ++track_.counters.time_refused;
        return;
      }
      if (is_spike(track_.fixes.back(), fix)) {
        if (++spikes_in_a_row_ < spikes_believed) {
          ++track_.counters.spikes;
          return;
        }
        fix.starts_segment = true;
      }
    }
    spikes_in_a_row_ = 0;
    ++track_.counters.fixes;
    track_.fixes.push_back(fix);
  }

  static bool is_spike(const IgcFix& a, const IgcFix& b) {
    constexpr double metres_per_degree = 111320.0;
    const double elapsed_s = b.time_s - a.time_s;
    const double north_m = (b.latitude_deg - a.latitude_deg) * metres_per_degree;
    const double east_m = std::remainder(b.longitude_deg - a.longitude_deg, 360.0) *
                          metres_per_degree * std::cos(a.latitude_deg * std::numbers::pi / 180.0);
    return std::hypot(north_m, east_m) > spike_speed_mps * elapsed_s ||
           std::abs(b.altitude_m - a.altitude_m) > spike_climb_mps * elapsed_s;
  }

  std::string name_;
  IgcTrack track_;
  Extensions extensions_;
  double day_offset_s_ = 0.0;
  int spikes_in_a_row_ = 0;
};

}  // namespace

Result<IgcTrack> igc_track(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return Fault::file_unreadable;
  std::ifstream file(path, std::ios::binary);
  if (!file) return Fault::file_unreadable;
  TrackReader reader(path.string());
  for (std::string line; std::getline(file, line);) reader.take_line(line);
  if (file.bad()) return Fault::file_unreadable;
  return std::move(reader).track();
}

Result<IgcTrack> igc_track_in(std::string_view text, const std::string& name) {
  TrackReader reader(name);
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    reader.take_line(line);
    text.remove_prefix(std::min(line.size() + 1, text.size()));
  }
  return std::move(reader).track();
}

}  // namespace ridgeline
