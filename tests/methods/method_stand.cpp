#include "tests/methods/method_stand.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

namespace ridgeline::test {

MethodStand::MethodStand(const Land& land, const ImageGeometry& image, double range_m,
                         const GeodeticPosition& first)
    : image_(image), scene_(land, image, 1.0, range_m, first), judge_(land.path()) {}

sim::Method& MethodStand::use(const std::string& spec) {
  sim::MethodSpec parsed;
  EXPECT_TRUE(sim::parse_method(spec, parsed).ok()) << spec;
  std::string problem;
  auto method = sim::make_method(parsed, problem);
  EXPECT_EQ(problem, "");
  return use(std::move(method));
}

sim::Method& MethodStand::use(std::unique_ptr<sim::Method> method) {
  sim::Method& kept = scene_.session().keep(std::move(method));
  scene_.session().use(&kept);
  return kept;
}

sim::Picture MethodStand::draw(const Pose& pose) {
  sim::Picture picture = scene_.draw(pose);
  EXPECT_TRUE(picture.problem.ok()) << picture.problem.message;
  EXPECT_NE(picture.report.availability.mode, Mode::removed);
  return picture;
}

JudgedPicture MethodStand::judge(const sim::Picture& picture, double claim_px) const {
  const PixelSet sample{0, 0, image_.width_px, image_.height_px, 3};
  return judge_.judge(picture, sample, claim_px);
}

std::vector<std::uint32_t> bits_of(const sim::Picture& picture) {
  std::vector<std::uint32_t> words;
  for (const float z : picture.range_m) words.push_back(std::bit_cast<std::uint32_t>(z));
  return words;
}

void expect_all_written(const sim::Picture& picture, double range_m) {
  for (const double z : picture.range_m) {
    EXPECT_TRUE(std::isnan(z) || std::isinf(z) || (z > 0 && z <= 1.0001 * range_m)) << z;
  }
}

UnknownCount count_unknown(const sim::Picture& ours, const sim::Picture& other) {
  UnknownCount count;
  for (std::size_t i = 0; i < ours.range_m.size(); ++i) {
    const bool here = std::isnan(ours.range_m[i]), there = std::isnan(other.range_m[i]);
    count.unknown += here ? 1 : 0;
    count.lost += here && !there ? 1 : 0;
    count.invented += there && !here ? 1 : 0;
  }
  return count;
}

double smooth_m(double latitude_deg, double longitude_deg) {
  return 500 + 180 * std::sin(latitude_deg * 130) * std::cos(longitude_deg * 110) +
         120 * std::sin(latitude_deg * 57 + longitude_deg * 71);
}

double plain_with_hole_m(double latitude_deg, double longitude_deg) {
  const bool hole = std::abs(latitude_deg - 46.5) < 0.02 && std::abs(longitude_deg - 8.5) < 0.03;
  return hole ? std::nan("") : 300 + 20 * std::sin(latitude_deg * 500);
}

}  // namespace ridgeline::test
