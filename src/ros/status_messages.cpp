#include <cstdint>
#include <limits>
#include <string>

#include "convert.h"
#include "covariance.h"
#include "frontseat_driver/vehicle/date_resolution.h"
#include "message_builder.h"

namespace frontseat_driver::ros_layer {

namespace {

constexpr const char* kNoFrame = "";

float toFloat(const std::optional<double>& value) {
  return static_cast<float>(value.value_or(kNan));
}

// Older sensor_msgs know no temperature.
template <class Message>
auto setTemperature(Message& message, float temperature_c, int)
    -> decltype(message.temperature, void()) {
  message.temperature = temperature_c;
}
template <class Message>
void setTemperature(Message&, float, long) {}

}  // namespace

sensor_msgs::BatteryState MessageBuilder::battery(const vehicle::Battery& battery,
                                                  const vehicle::Now& arrival) {
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  sensor_msgs::BatteryState out;
  out.header = header(kBattery, vehicleStamp(battery.measured_at, arrival), parameters_.base_frame);
  out.voltage = toFloat(battery.stack_v);
  out.cell_voltage = {toFloat(battery.lowest_cell_v), toFloat(battery.highest_cell_v)};
  setTemperature(out, toFloat(battery.temperature_c), 0);
  out.current = out.charge = out.capacity = out.design_capacity = out.percentage = kUnknown;
  out.present = true;
  out.location = withId("battery", battery.id);
  return out;
}

MissionStatus MessageBuilder::missionStatus(const vehicle::MissionStatus& status,
                                            const vehicle::Now& arrival) {
  using State = vehicle::MissionStatus::State;
  static_assert(static_cast<int>(State::Unknown) == MissionStatus::UNKNOWN &&
                    static_cast<int>(State::Running) == MissionStatus::RUNNING &&
                    static_cast<int>(State::Stopped) == MissionStatus::STOPPED,
                "the message counts states as the event does");
  MissionStatus out;
  out.header = header(kMissionStatus, vehicleStamp(status.sent_at, arrival), kNoFrame);
  out.state = static_cast<std::uint8_t>(status.state);
  out.status = std::string(status.status);
  out.dive_file = std::string(status.dive_file);
  out.log_directory = std::string(status.log_directory);
  out.details = std::string(status.details);
  return out;
}

ControlStatus MessageBuilder::controlStatus(const vehicle::Control& control,
                                            const vehicle::Now& arrival) {
  static_assert(static_cast<int>(vehicle::Grant::Unknown) == ControlStatus::UNKNOWN &&
                    static_cast<int>(vehicle::Grant::Denied) == ControlStatus::DENIED &&
                    static_cast<int>(vehicle::Grant::Granted) == ControlStatus::GRANTED,
                "the message counts grants as the event does");
  ControlStatus out;
  out.header = header(kControlStatus, toRosTime(arrival.stamp), kNoFrame);
  out.grant = static_cast<std::uint8_t>(control.grant);
  out.commands_enabled = control.commands_enabled;
  out.commanding = control.commanding;
  out.reason = std::string(control.reason);
  return out;
}

InterfaceVersion MessageBuilder::interfaceVersion(const vehicle::InterfaceVersion& version,
                                                  const vehicle::Now& arrival) {
  InterfaceVersion out;
  out.header = header(kInterfaceVersion, vehicleStamp(version.sent_at, arrival), kNoFrame);
  out.vehicle = std::string(version.version);
  out.payload = parameters_.session.interface_version;
  return out;
}

sensor_msgs::TimeReference MessageBuilder::vehicleTime(const vehicle::ClockSample& clock,
                                                       const vehicle::Now& arrival) {
  sensor_msgs::TimeReference out;
  out.header = header(kVehicleTime, toRosTime(arrival.stamp), kNoFrame);
  out.time_ref = toRosTime(vehicle::resolveDate(clock.time, arrival.utc));
  out.source = "vehicle";
  return out;
}

ShutdownNotice MessageBuilder::shutdownNotice(const vehicle::Shutdown& shutdown,
                                              const vehicle::Now& arrival) {
  ShutdownNotice out;
  out.header = header(kShutdownNotice, vehicleStamp(shutdown.sent_at, arrival), kNoFrame);
  out.earliest_power_off = toRosTime(toUtcTime(out.header.stamp) + shutdown.notice);
  return out;
}

CommandAck MessageBuilder::commandAck(const vehicle::Acknowledgement& ack,
                                      const vehicle::Now& arrival) {
  using std::chrono::duration;
  CommandAck out;
  out.header = header(kCommandAck, vehicleStamp(ack.sent_at, arrival), kNoFrame);
  out.command = (ack.command.size() == 3 ? "BP" : "") + std::string(ack.command);
  if (ack.command_time) out.command_stamp = stamper_.ownTime(*ack.command_time, arrival);
  out.behavior_id = std::string(ack.behavior_id);
  out.status = static_cast<std::uint8_t>(ack.status);
  out.message = std::string(ack.message);
  out.round_trip = ack.round_trip ? duration<double>(*ack.round_trip).count() : kNan;
  return out;
}

}  // namespace frontseat_driver::ros_layer
