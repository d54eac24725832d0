#include "tests/hard/patch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/support/geotiff_writer.hpp"

namespace ridgeline::test {
namespace {

constexpr double void_sample = -32767;

}  // namespace

Patch::Patch(const PatchShape& shape, PatchHeight height_m, std::vector<PatchPart> parts)
    : Land([](double, double) { return std::nan(""); }),
      shape_(shape),
      post_m_(std::move(height_m)) {
  if (parts.empty()) parts.push_back({0, 0, shape.rows, shape.columns});
  const double row_deg = 1 / shape.rows_a_degree, column_deg = 1 / shape.columns_a_degree;
  for (const PatchPart& part : parts) {
    GeotiffRecipe recipe;
    recipe.type = shape.type;
    recipe.no_data = void_sample;
    recipe.rows = part.rows;
    recipe.columns = part.columns;
    const double north_deg = latitude_deg(part.row + part.rows - 1);
    recipe.corner_and_steps = {longitude_deg(part.column) - 0.5 * column_deg,
                               column_deg,
                               0,
                               north_deg + 0.5 * row_deg,
                               0,
                               -row_deg};
    for (int r = part.row + part.rows - 1; r >= part.row; --r) {
      for (int c = part.column; c < part.column + part.columns; ++c) {
        const double post = post_m_(r, c);
        recipe.samples.push_back(std::isnan(post) ? void_sample : post);
      }
    }
    const std::string name = std::to_string(part.row) + "_" + std::to_string(part.column) + ".tif";
    write_geotiff(path() + "/" + name, recipe);
  }
}

double Patch::stored_m(int row, int column) const {
  const double post = post_m_(row, column);
  if (shape_.type == "Int16") return std::isnan(post) ? post : std::round(post);
  return static_cast<double>(static_cast<float>(post));
}

double Patch::surface_m(double row, double column) const {
  const int r = std::clamp(static_cast<int>(std::floor(row)), 0, shape_.rows - 2);
  const int c = std::clamp(static_cast<int>(std::floor(column)), 0, shape_.columns - 2);
  const double y = row - r, x = column - c;
  return (1 - y) * ((1 - x) * stored_m(r, c) + x * stored_m(r, c + 1)) +
         y * ((1 - x) * stored_m(r + 1, c) + x * stored_m(r + 1, c + 1));
}

}  // namespace ridgeline::test
