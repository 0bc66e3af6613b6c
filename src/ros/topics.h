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
constexpr char kMissionStatus[] = "mission_status";
constexpr char kControl[] = "control";
constexpr char kInterfaceVersion[] = "interface_version";
constexpr char kShutdown[] = "shutdown";
constexpr char kAck[] = "ack";
constexpr char kLink[] = "link";
constexpr char kNmeaReceived[] = "nmea/rx";
constexpr char kNmeaSent[] = "nmea/tx";
constexpr char kNmeaReplay[] = "nmea/replay";

}  // namespace frontseat_driver::ros_layer::topics
