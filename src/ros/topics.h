#pragma once

/// Every public name, relative to the node's namespace: one namespace is one vehicle.
namespace frontseat_driver::ros_layer::topics {

constexpr char kOdom[] = "odom";
constexpr char kImuData[] = "imu/data";
constexpr char kImuDataRaw[] = "imu/data_raw";
constexpr char kCompassData[] = "compass/data";
constexpr char kNavFix[] = "nav/fix";
constexpr char kNavVelocity[] = "nav/velocity";
constexpr char kDepth[] = "depth";
constexpr char kAltitude[] = "altitude";
constexpr char kBattery[] = "battery";
constexpr char kGpsFix[] = "gps/fix";
constexpr char kGpsVelocity[] = "gps/velocity";
constexpr char kGpsTimeReference[] = "gps/time_reference";
constexpr char kVehicleTime[] = "vehicle_time";
constexpr char kMissionStatus[] = "mission_status";
constexpr char kControl[] = "control";
constexpr char kInterfaceVersion[] = "interface_version";
constexpr char kShutdown[] = "shutdown";
constexpr char kAck[] = "ack";
constexpr char kLink[] = "link";
constexpr char kNmeaReceived[] = "nmea/rx";
constexpr char kNmeaSent[] = "nmea/tx";
constexpr char kNmeaReplay[] = "nmea/replay";

// Commands.
constexpr char kCmdBehavior[] = "cmd_behavior";
constexpr char kCmdDrive[] = "cmd_drive";
constexpr char kCmdHelm[] = "cmd_helm";
constexpr char kCmdCourse[] = "cmd_course";
constexpr char kCmdVel[] = "cmd_vel";
constexpr char kPayloadStatus[] = "payload_status";

// Services.
constexpr char kAbort[] = "abort";
constexpr char kModifyBehavior[] = "modify_behavior";
constexpr char kSetLogging[] = "set_logging";
constexpr char kSetDatum[] = "set_datum";
constexpr char kEnableCommands[] = "enable_commands";
constexpr char kStop[] = "stop";
constexpr char kSendSentence[] = "send_sentence";

}  // namespace frontseat_driver::ros_layer::topics
