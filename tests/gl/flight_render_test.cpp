#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <numeric>

#include "platform/display/frame_dump.hpp"
#include "platform/heap_counter.hpp"
#include "tests/gl/flight_render_fixture.hpp"

namespace ridgeline {
namespace {

TEST_F(FlightRender, a_frame_proves_itself_and_keeps_its_promise) {
  boot();
  render_->draw(monotonic_now_ns());
  EXPECT_EQ(render_->fact().availability.mode, Mode::removed);
  EXPECT_FALSE(render_->fact().proof.bound_computed);
  fly_until_drawn();
  const FrameProof& proof = render_->fact().proof;
  EXPECT_TRUE(proof.bound_computed);
  EXPECT_TRUE(proof.fence_signalled);
  EXPECT_EQ(proof.newest_input_ns, state_.now_ns);
  EXPECT_GT(proof.finished_ns, proof.newest_input_ns);
  EXPECT_EQ(exchange_->latency.count(), render_->fact().proof.frame - 1);
  EXPECT_GE(exchange_->latency.largest_ns(), exchange_->frame_time.quantile_ns(0.01) / 2);
  render_->dump();
  EXPECT_EQ(render_->dump_problem(), "");
  const std::string verify = "'" RIDGELINE_PROGRAM "' verify " + folder_.file("last") +
                             " --terrain " + folder_.file("tiles") + " --pixels all";
  EXPECT_EQ(std::system(verify.c_str()), 0);
}

TEST_F(FlightRender, frames_allocate_nothing) {
  boot();
  fly_until_drawn();
  const std::uint64_t before = heap_allocations_counted();
  {
    const HeapSection section;
    for (int i = 0; i < 5; ++i) fly();
  }
  EXPECT_EQ(heap_allocations_counted(), before);
}

/// A deadline of 1 ms is shed for from the first frames on, down to no terrain or the largest
/// bound.
TEST_F(FlightRender, what_cannot_be_in_time_is_shed_said_and_counted_without_the_heap) {
  config_.monitor.deadline_ms = 1.0;
  boot();
  for (int i = 0; i < 200 && render_->fact().budget.sheds == 0; ++i) {
    fly();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  const std::uint64_t before = heap_allocations_counted();
  {
    const HeapSection section;
    for (int i = 0; i < 10; ++i) fly();
  }
  EXPECT_EQ(heap_allocations_counted(), before);
  const FrameFact& fact = render_->fact();
  EXPECT_GT(fact.budget.sheds, 0u);
  EXPECT_GT(fact.budget_step, 0);
  EXPECT_EQ(fact.budget.frames, fact.proof.frame);
  EXPECT_EQ(std::accumulate(fact.budget.overruns.begin(), fact.budget.overruns.end(), 0ull),
            fact.proof.frame);
  EXPECT_LT(fact.budget.overruns[0], fact.proof.frame) << "some frame took longer than 1 ms";
  EXPECT_NE(fact.availability.mode, Mode::svs);
  const auto reasons = fact.availability.reasons.view();
  EXPECT_TRUE(std::any_of(reasons.begin(), reasons.end(), [](Reason reason) {
    return reason == Reason::overload || reason == Reason::bound_for_time ||
           reason == Reason::detail_shed;
  })) << "the picture says what was left out";
  const nlohmann::json status = status_now();
  EXPECT_EQ(status["monitor"]["frames"], fact.budget.frames);
  EXPECT_EQ(status["monitor"]["sheds"], fact.budget.sheds);
  EXPECT_EQ(status["monitor"]["deadline_ms"], 1.0);
  EXPECT_GT(status["monitor"]["worst_ms"], 1.0);
}

TEST_F(FlightRender, a_monitor_that_is_switched_off_sheds_and_counts_nothing) {
  config_.monitor.deadline_ms = 1.0;
  config_.monitor.on = false;
  boot();
  fly_until_drawn();
  for (int i = 0; i < 10; ++i) fly();
  EXPECT_EQ(render_->fact().availability.mode, Mode::svs);
  EXPECT_LE(render_->fact().bound_px, config_.picture.error_px);
  EXPECT_EQ(render_->fact().budget.frames, 0u);
  EXPECT_EQ(status_now()["monitor"]["on"], false);
}

TEST_F(FlightRender, the_status_report_counts_what_integrity_found) {
  state_.counters.freezes = 3;
  state_.counters.disagreements = 7;
  BusStatus bus;
  bus.updates = state_.counters;
  exchange_->bus_report.write(bus);
  const nlohmann::json status = status_now();
  EXPECT_EQ(status["integrity"]["freezes"], 3);
  EXPECT_EQ(status["integrity"]["disagreements"], 7);
  EXPECT_EQ(status["integrity"]["outvoted"], 0);
}

/// The levels that the supervisor passes on, as it does after debouncing.
TEST_F(FlightRender, the_night_and_declutter_lines_reach_the_picture_and_the_report) {
  config_.picture.night_luminance = 0.2;
  boot();
  fly_until_drawn();
  const auto picture = [&] {
    fly();
    std::vector<std::uint8_t> rgba(4 * render_->scene().pixels());
    render_->scene().read_colour(rgba);
    return rgba;
  };
  const auto day = picture();
  EXPECT_EQ(status_now()["display"]["luminance"], 1.0);
  exchange_->night = true;
  const auto night = picture();
  const double factor = std::pow(0.2, 1.0 / 2.2);
  for (std::size_t k = 0; k < day.size(); ++k) {
    ASSERT_NEAR(night[k], k % 4 == 3 ? 255 : factor * day[k], 1.5) << k;
  }
  EXPECT_EQ(status_now()["display"]["luminance"], 0.2);
  EXPECT_EQ(status_now()["display"]["declutter"], false);
  EXPECT_EQ(render_->fact().availability.mode, Mode::svs) << "a switch is no reason";
  exchange_->night = false;
  exchange_->declutter = true;
  const auto fewer = picture();
  EXPECT_NE(fewer, day);
  EXPECT_EQ(status_now()["display"]["declutter"], true);
  EXPECT_EQ(status_now()["monitor"]["sheds"], 0) << "the pilot took it away, not the monitor";
  exchange_->declutter = false;
  EXPECT_EQ(picture(), day) << "and everything comes back";
}

TEST_F(FlightRender, a_dimmed_last_frame_says_so_and_is_judged_as_any_other) {
  boot();
  exchange_->night = true;
  exchange_->declutter = true;
  fly_until_drawn();
  render_->dump();
  ASSERT_EQ(render_->dump_problem(), "");
  std::ifstream stream(folder_.file("last") + "/000000.json");
  const auto json = nlohmann::json::parse(stream, nullptr, false);
  EXPECT_EQ(json["display"]["luminance"], limits::default_night_luminance);
  EXPECT_EQ(json["display"]["declutter"], true);
  const std::string verify = "'" RIDGELINE_PROGRAM "' verify " + folder_.file("last") +
                             " --terrain " + folder_.file("tiles") + " --pixels all";
  EXPECT_EQ(std::system(verify.c_str()), 0);
}

/// 1500 m over the ellipsoid, over hills of at most 1100 m.
TEST_F(FlightRender, wheels_on_the_ground_in_flight_are_told_counted_and_take_no_picture_away) {
  boot();
  speed_mps_ = 60.0;
  fly_until_drawn();
  const auto told = [&] {
    const auto reasons = render_->fact().availability.reasons.view();
    return std::find(reasons.begin(), reasons.end(), Reason::air_ground_disagrees) != reasons.end();
  };
  const auto fly_for = [&](std::int64_t time_ns) {
    for (const std::int64_t end_ns = monotonic_now_ns() + time_ns; monotonic_now_ns() < end_ns;) {
      fly();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  };
  fly_for(limits::flight_ns + 500 * limits::ms_ns);
  EXPECT_FALSE(told()) << "no switch is connected";
  exchange_->air_ground = AirGround::ground;
  fly_for(limits::flight_ns + 500 * limits::ms_ns);
  EXPECT_TRUE(told());
  EXPECT_EQ(render_->fact().availability.mode, Mode::degraded);
  EXPECT_TRUE(render_->fact().proof.bound_computed);
  EXPECT_EQ(status_now()["integrity"]["air_ground_disagreements"], 1);
  EXPECT_EQ(status_now()["display"]["air_ground"], "ground");
  exchange_->air_ground = AirGround::air;
  fly_for(limits::agree_again_ns + 500 * limits::ms_ns);
  EXPECT_FALSE(told());
  EXPECT_EQ(status_now()["display"]["air_ground"], "air");
}

TEST_F(FlightRender, a_lost_context_ends_the_program_and_shows_the_failure_picture) {
  boot();
  fly();
  EXPECT_FALSE(exchange_->stop);
  render_->screen().ask_reset_status([]() -> GLenum { return 0x8254; });  // GL_INNOCENT_...RESET
  fly();
  EXPECT_TRUE(exchange_->stop);
  EXPECT_EQ(static_cast<Fault>(exchange_->fatal.load()), Fault::gl_context_lost);
  EXPECT_TRUE(render_->screen().health().failed_shown);
  EXPECT_FALSE(render_->fact().proof.fence_signalled);
  EXPECT_EQ(render_->fact().present_faults, 1u);
}

TEST_F(FlightRender, old_values_remove_the_terrain_and_prove_nothing) {
  boot();
  fly_until_drawn();
  receive(monotonic_now_ns() - 3 * limits::second_ns);
  render_->draw(monotonic_now_ns());
  EXPECT_EQ(render_->fact().availability.mode, Mode::removed);
  EXPECT_FALSE(render_->fact().proof.bound_computed);
}

TEST_F(FlightRender, what_boot_needs_and_does_not_find_is_named) {
  config_.terrain.folder = folder_.file("nowhere");
  RenderThread no_terrain(config_, *exchange_);
  const std::string unreadable(fault_text(Fault::folder_unreadable));
  EXPECT_EQ(no_terrain.boot().rfind(config_.terrain.folder + ": " + unreadable, 0), 0u);
  config_.terrain.folder = folder_.file("tiles");
  config_.terrain.geoid = folder_.file("none.pgm");
  RenderThread no_geoid(config_, *exchange_);
  EXPECT_EQ(no_geoid.boot().rfind(config_.terrain.geoid, 0), 0u);
  config_.terrain.geoid = "none";
  config_.screen.kind = ScreenKind::kms;
  config_.screen.card = folder_.file("no-card");
  RenderThread no_screen(config_, *exchange_);
  EXPECT_EQ(no_screen.boot().rfind("screen: no screen: the card", 0), 0u);
}

}  // namespace
}  // namespace ridgeline
