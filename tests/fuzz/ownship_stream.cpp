// The ownship state over a stream of frames and times, with any protocol and profile. An input is
// the protocol (1 byte), a profile, and updates of up to eight frames (bus_input.hpp).
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/bus/bus_decoder.hpp"
#include "core/monitor/availability.hpp"
#include "core/state/ownship_pose.hpp"
#include "core/state/ownship_update.hpp"
#include "tests/fuzz/bus_input.hpp"
#include "tests/fuzz/property.hpp"

using namespace ridgeline;
using ridgeline::fuzz::InputBytes;
using ridgeline::fuzz::must;

namespace {

using Frames = std::span<const BusFrame>;
using Touched = std::array<bool, bus_parameter_count>;

/// The counters of which each frame raises one, added up.
std::uint64_t outcomes(const UpdateCounters& c) {
  return std::uint64_t{c.decoded} + c.ignored + c.not_data + c.other_channel + c.other_source +
         c.bad_length + c.type_mismatch + c.out_of_range + c.not_finite + c.bad_parity +
         c.no_computed_data + c.functional_test + c.failure_warning + c.suspect + c.unpaired_words +
         c.implausible + c.out_of_order + c.from_future;
}

void check_counters(const UpdateCounters& before, const UpdateCounters& after, std::size_t frames) {
  must(after.frames == before.frames + frames, "every frame is counted");
  must(outcomes(after) == after.frames, "every frame is counted once");
  must(after.clock_resets - before.clock_resets <= 1, "an update resets the clock once at most");
}

void check_sample(const OwnshipState& state, BusParameter parameter) {
  const Sample& sample = state[parameter];
  const BusQuantity& quantity = icd_row(parameter).quantity;
  const bool is_stored =
      sample.validity == Validity::missing || sample.validity == Validity::valid ||
      sample.validity == Validity::implausible || sample.validity == Validity::invalid;
  must(is_stored, "what depends on the time of asking is not stored");
  if (sample.validity == Validity::missing) {
    must(sample.value == 0.0 && sample.time_ns == 0, "what is missing has no value");
    return;
  }
  must(std::isfinite(sample.value) && sample.value >= quantity.minimum &&
           sample.value <= quantity.maximum,
       "a value is within the range of its row");
  must(sample.time_ns <= state.now_ns + limits::future_tolerance_ns * 2,
       "no value comes from the future");
}

/// Latitude and longitude of one source: one fix.
void check_fix(const OwnshipState& state, BusParameter latitude, BusParameter longitude,
               const BusProfile& profile) {
  const Sample& lat = state[latitude];
  const Sample& lon = state[longitude];
  must(lat.validity == lon.validity, "a fix is good or bad as a whole");
  must(lat.source == lon.source, "a fix has one source");
  must(std::abs(lat.time_ns - lon.time_ns) <= profile.fix_pair_limit_ns, "a fix has one time");
  must(lat.validity == Validity::missing || lat.value != 0.0 || lon.value != 0.0,
       "0 / 0 is no place");
}

/// Which parameters the frames may say something about; a coordinate speaks for its fix.
Touched touched_by(Frames frames, const BusProfile& profile) {
  Touched touched{};
  const auto mark = [&touched](BusParameter p) { touched[static_cast<std::size_t>(p)] = true; };
  for (const BusFrame& frame : frames) {
    const std::optional<FrameTopic> topic = frame_topic(frame, profile);
    if (!topic || !topic->is_read) continue;
    mark(topic->parameter);
    if (topic->parameter == BusParameter::gps_latitude) mark(BusParameter::gps_longitude);
    if (topic->parameter == BusParameter::gps_longitude) mark(BusParameter::gps_latitude);
    if (topic->parameter == BusParameter::ins_latitude) mark(BusParameter::ins_longitude);
    if (topic->parameter == BusParameter::ins_longitude) mark(BusParameter::ins_latitude);
  }
  return touched;
}

bool is_same(const Sample& a, const Sample& b) {
  return a.value == b.value && a.time_ns == b.time_ns && a.validity == b.validity &&
         a.source == b.source;
}

void check_untouched(const OwnshipState& before, const OwnshipState& after, Frames frames,
                     const BusProfile& profile) {
  if (after.counters.clock_resets != before.counters.clock_resets) return;
  const Touched touched = touched_by(frames, profile);
  for (std::size_t index = 0; index < bus_parameter_count; ++index) {
    must(touched[index] || (is_same(before.samples[index], after.samples[index]) &&
                            before.refused_time_ns[index] == after.refused_time_ns[index]),
         "no frame of one parameter changes another");
  }
}

/// The frames in two updates at one time do what they do in one.
void check_split(const OwnshipState& before, const OwnshipState& after, Frames frames,
                 const BusProfile& profile) {
  const std::size_t half = frames.size() / 2;
  const OwnshipState middle = update_ownship(before, frames.first(half), after.now_ns, profile);
  const OwnshipState end = update_ownship(middle, frames.subspan(half), after.now_ns, profile);
  must(std::equal(end.samples.begin(), end.samples.end(), after.samples.begin(), is_same),
       "it does not matter how frames are handed in");
  must(outcomes(end.counters) == outcomes(after.counters) &&
           end.counters.decoded == after.counters.decoded &&
           end.counters.unpaired_fixes == after.counters.unpaired_fixes &&
           end.counters.jumps_believed == after.counters.jumps_believed,
       "it does not matter for the counters either");
}

void check_pose_value(const PoseValue& value, double low, double high, std::int64_t timeout_ns) {
  must(value.age_ns >= 0, "no age is negative");
  must(std::isfinite(value.value), "every value of the pose is finite");
  if (value.validity != Validity::valid) return;
  must(value.value >= low && value.value <= high, "a valid value is within its domain");
  must(value.age_ns <= timeout_ns, "a valid value is not stale");
}

/// A position is carried on by the speed and track of its own source alone, while they are valid.
void check_carried(const OwnshipState& state, std::int64_t now_ns, const OwnshipPose& pose,
                   const StateLimits& rules) {
  if (pose.extrapolated_ns == 0) return;
  const bool is_gps = pose.position_source == PositionSource::gps;
  const BusParameter speed =
      is_gps ? BusParameter::gps_ground_speed : BusParameter::ins_ground_speed;
  const BusParameter track = is_gps ? BusParameter::gps_true_track : BusParameter::ins_true_track;
  must(pose.latitude_deg.validity == Validity::valid, "only a valid position is carried on");
  for (const BusParameter parameter : {speed, track}) {
    must(validity_at(state, parameter, now_ns, rules.velocity_timeout_ns) == Validity::valid,
         "a position is carried on by valid values");
  }
}

void check_pose(const OwnshipState& state, std::int64_t now_ns, const BusProfile& profile) {
  const StateLimits rules = state_limits(profile);
  const OwnshipPose pose = ownship_pose(state, now_ns, rules);
  check_pose_value(pose.latitude_deg, -90.0, 90.0, rules.position_timeout_ns);
  check_pose_value(pose.longitude_deg, -180.0, 180.0, rules.position_timeout_ns);
  check_pose_value(pose.height_m, -1800.0, 30300.0, rules.height_timeout_ns);
  check_pose_value(pose.roll_deg, -180.0, 180.0, rules.attitude_timeout_ns);
  check_pose_value(pose.pitch_deg, -90.0, 90.0, rules.attitude_timeout_ns);
  check_pose_value(pose.heading_deg, 0.0, 360.0, rules.heading_timeout_ns);
  must(pose.heading_deg.value < 360.0, "a heading is below 360 degrees");
  must(pose.extrapolated_ns >= 0 && pose.extrapolated_ns <= rules.extrapolation_limit_ns,
       "a position is carried on for so long only");
  check_carried(state, now_ns, pose, rules);
  must((pose.position_source == PositionSource::none) ==
           (pose.latitude_deg.validity == Validity::missing),
       "a position has a source");
  must((pose.heading_source == HeadingSource::none) ==
           (pose.heading_deg.validity == Validity::missing),
       "a heading has a source");
  const Availability drawn = availability(pose);
  const bool is_whole =
      pose.latitude_deg.validity == Validity::valid &&
      pose.longitude_deg.validity == Validity::valid && pose.height_m.validity == Validity::valid &&
      pose.roll_deg.validity == Validity::valid && pose.pitch_deg.validity == Validity::valid &&
      pose.heading_deg.validity == Validity::valid;
  must(is_whole || !drawn.reasons.empty(), "what is missing is a reason");
  must(is_whole || drawn.mode == Mode::removed, "without a valid pose no terrain is drawn");
  must(drawn.reasons.empty() == (drawn.mode == Mode::svs), "a mode has its reasons");
}

void check_update(const OwnshipState& before, const OwnshipState& after, Frames frames,
                  const BusProfile& profile) {
  check_counters(before.counters, after.counters, frames.size());
  for (const BusIcdRow& row : bus_icd) check_sample(after, row.parameter);
  check_fix(after, BusParameter::gps_latitude, BusParameter::gps_longitude, profile);
  check_fix(after, BusParameter::ins_latitude, BusParameter::ins_longitude, profile);
  check_untouched(before, after, frames, profile);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  InputBytes input(data, size);
  const auto protocol = static_cast<BusProtocol>(input.below(3));
  const BusProfile profile = ridgeline::fuzz::profile_from(input, protocol);
  OwnshipState state;
  std::int64_t now_ns = 1'700'000'000'000'000'000;
  std::array<BusFrame, 8> frames;
  while (!input.empty()) {
    const std::uint8_t update = input.u8();
    const std::size_t count = update & 7U;
    for (std::size_t index = 0; index < count; ++index) {
      now_ns = ridgeline::fuzz::time_from(input, now_ns);
      frames[index] = ridgeline::fuzz::frame_from(input, profile, now_ns);
    }
    if ((update & 8U) != 0) now_ns = ridgeline::fuzz::time_from(input, now_ns);
    const Frames batch(frames.data(), count);
    const OwnshipState next = update_ownship(state, batch, now_ns, profile);
    check_update(state, next, batch, profile);
    if ((update & 0xc0U) == 0xc0U) check_split(state, next, batch, profile);
    state = next;
    check_pose(state, now_ns, profile);
  }
  return 0;
}
