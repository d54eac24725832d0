#include "sim/synthetic/hash_noise.hpp"

#include <array>
#include <cmath>

namespace ridgeline::sim {
namespace {

struct Slope {
  double x;
  double y;
};

// Sixteen directions from 5-12-13 and 3-4-5 triangles: exact in binary up to one division.
constexpr std::array<Slope, 16> slopes = {{
    {1, 0},
    {0.8, 0.6},
    {0.6, 0.8},
    {5.0 / 13, 12.0 / 13},
    {0, 1},
    {-5.0 / 13, 12.0 / 13},
    {-0.6, 0.8},
    {-0.8, 0.6},
    {-1, 0},
    {-0.8, -0.6},
    {-0.6, -0.8},
    {-5.0 / 13, -12.0 / 13},
    {0, -1},
    {5.0 / 13, -12.0 / 13},
    {0.6, -0.8},
    {0.8, -0.6},
}};

double fade(double t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}

double mix(double a, double b, double t) {
  return a + (b - a) * t;
}

double corner(std::int64_t column, std::int64_t row, double dx, double dy, std::uint64_t seed) {
  const Slope slope = slopes[lattice_hash(column, row, seed) >> 60];
  return slope.x * dx + slope.y * dy;
}

}  // namespace

std::uint64_t lattice_hash(std::int64_t column, std::int64_t row, std::uint64_t seed) {
  std::uint64_t bits = seed;
  bits += static_cast<std::uint64_t>(column) * 0x9e3779b97f4a7c15ULL;
  bits ^= bits >> 32;
  bits *= 0xd6e8feb86659fd93ULL;
  bits += static_cast<std::uint64_t>(row) * 0xc2b2ae3d27d4eb4fULL;
  bits ^= bits >> 32;
  bits *= 0xd6e8feb86659fd93ULL;
  bits ^= bits >> 32;
  bits *= 0xd6e8feb86659fd93ULL;
  return bits ^ (bits >> 32);
}

double gradient_noise(double x, double y, std::uint64_t seed) {
  const double column = std::floor(x);
  const double row = std::floor(y);
  const double dx = x - column;
  const double dy = y - row;
  const auto c = static_cast<std::int64_t>(column);
  const auto r = static_cast<std::int64_t>(row);
  const double u = fade(dx);
  const double south = mix(corner(c, r, dx, dy, seed), corner(c + 1, r, dx - 1, dy, seed), u);
  const double north =
      mix(corner(c, r + 1, dx, dy - 1, seed), corner(c + 1, r + 1, dx - 1, dy - 1, seed), u);
  return 1.4 * mix(south, north, fade(dy));
}

double fractal_noise(double x, double y, int octaves, std::uint64_t seed) {
  double sum = 0;
  double amplitude = 0.5;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += amplitude * gradient_noise(x, y, seed + static_cast<std::uint64_t>(octave));
    amplitude *= 0.5;
    x *= 2;
    y *= 2;
  }
  return sum;
}

double ridged_noise(double x, double y, int octaves, std::uint64_t seed) {
  double sum = 0;
  double amplitude = 0.5;
  double weight = 1;
  for (int octave = 0; octave < octaves; ++octave) {
    const double crest =
        1 - std::fabs(gradient_noise(x, y, seed + static_cast<std::uint64_t>(octave)));
    const double signal = crest * crest * weight;
    sum += amplitude * signal;
    weight = signal;
    amplitude *= 0.5;
    x *= 2;
    y *= 2;
  }
  return sum;
}

}  // namespace ridgeline::sim
