#include <ros/serialization.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "blueye.h"
#include "blueye/health.h"
#include "blueye/messages.h"
#include "blueye/mission_json.h"
#include "blueye/navigation.h"
#include "frontseat_driver/protocol/blueye_catalogue.h"
#include "message_promises.h"

// What a drone says, and what a user writes for one: from frames to ROS messages and JSON, and from
// JSON to frames. The first byte chooses the conventions; then one message after the other, each
// with the time since the one before.

namespace frontseat_driver::fuzz {
namespace {

namespace layer = ros_layer::blueye_layer;
namespace pb = blueye::protocol;
using layer::Context;
using protocol::BlueyeCatalogue;

const BlueyeCatalogue& catalogue() {
  static const BlueyeCatalogue kCatalogue;
  return kCatalogue;
}

template <class Message>
void checkAll(const Message& message) {
  check(message);
  ros::serialization::serializeMessage(message);
}
template <class Message>
void checkAll(const std::optional<Message>& message) {
  if (message) checkAll(*message);
}

template <class Message>
std::optional<Message> parse(std::string_view payload) {
  Message message;
  if (!message.ParseFromArray(payload.data(), static_cast<int>(payload.size()))) return {};
  return message;
}

// --- One message at a time ---

using Convert = std::function<void(std::string_view, const Context&)>;
using Table = std::map<std::string, Convert>;

template <class Telemetry, class Message>
void add(Table& table, std::optional<Message> (*convert)(const Telemetry&, const Context&)) {
  Convert& entry = table[Telemetry{}.GetTypeName()];
  entry = [before = entry, convert](std::string_view payload, const Context& context) {
    if (before) before(payload, context);
    if (const auto told = parse<Telemetry>(payload)) checkAll(convert(*told, context));
  };
}

template <class Telemetry, class Function>
void on(Table& table, Function function) {
  table[Telemetry{}.GetTypeName()] = [function](std::string_view payload, const Context& context) {
    if (const auto told = parse<Telemetry>(payload)) function(*told, context);
  };
}

template <class Battery>
void checkBattery(const Battery& battery, const Context& context) {
  checkAll(layer::toBattery(battery, 0, context));
}

Table conversions() {
  Table table;
  on<pb::BatteryTel>(table, [](const auto& told, const Context& context) {
    checkBattery(told.battery(), context);
    checkBattery(told.second_battery(), context);
  });
  on<pb::BatteryBQ40Z50Tel>(table, [](const auto& told, const Context& context) {
    checkBattery(told.battery(), context);
    checkAll(layer::toBatteryDetails(told.second_battery(), 1, context));
  });
  on<pb::NotificationTel>(table, [](const auto& told, const Context& context) {
    checkAll(layer::toNotification(told.notification(), context));
  });
  on<pb::PositionEstimateTel>(table, [](const auto& told, const Context& context) {
    checkAll(layer::toEstimate(told, context));
    checkAll(layer::toNavFix(told, std::nullopt, context));
    checkAll(layer::toNavFix(told, 3.0, context));
  });
  on<pb::CalibratedImuTel>(table, [](const auto& told, const Context& context) {
    checkAll(layer::toMagneticField(told.imu(), context));
    checkAll(layer::toImuTemperature(told, context));
  });
  add(table, layer::toDepth);
  add(table, layer::toPressure);
  add(table, layer::toAltitude);
  add(table, layer::toForwardDistance);
  add(table, layer::toDvlTwist);
  add(table, layer::toDvl);
  add(table, layer::toControlMode);
  add(table, layer::toInfo);
  add(table, layer::toTimeReference);
  add(table, layer::toReference);
  add(table, layer::toHealth);
  add(table, layer::toWrench);
  add(table, layer::toDeclination);
  add(table, layer::toMission);
  add(table, layer::toAutoPilot);
  add(table, layer::toWaterTemperature);
  add(table, layer::toCpuTemperature);
  add(table, layer::toCanisterTemperature);
  add(table, layer::toHumidity);
  add(table, layer::toLights);
  add(table, layer::toGuestPortLights);
  add(table, layer::toLaser);
  add(table, layer::toCameraTilt);
  add(table, layer::toServo);
  add(table, layer::toMultibeamTilt);
  add(table, layer::toTiltStabilization);
  add(table, layer::toRecordState);
  add(table, layer::toPilotFix);
  add(table, layer::toCalibration);
  add(table, layer::toDiveTime);
  add(table, layer::toPing);
  add(table, layer::toSurfaceUnit);
  return table;
}

// --- What several messages make together ---

layer::NavigationOptions anyOptions(unsigned flags) {
  layer::NavigationOptions options;
  layer::Conventions& how = options.conventions;
  how.dvl_y_right = (flags & 1U) == 0;
  how.battery_discharge_negative = how.heave_velocity_down = (flags & 2U) == 0;
  how.bearings_clockwise = how.multibeam_tilt_up = (flags & 4U) == 0;
  how.accelerometer_sign = static_cast<layer::AccelerometerSign>((flags >> 3U) % 3);
  if ((flags & 32U) != 0) how.add_declination_rad = -3.0;
  if ((flags & 64U) != 0) options.datum = vehicle::Position{89.9, 179.9};
  return options;
}

class Navigation {
 public:
  explicit Navigation(unsigned flags) : navigation_(anyOptions(flags)) {}

  Context context(const vehicle::Now& now) const { return navigation_.context(stampOf(now)); }

  void take(const vehicle::Now& now, const Frames& frames) {
    const bool taken = takeAs<pb::AttitudeTel>(now, frames) || takeAs<pb::DepthTel>(now, frames) ||
                       takeAs<pb::CalibratedImuTel>(now, frames) ||
                       takeAs<pb::DvlVelocityTel>(now, frames) ||
                       takeAs<pb::PositionEstimateTel>(now, frames);
    if (!taken) return;
    checkAll(navigation_.imu(now, stampOf(now)));
    checkAll(navigation_.mapTransform(stampOf(now)));
    navigation_.dvlDisagrees();
    const auto odometry = navigation_.odometry(now, stampOf(now));
    if (!odometry) return;
    checkAll(*odometry);
    checkAll(navigation_.transform(*odometry));
  }

 private:
  static ros::Time stampOf(const vehicle::Now& now) {
    return ros::Time{static_cast<double>(now.stamp.count()) * 1e-9};
  }

  template <class Telemetry>
  bool takeAs(const vehicle::Now& now, const Frames& frames) {
    if (frames.type != Telemetry{}.GetTypeName()) return false;
    const auto told = parse<Telemetry>(frames.payload);
    if (told) navigation_.take(*told, now);
    return told.has_value();
  }

  layer::Navigation navigation_;
};

// --- JSON and diagnostics ---

// In an Any nobody has looked at the bytes.
bool holdsAny(const std::string& json) { return json.find("\"@type\"") != std::string::npos; }

void checkJson(const Frames& frames) {
  const auto json = catalogue().toJson(frames.type, frames.payload);
  promise(!json.text.empty(), "neither JSON nor a reason");
  if (!json.ok || holdsAny(json.text)) return;
  const auto bytes = catalogue().fromJson(frames.type, json.text);
  if (!bytes.ok) {
    const bool none = bytes.text.find("finite") != std::string::npos;
    return promise(none, "its own JSON is refused: " + bytes.text);
  }
  promise(catalogue().toJson(frames.type, bytes.text).text == json.text, "JSON tells other things");
}

void checkHealth(const Frames& frames) {
  layer::Health health;
  health.connected = true;
  health.battery_level = static_cast<double>(frames.payload.size()) / 100.0;
  health.values["VideoStorageSpaceTel"] = catalogue().values(frames.type, frames.payload);
  for (const auto& [name, report] : layer::kReports) {
    diagnostic_updater::DiagnosticStatusWrapper status;
    report(health, status);
    promise(!status.message.empty(), "a report of nothing");
  }
}

void checkMission(const std::string& text) {
  const layer::MissionRequest read = layer::toMissionRequest(catalogue(), text);
  if (const auto* refusal = std::get_if<std::string>(&read)) {
    return promise(!refusal->empty(), "a mission was refused without a reason");
  }
  const pb::Mission& mission = std::get<pb::SetMissionReq>(read).mission();
  promise(mission.instructions_size() >= 1 && mission.instructions_size() <= 50, "how many?");
  if (text.find("auto") != std::string::npos || text.find('\\') != std::string::npos) return;
  for (const pb::Instruction& instruction : mission.instructions()) {
    promise(instruction.auto_continue(), "a mission would stop at an instruction");
  }
}

bool inUnit(double value) { return value >= -1.0 && value <= 1.0; }

void checkCommand(const layer::ConvertedMotion& converted) {
  if (const auto* refusal = std::get_if<std::string>(&converted)) {
    return promise(!refusal->empty(), "a command was refused without a reason");
  }
  const auto& command = std::get<vehicle::DroneCommand>(converted);
  const auto& motion = std::get<vehicle::MotionCommand>(command);
  for (const double value : {motion.surge, motion.sway, motion.heave, motion.roll, motion.pitch,
                             motion.yaw, motion.slow, motion.boost}) {
    promise(inUnit(value), "a command is out of range");
  }
}

void checkCommands(Dice& dice) {
  MotionInput motion;
  for (double* value : {&motion.x, &motion.y, &motion.z, &motion.roll, &motion.pitch, &motion.yaw,
                        &motion.slow, &motion.boost}) {
    *value = dice.value<double>();
  }
  checkCommand(layer::toCommand(motion));
  geometry_msgs::Twist velocity;
  velocity.linear.x = motion.x;
  velocity.linear.y = motion.y;
  velocity.linear.z = motion.z;
  velocity.angular.z = motion.yaw;
  checkCommand(layer::toCommand(velocity, {}));
}

}  // namespace

void run(std::string_view bytes) {
  static const Table kConversions = conversions();
  Dice dice{bytes};
  Navigation navigation{dice.byte()};
  vehicle::SteadyTime steady{std::chrono::hours{1}};
  while (!dice.empty()) {
    const unsigned what = dice.byte();
    if (what == 255) return checkMission(std::string{dice.rest()});
    if (what == 254) {
      checkCommands(dice);
      continue;
    }
    steady += std::chrono::milliseconds{what * what};
    const Frames frames = anyFrames(dice);
    navigation.take(nowAt(steady), frames);
    const auto convert = kConversions.find(frames.type);
    if (convert != kConversions.end()) {
      convert->second(frames.payload, navigation.context(nowAt(steady)));
    }
    checkJson(frames);
    checkHealth(frames);
  }
}

}  // namespace frontseat_driver::fuzz
