#include "blueye/publisher.h"

#include <blueye/control.pb.h>
#include <frontseat_driver/BlueyeMessage.h>

#include <boost/make_shared.hpp>
#include <utility>

#include "blueye/topics.h"
#include "convert.h"
#include "frontseat_driver/protocol/blueye_parse.h"
#include "transforms.h"

namespace frontseat_driver::ros_layer::blueye_layer {

namespace {

using namespace std::chrono_literals;
using protocol::parse;

constexpr std::uint32_t kQueue = 100;
// A second of everything, sonar images among it.
constexpr std::uint32_t kRecordQueue = 2000;
// Battery details hold more than the battery message: the latter is left out while they come.
constexpr auto kDetailsFresh = 5s;

bool wanted(const ros::Publisher& publisher) { return publisher.getNumSubscribers() > 0; }

std::string nameOf(const char* type) { return std::string{"blueye.protocol."} + type; }

void publishRaw(const ros::Publisher& publisher, const vehicle::Now& now, std::string_view type,
                std::string_view payload) {
  if (!wanted(publisher)) return;
  const auto message = boost::make_shared<BlueyeMessage>();
  message->header.stamp = toRosTime(now.stamp);
  message->type = std::string{type};
  message->data.assign(payload.begin(), payload.end());
  publisher.publish(boost::shared_ptr<const BlueyeMessage>{message});
}

}  // namespace

Publisher::Publisher(ros::NodeHandle node, const Options& options,
                     const protocol::BlueyeCatalogue& catalogue, Warn warn, Notify notify)
    : node_(node),
      options_(options),
      catalogue_(catalogue),
      warn_(std::move(warn)),
      notify_(std::move(notify)),
      navigation_(options.navigation),
      telemetry_(node_.advertise<BlueyeMessage>(topics::kTelemetry, kRecordQueue)),
      control_(node_.advertise<BlueyeMessage>(topics::kControlOut, kQueue)) {
  addNavigation();
  addSensors();
  addVehicle();
  if (!options_.publish_frd_frames) return;
  const NavigationOptions& names = options_.navigation;
  const auto frames = frdFrames(ros::Time::now(), names.base_frame, names.odom_frame);
  static_transforms_.sendTransform({frames.begin(), frames.end()});
}

bool Publisher::publish(const vehicle::Now& now, std::string_view type, std::string_view payload) {
  publishRaw(telemetry_, now, type, payload);
  const auto entry = table_.find(std::string{type});
  if (entry == table_.end()) return true;
  bool good = true;
  for (const Take& take : entry->second) good = take(now, payload) && good;
  return good;
}

void Publisher::beginAnew() {
  navigation_ = Navigation(options_.navigation);
  transform_stamps_ = {};
  battery_details_at_ = {};
  notified_ = {};
}

void Publisher::publishControl(const vehicle::Now& now, std::string_view type,
                               std::string_view payload) {
  publishRaw(control_, now, type, payload);
  if (type != nameOf("WaterDensityCtrl")) return;
  pb::WaterDensityCtrl told;
  if (!parse(payload, told)) return;
  const double density_kg_m3 = told.density().value();
  // A drone takes no other, whatever is sent.
  if (density_kg_m3 >= kLightestWater_kg_m3 && density_kg_m3 <= kHeaviestWater_kg_m3)
    navigation_.setWaterDensity(density_kg_m3);
}

std::vector<std::string> Publisher::types() const {
  std::vector<std::string> found;
  for (const auto& entry : table_) found.push_back(entry.first);
  return found;
}

ros::Time Publisher::stampOf(const vehicle::Now& now) const { return toRosTime(now.stamp); }

// --- The table ---

template <class Telemetry, class Function>
void Publisher::on(Function take) {
  table_[Telemetry{}.GetTypeName()].push_back(
      [take](const vehicle::Now& now, std::string_view payload) {
        Telemetry told;
        if (!parse(payload, told)) return false;
        take(now, told);
        return true;
      });
}

template <class Message>
ros::Publisher& Publisher::advertise(const char* name, bool latched) {
  ros::Publisher& publisher = publishers_[name];
  if (!publisher) publisher = node_.advertise<Message>(name, kQueue, latched);
  return publisher;
}

template <class Message>
void Publisher::send(const ros::Publisher& publisher, Message message) {
  publisher.publish(boost::make_shared<const Message>(std::move(message)));
}

template <class Telemetry, class Message>
void Publisher::topic(const char* name,
                      std::optional<Message> (*convert)(const Telemetry&, const Context&),
                      bool latched) {
  const ros::Publisher publisher = advertise<Message>(name, latched);
  table_[Telemetry{}.GetTypeName()].push_back(
      [this, publisher, convert, latched](const vehicle::Now& now, std::string_view payload) {
        if (!latched && !wanted(publisher)) return true;
        Telemetry told;
        if (!parse(payload, told)) return false;
        if (auto message = convert(told, context(now))) send(publisher, *std::move(message));
        return true;
      });
}

void Publisher::diagnose(const char* type) {
  table_[nameOf(type)].push_back([this, type](const vehicle::Now&, std::string_view payload) {
    diagnostics_[type] = catalogue_.values(type, payload);
    return true;
  });
}

void Publisher::addImu(const std::string& type, const char* data, const char* field) {
  const ros::Publisher publisher = advertise<sensor_msgs::Imu>(data);
  const ros::Publisher magnetic =
      field != nullptr ? advertise<sensor_msgs::MagneticField>(field) : ros::Publisher{};
  // All IMU messages have the same one field.
  table_[type].push_back(
      [this, publisher, magnetic](const vehicle::Now& now, std::string_view payload) {
        if (!wanted(publisher) && !(magnetic && wanted(magnetic))) return true;
        pb::Imu1Tel told;
        if (!parse(payload, told)) return false;
        if (!told.has_imu()) return true;
        sensor_msgs::Imu out;
        out.header = context(now).header("imu_link");
        out.orientation_covariance[0] = kNotMeasured;
        fill(out, told.imu(), navigation_.accelerometerFactor(), context(now));
        send(publisher, std::move(out));
        if (!magnetic) return true;
        if (auto seen = toMagneticField(told.imu(), context(now))) send(magnetic, *std::move(seen));
        return true;
      });
}

void Publisher::addNavigation() {
  const ros::Publisher imu = advertise<sensor_msgs::Imu>(topics::kImuData);
  on<pb::AttitudeTel>([this, imu](const vehicle::Now& now, const pb::AttitudeTel& told) {
    navigation_.take(told, now);
    if (wanted(imu) && !navigation_.hasImu(now)) send(imu, navigation_.imu(now, stampOf(now)));
  });
  on<pb::CalibratedImuTel>([this, imu](const vehicle::Now& now, const pb::CalibratedImuTel& told) {
    navigation_.take(told, now);
    if (wanted(imu)) send(imu, navigation_.imu(now, stampOf(now)));
  });
  on<pb::DepthTel>(
      [this](const vehicle::Now& now, const pb::DepthTel& told) { navigation_.take(told, now); });
  on<pb::DvlVelocityTel>([this](const vehicle::Now& now, const pb::DvlVelocityTel& told) {
    navigation_.take(told, now);
    if (!navigation_.dvlDisagrees()) return;
    warn_(
        "the DVL and the position estimate disagree about port and starboard; parameter "
        "dvl_y_axis tells where y of DvlVelocity points");
  });
  advertise<nav_msgs::Odometry>(topics::kOdom);
  const ros::Publisher fix = advertise<sensor_msgs::NavSatFix>(topics::kNavFix);
  on<pb::PositionEstimateTel>(
      [this, fix](const vehicle::Now& now, const pb::PositionEstimateTel& told) {
        if (navigation_.take(told, now)) publishOdometry(now);
        if (!wanted(fix)) return;
        auto message = toNavFix(told, navigation_.depth_m(now), context(now));
        if (message) send(fix, *std::move(message));
      });
  topic(topics::kPositionEstimate, toEstimate);
  topic(topics::kDepth, toDepth);
  topic(topics::kPressure, toPressure);
  topic(topics::kAltitude, toAltitude);
  topic(topics::kForwardDistance, toForwardDistance);
  topic(topics::kDvlVelocity, toDvlTwist);
  topic(topics::kDvlData, toDvl);
  topic(topics::kMagneticDeclination, toDeclination, true);
  topic(topics::kTimeReference, toTimeReference);
  topic(topics::kPilotFix, toPilotFix);
}

void Publisher::publishOdometry(const vehicle::Now& now) {
  const ros::Publisher& odom = publishers_[topics::kOdom];
  if (!options_.publish_tf && !options_.publish_map_tf && !wanted(odom)) return;
  auto odometry = navigation_.odometry(now, stampOf(now));
  if (!odometry) return;
  const auto transform = navigation_.transform(*odometry);
  if (options_.publish_tf && transform && transform_stamps_.advances(odometry->header.stamp)) {
    transforms_.sendTransform(*transform);
  }
  if (options_.publish_map_tf && navigation_.mapMoved()) {
    static_transforms_.sendTransform(*navigation_.mapTransform(odometry->header.stamp));
  }
  if (wanted(odom)) send(odom, *std::move(odometry));
}

void Publisher::addSensors() {
  const ros::Publisher magnetic = advertise<sensor_msgs::MagneticField>(topics::kImuMag);
  on<pb::CalibratedImuTel>(
      [this, magnetic](const vehicle::Now& now, const pb::CalibratedImuTel& told) {
        if (!wanted(magnetic) || !told.has_imu()) return;
        if (auto seen = toMagneticField(told.imu(), context(now))) {
          send(magnetic, *std::move(seen));
        }
      });
  topic(topics::kImuTemperature, toImuTemperature);
  addImu(nameOf("Imu1Tel"), topics::kImu1Raw, topics::kImu1Mag);
  addImu(nameOf("Imu2Tel"), topics::kImu2Raw, topics::kImu2Mag);
  addImu(nameOf("ImuHpTel"), topics::kImuHpRaw, nullptr);
  addImu(nameOf("CalibratedImuHpTel"), topics::kImuHp, nullptr);
  topic(topics::kWaterTemperature, toWaterTemperature);
  topic(topics::kCpuTemperature, toCpuTemperature);
  topic(topics::kCanisterTemperature, toCanisterTemperature);
  topic(topics::kCanisterHumidity, toHumidity);
  topic(topics::kLights, toLights);
  topic(topics::kGuestPortLights, toGuestPortLights);
  topic(topics::kLaser, toLaser);
  topic(topics::kJointStates, toCameraTilt);
  topic(topics::kJointStates, toServo);
  topic(topics::kJointStates, toMultibeamTilt);
  topic(topics::kTiltStabilization, toTiltStabilization, true);
  topic(topics::kMultibeamPing, toPing);
}

void Publisher::addVehicle() {
  topic(topics::kControlMode, toControlMode, true);
  topic(topics::kVehicleInfo, toInfo, true);
  topic(topics::kReference, toReference);
  topic(topics::kControllerHealth, toHealth);
  topic(topics::kControlForce, toWrench);
  topic(topics::kMissionProgress, toMission, true);
  topic(topics::kAutoPilot, toAutoPilot);
  topic(topics::kRecordState, toRecordState, true);
  topic(topics::kCalibrationState, toCalibration);
  topic(topics::kDiveTime, toDiveTime);
  topic(topics::kSurfaceUnitBattery, toSurfaceUnit);

  const ros::Publisher battery = advertise<sensor_msgs::BatteryState>(topics::kBattery);
  on<pb::BatteryTel>([this, battery](const vehicle::Now& now, const pb::BatteryTel& told) {
    if (told.battery().voltage() > 0.0F) battery_ = told.battery();
    if (!wanted(battery)) return;
    const auto tell = [&](const pb::Battery& one, std::size_t number) {
      const auto& details_at = battery_details_at_[number];
      if (details_at && now.steady - *details_at < kDetailsFresh) return;
      auto state = toBattery(one, static_cast<int>(number), context(now));
      if (state) send(battery, *std::move(state));
    };
    tell(told.battery(), 0);
    if (told.has_second_battery()) tell(told.second_battery(), 1);
  });
  const ros::Publisher details = advertise<BlueyeBatteryDetails>(topics::kBatteryDetails);
  on<pb::BatteryBQ40Z50Tel>(
      [this, battery, details](const vehicle::Now& now, const pb::BatteryBQ40Z50Tel& told) {
        const auto tell = [&](const pb::BatteryBQ40Z50& one, std::size_t number) {
          const auto index = static_cast<int>(number);
          if (wanted(details)) send(details, toBatteryDetails(one, index, context(now)));
          auto state = toBattery(one, index, context(now));
          if (!state) return;
          battery_details_at_[number] = now.steady;
          if (wanted(battery)) send(battery, *std::move(state));
        };
        if (told.has_battery()) tell(told.battery(), 0);
        if (told.has_second_battery()) tell(told.second_battery(), 1);
      });
  on<pb::RecordStateTel>([this](const vehicle::Now&, const pb::RecordStateTel& told) {
    if (told.has_record_state()) record_state_ = told.record_state();
  });
  on<pb::ControlModeTel>([this](const vehicle::Now&, const pb::ControlModeTel& told) {
    if (told.has_state()) control_mode_ = told.state();
  });
  advertise<BlueyeNotification>(topics::kNotifications);
  on<pb::NotificationTel>([this](const vehicle::Now& now, const pb::NotificationTel& told) {
    if (told.has_notification()) takeNotification(now, told.notification());
  });
  // By the names of the fields, so that flags of later firmware show up as well.
  table_[nameOf("ErrorFlagsTel")].push_back([this](const vehicle::Now&, std::string_view payload) {
    pb::ErrorFlagsTel told;
    if (!parse(payload, told)) return false;
    if (!told.has_error_flags()) return true;
    error_flags_.clear();
    constexpr std::size_t kPrefix = sizeof("error_flags.") - 1;
    for (const auto& [path, value] : catalogue_.values("ErrorFlagsTel", payload)) {
      if (value == "true") error_flags_.push_back(path.substr(kPrefix));
    }
    return true;
  });
  for (const char* type :
       {"VideoStorageSpaceTel", "DataStorageSpaceTel", "IperfTel", "CPUInfoTel",
        "GuestPortCurrentTel", "SystemPerformanceInfoTel", "ControllerHealthTel"}) {
    diagnose(type);
  }
}

// The drone repeats a notification with the timestamp that it had.
void Publisher::takeNotification(const vehicle::Now& now, const pb::Notification& told) {
  BlueyeNotification out = toNotification(told, context(now));
  const std::string raised =
      std::to_string(told.timestamp().seconds()) + "." + std::to_string(told.timestamp().nanos());
  const std::string name = out.name.empty() ? std::to_string(out.type) : out.name;
  if (notified_.isRepeated(name, raised) && told.has_timestamp()) return;
  if (told.has_value()) {
    const std::string url = told.value().type_url();
    const auto json = catalogue_.toJson(url.substr(url.rfind('/') + 1), told.value().value());
    out.value = json.ok ? json.text : url;
  }
  notify_(out);
  send(publishers_[topics::kNotifications], std::move(out));
}

}  // namespace frontseat_driver::ros_layer::blueye_layer
