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
