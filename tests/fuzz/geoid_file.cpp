// Geoid files, read by the display and by the oracle. An input is what to ask (1 + 4 bytes), then
// the bytes of a PGM file or, where the first byte says so, of a GTX grid; the counts of a grid may
// be made to fit.
#include "platform/geoid_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/geo/geoid.hpp"
#include "tests/fuzz/input_bytes.hpp"
#include "tests/fuzz/property.hpp"
#include "tests/oracle/geoid.hpp"
#include "tests/oracle/input_error.hpp"

using namespace ridgeline;
using ridgeline::fuzz::InputBytes;
using ridgeline::fuzz::must;

namespace {

constexpr std::size_t gtx_header_bytes = 40;

/// Makes the counts of a GTX header those of the posts behind it.
void fit_counts(std::string& bytes, std::size_t rows) {
  if (bytes.size() < gtx_header_bytes + 4 * rows) return;
  const std::size_t columns = (bytes.size() - gtx_header_bytes) / 4 / rows;
  bytes.resize(gtx_header_bytes + 4 * rows * columns);
  bytes.replace(32, 8, 8, '\0');
  bytes[35] = static_cast<char>(rows);
  bytes[38] = static_cast<char>(columns >> 8U);
  bytes[39] = static_cast<char>(columns);
}

struct Range {
  double low_m = std::numeric_limits<double>::infinity();
  double high_m = -std::numeric_limits<double>::infinity();
};

Range check_grid(const GeoidGrid& grid) {
  must(grid.rows >= 2 && grid.columns >= 2 &&
           grid.posts_m.size() ==
               static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.columns),
       "a geoid has its posts");
  must(grid.latitude_step_deg > 0 && grid.longitude_step_deg > 0 && grid.south_deg >= -90,
       "a geoid has steps and a place");
  Range range;
  for (const float post_m : grid.posts_m) {
    if (std::isnan(post_m)) continue;
    must(std::abs(post_m) <= 200, "an undulation is one of the Earth's");
    range.low_m = std::min(range.low_m, static_cast<double>(post_m));
    range.high_m = std::max(range.high_m, static_cast<double>(post_m));
  }
  return range;
}

void check_place(const GeoidGrid& grid, const Range& range, const oracle::Geoid& truth,
                 double latitude_deg, double longitude_deg) {
  constexpr double rounding_m = 1e-3;
  const double n_m = undulation_m(grid, latitude_deg, longitude_deg);
  must(std::isnan(undulation_m(grid, 90.5 + latitude_deg * latitude_deg, longitude_deg)),
       "beyond a pole there is no undulation");
  if (std::isnan(n_m)) return;
  must(n_m >= range.low_m - rounding_m && n_m <= range.high_m + rounding_m,
       "an undulation lies between the posts");
  const double true_m = truth.at(latitude_deg, longitude_deg);
  must(std::abs(true_m - n_m) <= rounding_m, "the oracle has the same undulation");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  InputBytes input(data, size);
  const std::uint8_t what = input.u8();
  const double latitude_deg = (input.u16() % 1441) / 8.0 - 90.0;
  const double longitude_deg = static_cast<std::int16_t>(input.u16()) / 64.0;
  const bool is_gtx = (what & 1U) != 0;
  const std::string path = is_gtx ? "geoid.gtx" : "geoid.pgm";
  std::string bytes(input.text());
  if (is_gtx && (what & 2U) != 0) fit_counts(bytes, 2U + (what >> 4U));
  const FileResult<GeoidFile> file = geoid_in(path, std::as_bytes(std::span(bytes)));
  if (!file.ok()) {
    must(file.problem().message.starts_with(path + ": "), "a message names its file");
    must(file.problem().fault == Fault::geoid_corrupt ||
             file.problem().fault == Fault::geoid_unreadable,
         "a geoid is refused as one");
    return 0;
  }
  const GeoidGrid grid = file.value().grid();
  const Range range = check_grid(grid);
  try {
    const oracle::Geoid truth = oracle::Geoid::in(path, bytes);
    check_place(grid, range, truth, latitude_deg, longitude_deg);
    check_place(grid, range, truth, grid.south_deg + 0.25 * grid.latitude_step_deg,
                grid.west_deg + 0.75 * grid.longitude_step_deg);
  } catch (const oracle::InputError&) {
    must(false, "the oracle reads what the display reads");
  }
  return 0;
}
