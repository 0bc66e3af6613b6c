#pragma once

/// Every public name of a Blueye, relative to the node's namespace. What it shares with the other
/// vehicles has the same name there (src/ros/topics.h).
namespace frontseat_driver::ros_layer::blueye_layer::topics {

// Everything.
constexpr char kTelemetry[] = "blueye/telemetry";
constexpr char kTelemetryReplay[] = "blueye/replay";
constexpr char kControlOut[] = "blueye/control_out";
constexpr char kControlIn[] = "blueye/control";

// Navigation.
constexpr char kOdom[] = "odom";
constexpr char kNavFix[] = "nav/fix";
constexpr char kPositionEstimate[] = "position_estimate";
constexpr char kDepth[] = "depth";
constexpr char kPressure[] = "pressure";
constexpr char kAltitude[] = "altitude";
constexpr char kForwardDistance[] = "forward_distance";
constexpr char kDvlVelocity[] = "dvl/velocity";
constexpr char kDvlData[] = "dvl/data";
constexpr char kImuData[] = "imu/data";
constexpr char kImuMag[] = "imu/mag";
constexpr char kImuTemperature[] = "imu/temperature";
constexpr char kImu1Raw[] = "imu1/data_raw";
constexpr char kImu1Mag[] = "imu1/mag";
constexpr char kImu2Raw[] = "imu2/data_raw";
constexpr char kImu2Mag[] = "imu2/mag";
constexpr char kImuHpRaw[] = "imu_hp/data_raw";
constexpr char kImuHp[] = "imu_hp/data";
constexpr char kMagneticDeclination[] = "magnetic_declination";
constexpr char kTimeReference[] = "time_reference";
constexpr char kPilotFix[] = "pilot/fix";

// The drone.
constexpr char kBattery[] = "battery";
constexpr char kBatteryDetails[] = "battery/details";
constexpr char kSurfaceUnitBattery[] = "surface_unit/battery";
constexpr char kControl[] = "control";
constexpr char kControlMode[] = "control_mode";
constexpr char kClients[] = "clients";
constexpr char kLink[] = "link";
constexpr char kVehicleInfo[] = "vehicle_info";
constexpr char kNotifications[] = "notifications";
constexpr char kReference[] = "reference";
constexpr char kControllerHealth[] = "controller_health";
constexpr char kControlForce[] = "control_force";
constexpr char kMissionStatus[] = "mission_status";
constexpr char kMissionProgress[] = "mission/progress";
constexpr char kAutoPilot[] = "auto_pilot";
constexpr char kWaterTemperature[] = "water_temperature";
constexpr char kCpuTemperature[] = "cpu_temperature";
constexpr char kCanisterTemperature[] = "canister/temperature";
constexpr char kCanisterHumidity[] = "canister/humidity";
constexpr char kLights[] = "lights";
constexpr char kGuestPortLights[] = "guest_port_lights";
constexpr char kLaser[] = "laser";
constexpr char kJointStates[] = "joint_states";
constexpr char kTiltStabilization[] = "tilt_stabilization";
constexpr char kRecordState[] = "record_state";
constexpr char kCalibrationState[] = "calibration_state";
constexpr char kDiveTime[] = "dive_time";
constexpr char kMultibeamPing[] = "multibeam/ping";

// Commands.
constexpr char kCmdVel[] = "cmd_vel";
constexpr char kCmdMotion[] = "cmd_motion";
constexpr char kCmdLights[] = "cmd_lights";
constexpr char kCmdGuestPortLights[] = "cmd_guest_port_lights";
constexpr char kCmdLaser[] = "cmd_laser";
constexpr char kCmdTilt[] = "cmd_tilt";
constexpr char kCmdGripper[] = "cmd_gripper";
constexpr char kCmdJoint[] = "cmd_joint";
constexpr char kPilotPosition[] = "pilot/position";

// Services.
constexpr char kStop[] = "stop";
constexpr char kAbort[] = "abort";
constexpr char kEnableCommands[] = "enable_commands";
constexpr char kTakeControl[] = "take_control";
constexpr char kReleaseControl[] = "release_control";
constexpr char kPing[] = "ping";
constexpr char kAutoDepth[] = "auto_depth";
constexpr char kAutoHeading[] = "auto_heading";
constexpr char kAutoAltitude[] = "auto_altitude";
constexpr char kStationKeeping[] = "station_keeping";
constexpr char kWeatherVaning[] = "weather_vaning";
constexpr char kAutoPilotSurgeYaw[] = "auto_pilot_surge_yaw";
constexpr char kAutoPilotHeave[] = "auto_pilot_heave";
constexpr char kSetTiltStabilization[] = "set_tilt_stabilization";
constexpr char kGuestPorts[] = "guest_ports";
constexpr char kResetPosition[] = "reset_position";
constexpr char kResetOdometer[] = "reset_odometer";
constexpr char kCalibrateDvlGyro[] = "calibrate_dvl_gyro";
constexpr char kCalibrationStart[] = "compass_calibration/start";
constexpr char kCalibrationCancel[] = "compass_calibration/cancel";
constexpr char kCalibrationFinish[] = "compass_calibration/finish";
constexpr char kSetWaterDensity[] = "set_water_density";
constexpr char kSetHeadingMode[] = "set_heading_mode";
constexpr char kSetRate[] = "set_rate";
constexpr char kMissionLoad[] = "mission/load";
constexpr char kMissionGet[] = "mission/get";
constexpr char kMissionRun[] = "mission/run";
constexpr char kMissionPause[] = "mission/pause";
constexpr char kMissionClear[] = "mission/clear";
constexpr char kRecord[] = "record";
constexpr char kTakePicture[] = "take_picture";
constexpr char kRequest[] = "blueye/request";
constexpr char kSendControl[] = "blueye/send_control";

}  // namespace frontseat_driver::ros_layer::blueye_layer::topics
