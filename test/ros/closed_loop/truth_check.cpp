#include "truth_check.h"

#include <cmath>
#include <functional>

#include "convert.h"

namespace frontseat_driver::closed_loop {

using namespace std::chrono_literals;
using protocol::Dialect;

namespace {

constexpr std::size_t kMostMoments = 256;
constexpr std::size_t kMostSaid = 4096;
constexpr Duration kSettles = 70s;  // beyond the window of the clock estimate
constexpr Duration kEarly = 60ms;   // what drift and its estimate take
constexpr double kRadian = M_PI / 180.0;
constexpr double kJump_m_s = 50.0;

struct Vector {
  double x = 0.0, y = 0.0, z = 0.0;
};

/// WGS84, height 0; from the definition of the ellipsoid.
Vector earthCentred(double latitude_deg, double longitude_deg) {
  constexpr double kA = 6378137.0;
  constexpr double kE2 = 6.69437999014e-3;
  const double sin_latitude = std::sin(latitude_deg * kRadian);
  const double cos_latitude = std::cos(latitude_deg * kRadian);
  const double n = kA / std::sqrt(1.0 - kE2 * sin_latitude * sin_latitude);
  return {n * cos_latitude * std::cos(longitude_deg * kRadian),
          n * cos_latitude * std::sin(longitude_deg * kRadian), n * (1.0 - kE2) * sin_latitude};
}

/// East and north of `datum` in its tangent plane.
Vector tangent(const vehicle::Position& datum, const nmea::LatLon& position) {
  const Vector from = earthCentred(datum.latitude_deg, datum.longitude_deg);
  const Vector to = earthCentred(position.latitude_deg, position.longitude_deg);
  const Vector d{to.x - from.x, to.y - from.y, to.z - from.z};
  const double sin_lon = std::sin(datum.longitude_deg * kRadian);
  const double cos_lon = std::cos(datum.longitude_deg * kRadian);
  const double outward = cos_lon * d.x + sin_lon * d.y;
  return {cos_lon * d.y - sin_lon * d.x,
          std::cos(datum.latitude_deg * kRadian) * d.z -
              std::sin(datum.latitude_deg * kRadian) * outward,
          0.0};
}

double apart_m(const vehicle::Position& a, const nmea::LatLon& b) {
  const Vector d = tangent(a, b);
  return std::hypot(d.x, d.y);
}

}  // namespace

TruthCheck::TruthCheck(ClosedLoop& loop, Supervised& supervised,
                       const ros_layer::Parameters& parameters, Dialect vehicle,
                       const TruthLimits& limits)
    : loop_(loop),
      supervised_(supervised),
      mode_(parameters.stamp),
      vehicle_(vehicle),
      limits_(limits),
      datum_(parameters.datum),
      settled_at_(kSettles) {
  loop_.watch.truth = [this](const sim::Truth& truth) { takeTruth(truth); };
  loop_.watch.said = [this](std::string_view bytes) { said(bytes); };
  loop_.watch.told = [this](const vehicle::Event& event, const nav_msgs::Odometry* odometry) {
    told(event, odometry);
  };
  loop_.watch.heard = [this, before = loop_.watch.heard](std::string_view line) {
    before(line);
    heard(line);
  };
}

void TruthCheck::clocksChanged() {
  settled_at_ = loop_.elapsed() + kSettles;
  slowest_ = Duration{0};
  moments_.clear();
  said_.clear();  // what is under way may carry a time that comes again
}

void TruthCheck::driverLoaded() {
  stamps_ = {};
  datum_.reset();
  last_.reset();
  settled_at_ = loop_.elapsed() + kSettles;
}

void TruthCheck::takeTruth(const sim::Truth& truth) {
  const auto ahead = vehicle_ == Dialect::Kingfisher ? 18s : 0s;  // GPS time
  const auto day = std::chrono::duration_cast<std::chrono::milliseconds>(truth.stamp + ahead) % 24h;
  moments_.push_back({day.count(), loop_.elapsed(), truth});
  if (moments_.size() > kMostMoments) moments_.pop_front();
}

void TruthCheck::said(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\r');
    const std::string_view line = bytes.substr(0, end);
    if (!line.empty() && line.front() == '$') said_.push_back(std::hash<std::string_view>{}(line));
    if (end == std::string_view::npos) break;
    bytes.remove_prefix(std::min(bytes.size(), bytes.find_first_not_of("\r\n", end)));
  }
  if (said_.size() > kMostSaid) said_.erase(said_.begin(), said_.begin() + kMostSaid / 2);
}

// Lines arrive in the order they were said; one that is not among them was spoilt on the way.
void TruthCheck::heard(std::string_view line) {
  line_ = {};
  const std::size_t hash = std::hash<std::string_view>{}(line);
  for (std::size_t i = 0; i < said_.size(); ++i) {
    if (said_[i] != hash) continue;
    said_.erase(said_.begin(), said_.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    if (isSound(line)) line_ = line;
    return;
  }
}

const TruthCheck::Moment* TruthCheck::momentOf(std::string_view time) const {
  const auto written = milliseconds(time);
  if (!written) return nullptr;
  for (auto moment = moments_.rbegin(); moment != moments_.rend(); ++moment) {
    if (moment->day_ms == *written % (24L * 3600 * 1000)) return &*moment;
  }
  return nullptr;
}

void TruthCheck::told(const vehicle::Event& event, const nav_msgs::Odometry* odometry) {
  if (const auto* navigation = std::get_if<vehicle::Navigation>(&event)) {
    checkNavigation(*navigation, odometry);
  } else if (const auto* velocity = std::get_if<vehicle::Velocity>(&event)) {
    checkVelocity(*velocity);
  } else if (std::holds_alternative<vehicle::RawImu>(event)) {
    if (const auto raw = loop_.builder().rawImu()) checkOrder(kRawImu, raw->header.stamp);
  }
}

void TruthCheck::checkNavigation(const vehicle::Navigation& navigation,
                                 const nav_msgs::Odometry* odometry) {
  ros_layer::MessageBuilder& builder = loop_.builder();
  if (const auto depth = builder.depth()) checkOrder(kDepth, depth->header.stamp);
  if (const auto altitude = builder.altitude()) checkOrder(kAltitude, altitude->header.stamp);
  const ros::Time stamp_before = stamps_[kOdometry];
  const auto before = last_;
  const Duration before_at = last_at_;
  if (odometry != nullptr) {
    last_ = navigation.position;
    last_at_ = loop_.elapsed();
    checkOrder(kOdometry, odometry->header.stamp);
    if (const auto tf = builder.transform(*odometry)) checkOrder(kTransform, tf->header.stamp);
    if (const auto& place = navigation.position) {
      supervised_.seenAt(place->latitude_deg, place->longitude_deg);
      if (!datum_) datum_ = place;
    }
  }
  if (line_.empty()) return;
  const Fields fields{line_};
  const Moment* moment = momentOf(fields.at[12].empty() ? fields.at[1] : fields.at[12]);
  if (moment == nullptr || fields.at[0] != (isBoat() ? "CPNVG" : "BFNVG")) return;
  const sim::Truth& truth = moment->truth;
  const bool zero = navigation.position && navigation.position->latitude_deg == 0.0 &&
                    navigation.position->longitude_deg == 0.0;
  if (fields.at[2].empty() || zero) {
    return supervised_.promise(odometry == nullptr, "a position that the vehicle did not tell");
  }
  if (odometry == nullptr) {
    const double elapsed_s =
        std::max(0.1, std::chrono::duration<double>(loop_.elapsed() - before_at).count());
    const bool jump = before && apart_m(*before, truth.position) > kJump_m_s * elapsed_s - 1.0;
    ++seen_.jumps;
    return supervised_.promise(jump && ++dropped_ < 5, "a position was not published");
  }
  dropped_ = 0;
  slowest_ = std::max(slowest_, loop_.elapsed() - moment->at);
  checkPosition(truth, *odometry);
  checkAttitude(truth, *odometry);
  // One that would have gone back is held where the last one was.
  if (odometry->header.stamp > stamp_before) checkStamp(odometry->header.stamp, *moment);
}

void TruthCheck::checkPosition(const sim::Truth& truth, const nav_msgs::Odometry& odometry) {
  ++seen_.positions;
  const Vector expected = tangent(*datum_, truth.position);
  const auto& position = odometry.pose.pose.position;
  const double off_m = std::hypot(position.x - expected.x, position.y - expected.y);
  supervised_.promise(off_m <= limits_.position_m, "odom is not where the vehicle is");
  const double depth_m =
      limits_.zero_depth || vehicle_ == Dialect::Kingfisher ? 0.0 : truth.state.depth_m;
  supervised_.promise(std::abs(position.z + depth_m) <= 0.002, "odom has the wrong depth");
  const auto fix = loop_.builder().navFix();
  if (!fix) return supervised_.promise(false, "no nav/fix with an odom");
  checkOrder(kFix, fix->header.stamp);
  const vehicle::Position place{fix->latitude, fix->longitude};
  supervised_.promise(apart_m(place, truth.position) <= limits_.position_m, "nav/fix is wrong");
}

// x east, y north, z up; x bow, y port, z up.
void TruthCheck::checkAttitude(const sim::Truth& truth, const nav_msgs::Odometry& odometry) {
  const sim::VehicleState& state = truth.state;
  double heading = state.heading_rad;
  const double east = state.velocity_east_m_s;
  const double north = state.velocity_north_m_s;
  if (limits_.course_heading && std::hypot(east, north) > 0.2) heading = std::atan2(east, north);
  const bool blank = limits_.blank_attitude;
  const double pitch = blank ? 0.0 : state.pitch_rad;  // bow up
  const auto& q = odometry.pose.pose.orientation;
  // The bow's direction.
  const double bow_east = 1.0 - 2.0 * (q.y * q.y + q.z * q.z);
  const double bow_north = 2.0 * (q.x * q.y + q.w * q.z);
  const double bow_up = 2.0 * (q.x * q.z - q.w * q.y);
  const double off =
      std::hypot(bow_east - std::sin(heading) * std::cos(pitch),
                 bow_north - std::cos(heading) * std::cos(pitch), bow_up - std::sin(pitch));
  supervised_.promise(off < 0.001, "the bow points elsewhere");
  // How far the port side is up.
  const double port_up = 2.0 * (q.y * q.z + q.w * q.x);
  const double roll = blank ? 0.0 : state.roll_rad;
  supervised_.promise(std::abs(port_up - std::sin(roll) * std::cos(pitch)) < 0.001,
                      "the port side is not where it is");
}

void TruthCheck::checkVelocity(const vehicle::Velocity& velocity) {
  ros_layer::MessageBuilder& builder = loop_.builder();
  const auto imu = builder.imu();
  if (imu) checkOrder(kImu, imu->header.stamp);
  const auto published = builder.navVelocity();
  if (published) checkOrder(kVelocity, published->header.stamp);
  if (line_.empty()) return;
  const Fields fields{line_};
  const Moment* moment = momentOf(fields.at[1]);
  if (moment == nullptr || fields.at[0] != (isBoat() ? "CPNVR" : "BFNVR")) return;
  ++seen_.velocities;
  const sim::VehicleState& state = moment->truth.state;
  if (published) {
    const auto& linear = published->twist.linear;
    const double off =
        std::hypot(linear.x - state.velocity_east_m_s, linear.y - state.velocity_north_m_s);
    supervised_.promise(off < 0.001, "nav/velocity is wrong");
    supervised_.promise(std::abs(linear.z + state.velocity_down_m_s) < 0.001 || !velocity.down_m_s,
                        "nav/velocity is wrong upwards");
  }
  if (!imu || imu->angular_velocity_covariance[0] < 0.0) return;
  const auto& rate = imu->angular_velocity;
  const double off = std::hypot(rate.x - state.roll_rate_rad_s, rate.y + state.pitch_rate_rad_s,
                                rate.z + state.yaw_rate_rad_s);
  supervised_.promise(off < 0.001, "imu/data turns otherwise");
}

void TruthCheck::checkStamp(const ros::Time& stamp, const Moment& moment) {
  if (loop_.elapsed() < settled_at_) return;
  ++seen_.stamps;
  const vehicle::Now now = loop_.now();
  const Duration age = now.stamp - ros_layer::toUtcTime(stamp);
  const Duration real_age = loop_.elapsed() - moment.at;
  if (mode_ == ros_layer::StampMode::Receive) {
    return supervised_.promise(age == 0ns, "a stamp is not that of receipt");
  }
  if (mode_ == ros_layer::StampMode::Vehicle) {
    // The date is this computer's, so only clocks less than half a day apart agree on it.
    const Duration off = ros_layer::toUtcTime(stamp) - moment.truth.stamp;
    const bool days_off = off % 24h == 0ns && std::chrono::abs(now.utc - moment.truth.stamp) > 11h;
    return supervised_.promise(off == 0ns || days_off, "a stamp is not the vehicle's");
  }
  supervised_.promise(age >= 0ns, "a stamp is yet to come");
  supervised_.promise(age <= real_age + kEarly && age >= real_age - slowest_ - kEarly,
                      "a stamp is not when it was measured");
}

void TruthCheck::checkOrder(Topic topic, const ros::Time& stamp) {
  supervised_.promise(stamp >= stamps_[topic], "a stamp went back");
  stamps_[topic] = stamp;
}

}  // namespace frontseat_driver::closed_loop
