// Far ground from coarser levels, terrain that arrives and changes while flying: against the
// oracle.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <memory>

#include "platform/gl_counter.hpp"
#include "platform/heap_counter.hpp"
#include "tests/gl/scene.hpp"

namespace ridgeline::test {
namespace {

constexpr ImageGeometry small_image{200, 160, 60};
constexpr double mebibyte = 1024.0 * 1024.0;
constexpr int pixels = 300;

/// Hills without anything smaller than a kilometre, and one tower of 3 x 3 posts.
double hills_m(double latitude_deg, double longitude_deg) {
  const bool tower =
      std::abs(latitude_deg - 46.3) < 1.1 / 1200 && std::abs(longitude_deg - 8.6) < 1.1 / 1200;
  return 900 + 450 * std::sin(latitude_deg * 41) * std::cos(longitude_deg * 37) +
         160 * std::sin(latitude_deg * 173 + longitude_deg * 211) + (tower ? 90 : 0);
}

sim::SceneOptions options_for(double range_m, double gpu_bytes) {
  sim::SceneOptions options;
  options.settings.image = small_image;
  options.settings.range_m = range_m;
  options.terrain_gpu_bytes = gpu_bytes;
  return options;
}

/// Four 3" tiles of hills, in a window of several levels.
class Levels : public testing::Test {
 protected:
  static const Land& land() {
    static const std::unique_ptr<Land> made = [] {
      auto land = std::make_unique<Land>(hills_m);
      for (const int south : {45, 46}) {
        for (const int west : {8, 9}) land->add_tile(south, west);
      }
      return land;
    }();
    return *made;
  }
  static sim::SceneOptions options() { return options_for(60'000, 3 * mebibyte); }
  static Pose over(double latitude_deg, double longitude_deg, double height_m,
                   const Attitude& attitude) {
    return {{latitude_deg, longitude_deg, land().ground_m(latitude_deg, longitude_deg) + height_m},
            attitude};
  }
};

void expect_no_violation(const Scene& scene, std::size_t least_pixels) {
  const oracle::VerifySummary summary = scene.judged(pixels);
  std::string details;
  for (const std::string& line : summary.details) details += line + '\n';
  EXPECT_EQ(summary.violations(), 0U) << details;
  EXPECT_GE(summary.pixels, least_pixels);
  std::printf("[ oracle ] %zu pixels, %zu undecided, largest error %.3f px, %.3f of the bound\n",
              summary.pixels, summary.undecided, summary.error_max_px, summary.error_max_of_bound);
}

TEST_F(Levels, far_ground_is_drawn_within_the_bound_at_every_roll) {
  Scene scene(land(), options(), {46.0, 9.0, 2000});
  ASSERT_GE(scene.session().window().levels, 3);
  std::vector<Pose> poses;
  for (const double roll : {0.0, 11.0, 22.5, 45.0, 90.0, -157.0}) {
    poses.push_back(over(46.02, 8.97, 1500, {roll, -4, 300}));
  }
  poses.push_back(over(46.3, 8.6, 300, {0, 1, 140}));
  poses.push_back(over(45.7, 9.4, 6000, {0, -15, 250}));
  poses.push_back(over(45.7, 9.4, 18'000, {10, -30, 320}));
  expect_sound(scene, poses, pixels, 2);  // large pixels need large turns
}

TEST_F(Levels, what_they_cost_is_in_the_bound) {
  Scene scene(land(), options(), {46.0, 9.0, 2000});
  const sim::Picture picture = scene.shoot(over(46.02, 8.97, 1500, {0, -4, 300}));
  const FrameReport& report = picture.report;
  EXPECT_GT(report.budget.level_px, 0.0);
  EXPECT_GE(report.bound_px, report.budget.level_px + report.budget.geometry_px);
  EXPECT_LE(report.bound_px, 1.0);
  sim::SceneOptions fine = options();
  fine.terrain_gpu_bytes = 96 * mebibyte;
  Scene exact(land(), fine, {46.0, 9.0, 2000});
  EXPECT_EQ(exact.session().window().levels, 1);
  EXPECT_EQ(exact.shoot(over(46.02, 8.97, 1500, {0, -4, 300})).report.budget.level_px, 0.0);
}

TEST(RoughLevels, a_bound_that_cannot_be_kept_is_raised_and_still_true) {
  Land land([](double latitude, double longitude) { return 0.2 * rough_m(latitude, longitude); });
  land.add_tile(46, 8);
  Scene scene(land, options_for(30'000, 3 * mebibyte), {46.5, 8.5, 3000});
  ASSERT_GE(scene.session().window().levels, 2);
  double largest_px = 0;
  for (const double heading : {20.0, 160.0, 275.0}) {
    const sim::Picture picture = scene.shoot({{46.5, 8.5, 700}, {5, -3, heading}});
    largest_px = std::max(largest_px, picture.report.bound_px);
  }
  EXPECT_GT(largest_px, 1.0);
  expect_no_violation(scene, 3 * pixels);
}

TEST(RoughLevels, coarse_ground_too_steep_for_any_bound_ends_the_range) {
  Land land(rough_m);
  land.add_tile(46, 8);
  Scene scene(land, options_for(30'000, 3 * mebibyte), {46.5, 8.5, 3000});
  ASSERT_GE(scene.session().window().levels, 2);
  for (const double heading : {20.0, 160.0, 275.0}) {
    const FrameReport report = scene.shoot({{46.5, 8.5, 2300}, {5, -3, heading}}).report;
    EXPECT_LT(report.range_m, 30'000);
    EXPECT_EQ(report.availability.reasons[0], Reason::range_reduced);
  }
  expect_no_violation(scene, 3 * pixels);
}

TEST_F(Levels, a_jump_recovers_and_what_is_drawn_meanwhile_is_sound) {
  sim::SceneOptions o = options();
  o.arrival = sim::SceneOptions::Arrival::in_step;
  Scene scene(land(), o, {45.6, 8.5, 2000});
  EXPECT_LE(scene.shoot(over(45.6, 8.5, 1500, {0, -3, 40})).report.bound_px, 1.0);
  const Pose there = over(46.5, 9.5, 1500, {0, -3, 220});
  int frames = 0, short_of = 0, drawn = 0;
  for (; frames < 60; ++frames) {
    const FrameReport report = scene.shoot(there).report;
    const bool removed = report.availability.mode == Mode::removed;
    drawn += removed ? 0 : 1;
    if (!removed && report.window.complete) break;
    short_of += removed || report.bound_px > 1.0 || report.range_m < o.settings.range_m ? 1 : 0;
  }
  EXPECT_LT(frames, 60);
  EXPECT_GT(short_of, 0);
  EXPECT_GT(drawn, 1);
  EXPECT_LE(scene.shoot(there).report.bound_px, 1.0);
  expect_no_violation(scene, pixels);
}

/// A flight of 14 frames, from a start that is settled, one strip of blocks every other frame.
std::vector<sim::Picture> flown(Scene& scene) {
  std::vector<sim::Picture> pictures;
  for (int k = 0; k < 14; ++k) {
    const double longitude = 8.6 + 0.03 * k;
    pictures.push_back(scene.shoot({{45.9 + 0.008 * k, longitude, 2600}, {2.0 * k, -5, 70}}));
  }
  return pictures;
}

TEST_F(Levels, late_data_changes_no_bit_of_a_run_in_step) {
  sim::SceneOptions o = options();
  o.arrival = sim::SceneOptions::Arrival::in_step;
  Scene prompt(land(), o, {45.9, 8.6, 2600});
  o.read_delay_us = 3000;
  Scene late(land(), o, {45.9, 8.6, 2600});
  const auto a = flown(prompt), b = flown(late);
  int arrived = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].report.bound_px, b[k].report.bound_px) << k;
    EXPECT_EQ(a[k].report.window.blocks_arrived, b[k].report.window.blocks_arrived) << k;
    EXPECT_EQ(a[k].rgb, b[k].rgb) << k;
    EXPECT_TRUE(a[k].range_m.size() == b[k].range_m.size() &&
                std::memcmp(a[k].range_m.data(), b[k].range_m.data(),
                            a[k].range_m.size() * sizeof(float)) == 0)
        << k;
    arrived += a[k].report.window.blocks_arrived;
  }
  EXPECT_GT(arrived, 20);
}

TEST_F(Levels, a_slow_disk_never_makes_a_live_frame_wait_or_lie) {
  sim::SceneOptions o = options();
  o.arrival = sim::SceneOptions::Arrival::as_ready;
  o.read_delay_us = 2000;
  Scene scene(land(), o, {45.9, 8.6, 2600});
  int drawn = 0, loading = 0;
  for (int k = 0; k < 120; ++k) {
    const Pose pose{{45.9 + 0.001 * k, 8.6 + 0.002 * k, 2600}, {0, -5, 70}};
    const sim::Picture picture = k % 8 == 0 ? scene.shoot(pose) : scene.draw(pose);
    EXPECT_EQ(picture.take.wait_ms, 0.0);
    const bool removed = picture.report.availability.mode == Mode::removed;
    drawn += removed ? 0 : 1;
    loading += removed ? 1 : 0;
  }
  EXPECT_GT(loading, 0);
  EXPECT_GT(drawn, 10);
  expect_no_violation(scene, pixels);
}

TEST_F(Levels, a_peak_raised_in_flight_stands_in_the_very_next_frame) {
  TemporaryFolder folder;
  const std::string file = folder.file("edits.txt");
  // 7 x 7 posts 12 km ahead; later a void, and a peak far away in the coarsest level.
  std::ofstream(file) << "10 46.0 9.15 3 3 7 7 fill 3900\n"
                         "12 46.0 9.15 3 3 3 7 fill void\n"
                         "14 46.05 9.55 3 3 5 5 fill 2000\n";
  sim::SceneOptions o = options_for(60'000, 8 * mebibyte);
  o.edit_file = file;
  Scene scene(land(), o, {46.0, 9.0, 2000});
  const Pose pose = over(46.0, 9.0, 1200, {0, 0, 88});
  const GeodeticPosition peak{46.0025, 9.1525, 3900};
  const ImagePlace place =
      image_place(pose, small_image, {peak.latitude_deg, peak.longitude_deg, 3700});
  const auto at = static_cast<std::size_t>(place.v_px) * small_image.width_px +
                  static_cast<std::size_t>(place.u_px);
  const sim::Picture before = scene.shoot(pose, 9.99), after = scene.shoot(pose, 10.0);
  for (const sim::Picture* picture : {&before, &after}) {
    ASSERT_NE(picture->report.availability.mode, Mode::removed)
        << reason_word(*picture->report.availability.reasons.begin());
  }
  EXPECT_TRUE(std::isinf(before.range_m[at]));
  EXPECT_NEAR(static_cast<double>(after.range_m[at]), place.distance_m, 400.0);
  scene.shoot(pose, 12.0);
  scene.shoot(pose, 14.5);
  expect_no_violation(scene, 4 * pixels);
}

/// Kilobytes of memory of this process that no file stands behind.
long anonymous_kib() {
  std::ifstream status("/proc/self/status");
  const std::string name = "RssAnon:";
  for (std::string line; std::getline(status, line);) {
    if (line.rfind(name, 0) == 0) return std::stol(line.substr(name.size()));
  }
  return 0;
}

TEST_F(Levels, ten_minutes_at_250_m_per_s_allocate_nothing_and_create_no_gl_object) {
  sim::SceneOptions o = options_for(25'000, 3 * mebibyte);
  o.settings.image = {64, 48, 60};
  o.arrival = sim::SceneOptions::Arrival::in_step;
  const GeodeticPosition start{45.25, 8.3, 3000};
  Scene scene(land(), o, start);
  ASSERT_GE(scene.session().window().levels, 2);
  ASSERT_GT(heap_allocations_seen(), 1000U);  // both counters are linked in and count
  ASSERT_GT(gl_creations_seen(), 20U);
  std::uint64_t blocks = 0;
  long after_a_minute_kib = 0;
  for (int second = 0; second < 600; ++second) {
    // 250 m/s to the north-east: 1.5 degrees of latitude in all would be 167 km; this is 150 km.
    FrameInput input;
    input.time_ns = second * 1'000'000'000LL;
    input.eye = {start.latitude_deg + 0.00159 * second, start.longitude_deg + 0.00227 * second,
                 3000};
    input.attitude = {0, -5, 45};
    const sim::Picture picture = scene.session().draw(input, false);
    ASSERT_EQ(heap_allocations_counted(), 0U) << "in second " << second;
    ASSERT_EQ(gl_creations_counted(), 0U) << "in second " << second;
    ASSERT_NE(picture.report.availability.mode, Mode::removed) << second;
    blocks += static_cast<std::uint64_t>(picture.report.window.blocks_arrived);
    if (second == 60) after_a_minute_kib = anonymous_kib();
  }
  EXPECT_GT(blocks, 300U);  // the window has moved on all the way
  EXPECT_LT(anonymous_kib(), after_a_minute_kib + 2048);
}

// --- hard places, in windows of one and of several levels ---------------------------------------

class HardPlaces : public testing::TestWithParam<double> {
 protected:
  void expect_sound_at(const Land& land, const std::vector<Pose>& poses, double range_m,
                       int may_lack_bound = 0) {
    Scene scene(land, options_for(range_m, GetParam() * mebibyte), poses.front().eye);
    expect_sound(scene, poses, pixels, may_lack_bound);
  }
};

/// Ground on which seams of different steps keep a bound when they are looked down at.
double gentle_m(double latitude_deg, double longitude_deg) {
  return 0.25 * hills_m(latitude_deg, longitude_deg);
}

TEST_P(HardPlaces, a_seam_of_steps_in_steep_ground_below_has_no_bound) {
  Land land(hills_m);
  land.add_tile(46, 8, 3601);
  land.add_tile(46, 9);
  Scene scene(land, options_for(15'000, GetParam() * mebibyte), {46.5, 9.0, 3000});
  const FrameReport report = scene.draw({{46.5, 9.0, 3000}, {0, -20, 0}}).report;
  EXPECT_EQ(report.availability.mode, Mode::removed);
  EXPECT_EQ(report.availability.reasons[0], Reason::no_bound);
}

TEST_P(HardPlaces, one_arc_second_beside_three) {
  Land land(gentle_m);
  land.add_tile(46, 8, 3601);
  land.add_tile(46, 9);
  expect_sound_at(land,
                  {{{46.5, 8.97, 2500}, {0, -6, 90}},
                   {{46.5, 9.02, 2500}, {15, -6, 275}},
                   {{46.5, 9.0, 3000}, {0, -20, 0}}},
                  15'000);
}

TEST_P(HardPlaces, seams_that_disagree_by_150_m) {
  auto offset = std::make_shared<double>(0.0);
  Land land([offset](double latitude_deg, double longitude_deg) {
    return hills_m(latitude_deg, longitude_deg) + *offset;
  });
  land.add_tile(46, 8);
  *offset = 150;
  land.add_tile(46, 9);
  expect_sound_at(land,
                  {{{46.5, 8.93, 2600}, {0, -8, 90}},
                   {{46.4, 9.06, 2600}, {0, -8, 270}},
                   {{46.5, 9.0, 2500}, {0, -5, 180}}},
                  20'000);
}

TEST_P(HardPlaces, greenwich_and_the_equator) {
  Land land(hills_m);
  for (const int south : {-1, 0}) {
    for (const int west : {-1, 0}) land.add_tile(south, west);
  }
  expect_sound_at(land,
                  {{{0.0, 0.0, 2500}, {0, -6, 45}},
                   {{0.01, -0.02, 2500}, {0, -6, 135}},
                   {{-0.03, 0.02, 2500}, {-20, -6, 300}}},
                  25'000);
}

TEST_P(HardPlaces, dted_zones_that_share_no_multiple) {
  Land land(gentle_m);
  land.add_dted(69, 20);  // 6" of longitude
  land.add_dted(70, 20);  // 9"
  expect_sound_at(land,
                  {{{69.97, 20.5, 2500}, {0, -6, 10}},
                   {{70.02, 20.4, 2500}, {0, -6, 170}},
                   {{70.0, 20.6, 2500}, {8, -6, 280}}},
                  12'000);
}

TEST_P(HardPlaces, below_sea_level) {
  Land land([](double latitude_deg, double longitude_deg) {
    return 0.2 * (hills_m(latitude_deg, longitude_deg) - 900) - 330;
  });
  land.add_tile(31, 35);
  expect_sound_at(land, {{{31.5, 35.5, -150}, {0, -2, 30}}, {{31.4, 35.6, 400}, {0, -12, 200}}},
                  20'000);
}

INSTANTIATE_TEST_SUITE_P(WindowMebibytes, HardPlaces, testing::Values(96.0, 2.0));

}  // namespace
}  // namespace ridgeline::test
