#pragma once
#include <cstdint>

/// Time and plausibility limits of everything that arrives on the bus. Each number carries its
/// reason; core/state and core/monitor take them as defaults of StateLimits, so an installer may
/// change them there.
namespace ridgeline::limits {

inline constexpr std::int64_t ms_ns = 1'000'000;
inline constexpr std::int64_t second_ns = 1'000 * ms_ns;

/// Roll and pitch: three intervals of the slowest attitude source met in the field (10 Hz); open
/// gateways use the same 300 ms. At 3 deg/s (standard rate) the picture is then at most 0.9 deg
/// behind.
inline constexpr std::int64_t attitude_timeout_ns = 300 * ms_ns;
/// Heading turns the picture as roll does, so it gets no longer than roll.
inline constexpr std::int64_t heading_timeout_ns = 300 * ms_ns;
/// Position: extrapolated meanwhile, so what ages is the velocity. In a standard-rate turn at 62
/// m/s (3.2 m/s^2 sideways) the error grows to 6.5 m in 2 s: below one post. 20 s, met in the
/// field, is 1.2 km.
inline constexpr std::int64_t position_timeout_ns = 2 * second_ns;
/// Height: 0.3 g of unknown vertical acceleration is 6 m in 2 s.
inline constexpr std::int64_t height_timeout_ns = 2 * second_ns;
/// Radio height is only compared: ten intervals of a radio altimeter at 10 Hz.
inline constexpr std::int64_t radio_height_timeout_ns = 1 * second_ns;
/// Speed, track and vertical speed only feed the extrapolation: three intervals at 10 Hz, rounded
/// up so that one lost frame of a 2 Hz receiver does not stop it.
inline constexpr std::int64_t velocity_timeout_ns = 1 * second_ns;
/// Airspeeds and body rates: three intervals at 10 Hz.
inline constexpr std::int64_t air_data_timeout_ns = 300 * ms_ns;
/// Magnetic variation changes by less than 0.1 deg in a minute of flight below 80 degrees of
/// latitude.
inline constexpr std::int64_t variation_timeout_ns = 60 * second_ns;
/// Clock and date: three intervals at 1 Hz.
inline constexpr std::int64_t clock_timeout_ns = 3 * second_ns;

/// Longest time a position is carried on by ground speed and track; after it the position stands
/// still until it is stale. Half the staleness limit: a straight line is no better than that in a
/// turn.
inline constexpr std::int64_t extrapolation_limit_ns = 1 * second_ns;
/// Latitude and longitude of one fix: half the interval of the fastest scheduled position (10 Hz).
inline constexpr std::int64_t fix_pair_limit_ns = 50 * ms_ns;
/// Upper and lower half of one DOUBLE: sent back to back; well below half of a 10 Hz interval.
inline constexpr std::int64_t double_pair_limit_ns = 20 * ms_ns;
/// Coarse and fine word of one GNSS coordinate: a whole burst of position words at 12.5 kbit/s
/// takes 30 ms; well below half of the shortest interval between bursts (200 ms).
inline constexpr std::int64_t fine_pair_limit_ns = 50 * ms_ns;
/// A frame may be this much later than `now` (two clocks read one after the other), no more.
inline constexpr std::int64_t future_tolerance_ns = 20 * ms_ns;

/// Aerobatic aeroplanes roll at up to 420 deg/s and pitch at up to 150 deg/s; the slack covers
/// sensor noise and two frames with nearly equal times.
inline constexpr double roll_rate_limit_dps = 500.0;
inline constexpr double pitch_rate_limit_dps = 200.0;
inline constexpr double heading_rate_limit_dps = 400.0;
inline constexpr double attitude_jump_slack_deg = 10.0;
/// Above this pitch roll and heading may flip by 180 degrees together: their jumps prove nothing.
inline constexpr double vertical_pitch_deg = 75.0;
/// 400 m/s is above every aircraft this display is for; 50 m is a satellite change of a GNSS
/// receiver.
inline constexpr double position_speed_limit_mps = 400.0;
inline constexpr double position_jump_slack_m = 50.0;
/// 150 m/s is above every climb or dive this display is for; 50 m as for the position, which is
/// better.
inline constexpr double height_speed_limit_mps = 150.0;
inline constexpr double height_jump_slack_m = 50.0;
/// Samples in a row, plausible among themselves, after which a jump is believed: 125 ms of the 80
/// Hz schedule for angles, 500 ms of a 10 Hz receiver for position and height.
inline constexpr std::uint8_t angle_persist_count = 10;
inline constexpr std::uint8_t position_persist_count = 5;

/// Extrapolation divides by cos(latitude): none this close to the poles.
inline constexpr double extrapolation_latitude_limit_deg = 89.5;

/// Speed of a sole receiver and altitude rate: 3 g, and the noise of a rate that is differentiated.
inline constexpr double ground_speed_rate_limit_mps2 = 30.0;
inline constexpr double altitude_rate_rate_limit_mps2 = 30.0;
inline constexpr double velocity_jump_slack_mps = 15.0;

// Integrity: how far two sources may differ, for how long, and what is forgiven. docs/icd.md,
// section 10, has the table; docs/adr/0017 the policy.

/// Two senders of one attitude. Instruments of this class are good to 2 degrees each, vibration and
/// mounting to 1 more each: 6 in all; pitch is mounted by the same rail, 5. The rate term covers
/// that their samples are of different times, up to a brisk manoeuvre.
inline constexpr double roll_disagree_deg = 6.0;
inline constexpr double roll_disagree_dps = 90.0;
inline constexpr double pitch_disagree_deg = 5.0;
inline constexpr double pitch_disagree_dps = 45.0;
/// Two senders of one heading: slaved gyros are good to 3 degrees, magnetometers to 5.
inline constexpr double heading_disagree_deg = 10.0;
inline constexpr double heading_disagree_dps = 90.0;
/// Headings of different kinds (true, and magnetic plus variation): besides, 5 degrees of variation
/// model and 5 of deviation.
inline constexpr double heading_kinds_disagree_deg = 20.0;
/// Two receivers of one constellation differ by less than 15 m in 95 of 100 cases; three times that
/// each. The rate term is the distance flown between their fixes at the fastest this display is
/// for.
inline constexpr double fix_disagree_m = 90.0;
inline constexpr double fix_disagree_mps = position_speed_limit_mps;
/// Vertically receivers are half as good again; heights are of the ellipsoid, so no model differs.
inline constexpr double height_disagree_m = 50.0;
inline constexpr double height_disagree_mps = height_speed_limit_mps;
/// Attitude and heading: as long as an attitude may age. Fixes: five of a 10 Hz receiver.
inline constexpr std::int64_t attitude_disagree_ns = 300 * ms_ns;
inline constexpr std::int64_t position_disagree_ns = 500 * ms_ns;
/// A contradiction ends after the sources have agreed for this long.
inline constexpr std::int64_t agree_again_ns = 2 * second_ns;

/// A fix against its own speed and track: 60 m is a satellite change of a receiver (50 m) and its
/// noise. Forgiven: 3 m/s of noise and wind-up in turns, and 6 % of the speed, 3 degrees of track.
inline constexpr double reckoned_limit_m = 60.0;
inline constexpr double reckoned_forgiven_mps = 3.0;
inline constexpr double reckoned_forgiven_of_speed = 0.06;
/// A height against the altitude rate: a barometric rate lags by up to 2 s, 20 m after a change of
/// 10 m/s; 10 m of receiver noise. Forgiven: 1.5 m/s (300 ft/min) of error, and 10 % of the climb
/// (air 30 K off the standard atmosphere).
inline constexpr double climbed_limit_m = 30.0;
inline constexpr double climbed_forgiven_mps = 1.5;
inline constexpr double climbed_forgiven_of_rate = 0.10;
/// A height against standard altitude: their difference is the weather's and the geoid's, so only
/// its change counts. 60 m: receiver noise, and the error of the static port at another speed and
/// sideslip. Forgiven: 0.5 m/s (a front of 2 hPa in 50 km at 100 m/s is 0.03 m/s, the rest is
/// slack), and 12 % of the climb.
inline constexpr double barometer_limit_m = 60.0;
inline constexpr double barometer_forgiven_mps = 0.5;
inline constexpr double barometer_forgiven_of_rate = 0.12;
/// GPS against INS: an INS drifts by 2 NM an hour (1 m/s), in Schuler swings twice that. 150 m: its
/// fixes come unsteadily, up to a second late, and are carried on.
inline constexpr double receivers_limit_m = 150.0;
inline constexpr double receivers_forgiven_mps = 2.0;
/// Their heights: an inertial height is held by the barometer.
inline constexpr double receiver_heights_limit_m = barometer_limit_m;
/// A contradiction that does not latch is never more than so many limits away from forgiven: a
/// minute at most.
inline constexpr double drift_cap = 3.0;
/// Of two values that are compared, how old either may be: half a second is 25 m at 50 m/s.
inline constexpr std::int64_t compared_age_ns = 500 * ms_ns;
/// After a longer pause a comparison begins anew: what moved meanwhile is not known.
inline constexpr std::int64_t watch_restart_ns = 5 * second_ns;
/// A comparison is one of the present as long as a position is.
inline constexpr std::int64_t watch_present_ns = position_timeout_ns;
/// How long a contradiction outlives a source that has fallen silent: nobody knows which was right.
inline constexpr std::int64_t contradiction_memory_ns = 10 * second_ns;
static_assert(agree_again_ns < contradiction_memory_ns);

/// The same bits for at least so long. Attitudes are measured anew 10 times a second or more and
/// are never twice alike; but recorders round to whole degrees, and senders hold a value at the end
/// of its range: in three recorded flights (14 h) never for so long while the others moved.
/// Receivers of 1 Hz are repeated for 0.9 s.
inline constexpr std::int64_t attitude_freeze_ns = 2 * second_ns;
inline constexpr std::int64_t pitch_freeze_ns = 6 * second_ns;
inline constexpr std::int64_t position_freeze_ns = 1'500 * ms_ns;
/// And meanwhile the others have moved by so much: a turn that the roll does not explain, a flight
/// path angle that changed, a track that turned; two posts of 1"; half a storey of 30 m.
inline constexpr double roll_freeze_deg = 10.0;
inline constexpr double pitch_freeze_deg = 7.0;
inline constexpr double heading_freeze_deg = 6.0;
inline constexpr double fix_freeze_m = 25.0;
inline constexpr double height_freeze_m = 15.0;
/// What the others moved is forgotten over this time: wind leaves 20 % of a turn unexplained, which
/// in a standard-rate turn of a source without any noise is 7 degrees in 12 s.
inline constexpr std::int64_t freeze_window_ns = 12 * second_ns;
/// Below this speed (30 kt) tracks and flight path angles are noise.
inline constexpr double least_speed_mps = 15.0;
/// Above this pitch or bank a turn is not explained by the bank: 10 % of speed and 2 degrees of
/// bank are too much of it.
inline constexpr double steep_deg = 45.0;
/// Steeper flight paths than this come from noise at low speed.
inline constexpr double steep_path_deg = 20.0;

/// Steps of one in a row after which a sender counts its messages: one in 2^24 by chance.
inline constexpr std::uint8_t sequence_learn_count = 3;
/// Refused frames in a row, counting among themselves, after which the sender has begun anew: 100
/// ms at 80 Hz, 0.8 s at 10 Hz; below the age at which the value is stale.
inline constexpr std::uint8_t sequence_restart_count = 8;
/// CAN itself may deliver a frame twice after a fault in its last bit; three in a second are no
/// such fault.
inline constexpr std::uint8_t replay_count = 3;
inline constexpr std::int64_t replay_window_ns = 1 * second_ns;
inline constexpr std::int64_t replay_hold_ns = 2 * second_ns;
/// UTC on the bus is whole seconds and up to a second late; 2.5 s are neither that nor a leap
/// second.
inline constexpr double clock_step_s = 2.5;
/// How long events that are over stay on the screen: long enough to be read.
inline constexpr std::int64_t clock_hold_ns = 5 * second_ns;
inline constexpr std::int64_t jump_hold_ns = 10 * second_ns;

/// Radio height against the height over the drawn ground, m: terrain is good to 30 m (Area 1),
/// trees and buildings stand 40 m high; 15 % is the slope that the antenna sees to its side. For 2
/// s: a cliff or a tower passes by in less.
inline constexpr double radio_disagree_m = 70.0;
inline constexpr double radio_disagree_share = 0.15;
inline constexpr std::int64_t radio_disagree_ns = 2 * second_ns;
/// Radio altimeters measure up to 2500 ft.
inline constexpr double radio_height_limit_m = 762.0;

/// The air/ground switch against speed and height. Flight: faster than any taxiing (50 kt), and
/// higher over the drawn ground than terrain (30 m), receiver (25 m) and antenna over the wheels
/// explain. No climb is there sooner than 5 s after the wheels are off; 2 s, as the radio height.
inline constexpr double flight_speed_mps = 25.0;
inline constexpr double flight_height_m = 70.0;
inline constexpr std::int64_t flight_ns = 2 * second_ns;
/// Standing: slower than receivers err, no higher than terrain and receiver explain. Half a minute:
/// no headwind holds an aeroplane that low over one place for so long.
inline constexpr double standing_speed_mps = 2.0;
inline constexpr double standing_height_m = 55.0;
inline constexpr std::int64_t standing_ns = 30 * second_ns;

/// Longest time the bus thread may be held up without losing a frame: a disk that hangs, a page
/// that comes late. Of a bus that is full of the shortest frames (47 bits) at 1 Mbit/s.
inline constexpr std::int64_t can_stall_ns = 250 * ms_ns;
inline constexpr std::int64_t can_frames_per_second = 21'277;
/// What one frame costs of a receive buffer: 764 bytes measured on Linux 6.1, rounded up.
inline constexpr std::int64_t can_buffer_frame_bytes = 768;
/// How often a CAN interface is asked whether it is there and up; a tenth of what an attitude may
/// age.
inline constexpr std::int64_t can_link_check_ns = 30 * ms_ns;

/// Contacts bounce for up to 20 ms; a press is seldom shorter than 80 ms.
inline constexpr std::int64_t discrete_hold_ns = 40 * ms_ns;

}  // namespace ridgeline::limits
