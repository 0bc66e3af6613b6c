#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "frontseat_driver/sim/vehicle_model.h"
#include "frontseat_driver/vehicle/clock.h"

namespace frontseat_driver::sim {

using vehicle::UtcTime;

/// What goes wrong at a simulated Blueye drone, on purpose. Times are the drone's.
struct BlueyeFaults {
  double lose_replies = 0.0;     ///< probability that a request is obeyed, not answered
  double reply_delay_s = 0.0;    ///< replies come so late
  double lose_telemetry = 0.0;   ///< probability that a telemetry message is lost
  double corrupt = 0.0;          ///< probability that a byte of a message changes on the way
  double silence_s = 0.0;        ///< so long nothing is sent at all,
  double silence_every_s = 0.0;  ///< beginning so often; 0: never
  double reboot_every_s = 0.0;   ///< the drone's computer starts anew so often; 0: never
  double reboot_s = 8.0;         ///< and is gone for so long
};

/// How a drone reads or writes what the document leaves open (protocol traps 1, 2, 3, 6 and 9).
struct BlueyeConventions {
  bool yaw_clockwise = true;         ///< positive yaw in MotionInput turns to the right
  bool dvl_y_right = true;           ///< y of DvlVelocity counts to starboard
  bool gravity_positive = false;     ///< accelerometer z = +1 g at rest, not the specific force
  bool pause_instructions = false;   ///< obey `auto_continue: false`; clients rarely set it
  bool bearings_in_degrees = false;  ///< of the multibeam; false: hundredths of a degree
};

/// The sonar image that a simulated multibeam sends.
struct MultibeamSize {
  std::uint32_t beams = 256;
  std::uint32_t ranges = 400;      ///< a byte for each beam and range
  double rate_hz = 0.0;            ///< 0: as the client's MultibeamConfig asks
  bool active_from_start = false;  ///< pings without ActivateMultibeamCtrl
};

/// What is plugged into the guest ports.
enum class BlueyeDevice {
  Dvl,
  Gnss,
  Light,
  Camera,
  Gripper,
  Laser,
  Servo,
  Multibeam,
  MultibeamServo,
  Pinger,
  ThicknessGauge,
  CpProbe,
  AquaTroll,
  Medusa
};

/// All devices, by the words that name them in parameters.
const std::vector<std::pair<std::string, BlueyeDevice>>& blueyeDeviceNames();

/// Every device there is.
std::vector<BlueyeDevice> allBlueyeDevices();

/// What a simulated Blueye drone can be told.
struct BlueyeConfig {
  Environment environment{{63.4406, 10.3497}, 0.0, 0.0, 20.0};  ///< off Trondheim
  Start start;
  BatteryType battery{200.0, 16.8, 12.8, 0.04};
  double buoyancy_n = 0.3;            ///< pushes up, 0 or more
  double water_density_g_l = 1025.0;  ///< the water's own; the drone assumes what it was told
  double water_temperature_c = 9.0;
  double magnetic_declination_deg = 0.0;  ///< east positive
  double watchdog_timeout_s =
      3.0;                      ///< without a watchdog for longer, the client in control is lost
  UtcTime start_time{0};        ///< UTC at which the simulation begins
  double clock_offset_s = 0.0;  ///< the drone's clock ahead of UTC until a client sets it
  std::uint64_t seed = 1;       ///< of noise and faults
  bool noise = true;            ///< false: telemetry is the truth
  std::map<std::string, double> rates;  ///< Hz by message name without package; 0 turns off
  std::vector<BlueyeDevice> devices = allBlueyeDevices();
  std::string software_version = "4.4.2-simulated";
  std::string serial_number = "SIM000001";
  MultibeamSize multibeam;
  BlueyeConventions conventions;
  BlueyeFaults faults;
};

}  // namespace frontseat_driver::sim
