#include "frontseat_driver/sim/quirks.h"

#include <algorithm>

namespace frontseat_driver::sim {

const std::vector<QuirkName>& quirkNames() {
  static const std::vector<QuirkName> kNames = {
      {"unpadded_minutes", &Quirks::unpadded_minutes,
       "minutes below ten without leading zero: 429.123456,N is 42 deg 9.123456 min"},
      {"dropped_zeros", &Quirks::dropped_zeros,
       "degrees without leading zeros: 7105.44878,W and 30.6,W"},
      {"float32_positions", &Quirks::float32_positions, "degrees through 32-bit floats"},
      {"zero_position_before_fix", &Quirks::zero_position_before_fix,
       "0,0 instead of blanks until the first fix"},
      {"blank_attitude", &Quirks::blank_attitude, "roll and pitch of NVG blank"},
      {"zero_altitude", &Quirks::zero_altitude, "altitude of NVG always 0"},
      {"zero_depth", &Quirks::zero_depth, "depth of NVG always 0"},
      {"course_heading", &Quirks::course_heading,
       "heading of NVG is the course over ground above 0.2 m/s"},
      {"nan_velocities", &Quirks::nan_velocities, "velocities of NVR are nan when standing"},
      {"rate_wrap", &Quirks::rate_wrap,
       "rates of NVR are differences that jump when the heading wraps"},
      {"heron_compass", &Quirks::heron_compass,
       "RCM heading is (180 - heading) mod 360 and pitch has the other sign"},
      {"acceleration_in_g", &Quirks::acceleration_in_g, "accelerations of RIM and IMU in g"},
      {"battery_without_id", &Quirks::battery_without_id, "RBS with five fields"},
      {"zero_temperature", &Quirks::zero_temperature, "temperature of RBS always 0"},
      {"gn_talkers", &Quirks::gn_talkers, "GNRMC and GNGGA instead of GPRMC and GPGGA"},
      {"cr_lf_lf", &Quirks::cr_lf_lf, "sentences end CR LF LF"},
      {"seconds_sixty", &Quirks::seconds_sixty,
       "the first second of each minute is sent as second 60 of the one before"},
      {"long_ack_names", &Quirks::long_ack_names, "BFACK names commands by five letters"},
      {"blank_mission_status", &Quirks::blank_mission_status, "status of BFMIS blank"},
      {"ack_log_ack", &Quirks::ack_log_ack, "BPLOG,ACK,ON is itself acknowledged"},
      {"single_client", &Quirks::single_client, "a second client hears nothing"},
      {"one_read_one_sentence", &Quirks::one_read_one_sentence,
       "reads at most 256 bytes 20 times a second, each read is one sentence"},
      {"cut_last_three", &Quirks::cut_last_three, "cuts the last three characters of each command"},
      {"command_by_substring", &Quirks::command_by_substring,
       "a command is the first of RMB, LOG, ABT, STS, VER found anywhere in the line"},
      {"dies_on_empty_field", &Quirks::dies_on_empty_field,
       "an empty field of BPRMB ends all connections and all that was asked for"},
      {"zero_thrust_stops", &Quirks::zero_thrust_stops, "PYDEP with thrust 0 does not turn"},
  };
  return kNames;
}

bool enable(Quirks& quirks, std::string_view name) {
  const auto& names = quirkNames();
  const auto found = std::find_if(names.begin(), names.end(),
                                  [name](const QuirkName& quirk) { return quirk.name == name; });
  if (found == names.end()) return false;
  quirks.*found->member = true;
  return true;
}

}  // namespace frontseat_driver::sim
