#pragma once

#include <string_view>
#include <vector>

namespace frontseat_driver::sim {

/// Habits of real vehicles that the documents do not know. All off: as the documents say.
struct Quirks {
  bool unpadded_minutes = false;
  bool dropped_zeros = false;
  bool float32_positions = false;
  bool zero_position_before_fix = false;
  bool blank_attitude = false;
  bool zero_altitude = false;
  bool zero_depth = false;
  bool course_heading = false;
  bool nan_velocities = false;
  bool rate_wrap = false;
  bool heron_compass = false;
  bool acceleration_in_g = false;
  bool battery_without_id = false;
  bool zero_temperature = false;
  bool gn_talkers = false;
  bool cr_lf_lf = false;
  bool seconds_sixty = false;
  bool long_ack_names = false;
  bool blank_mission_status = false;
  bool ack_log_ack = false;
  bool single_client = false;
  bool one_read_one_sentence = false;
  bool cut_last_three = false;
  bool command_by_substring = false;
  bool dies_on_empty_field = false;
  bool zero_thrust_stops = false;
};

/// The name of a quirk, as the parameter `quirks` has it, and what it does.
struct QuirkName {
  std::string_view name;
  bool Quirks::*member;
  std::string_view meaning;
};

/// Every quirk there is.
const std::vector<QuirkName>& quirkNames();

/// Turns the named quirk on; false if there is none of this name.
bool enable(Quirks& quirks, std::string_view name);

}  // namespace frontseat_driver::sim
