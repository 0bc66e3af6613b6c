#include "closed_loop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "convert.h"
#include "frontseat_driver/nmea/sentence.h"

namespace frontseat_driver::closed_loop {

using namespace std::chrono_literals;

namespace {

// More steps than anything can call for at one instant.
constexpr int kMostStepsAtOnce = 1000;

// Not that of the loop, so that a mixed-up clock shows.
constexpr std::chrono::hours kSteadyStart{1};

// 2026-03-01 12:00:00 UTC, `date -u -d '2026-03-01 12:00' +%s`.
constexpr vehicle::UtcTime kNoon = std::chrono::seconds{1772366400};

std::string withoutLineEnd(std::string_view line) {
  return std::string{line.substr(0, line.find_last_not_of("\r\n") + 1)};
}

}  // namespace

void PrintTo(const Sent& sent, std::ostream* out) {
  *out << std::chrono::duration<double>(sent.at).count() << " s " << sent.sentence;
}

ros_layer::Parameters parametersFor(protocol::Dialect dialect) {
  ros_layer::Parameters parameters;
  parameters.session.dialect = dialect;
  parameters.stamp = ros_layer::StampMode::Vehicle;
  return parameters;
}

ClosedLoop::ClosedLoop(const ros_layer::Parameters& parameters, const sim::SandsharkConfig& vehicle)
    : parameters_(parameters),
      start_(vehicle.start_time),
      frontseat_(frontseatFor(vehicle)),
      session_(parameters.session),
      builder_(parameters) {
  step();
}

ClosedLoop::ClosedLoop(const ros_layer::Parameters& parameters,
                       const sim::KingfisherConfig& vehicle)
    : parameters_(parameters),
      start_(vehicle.start_time),
      frontseat_(frontseatFor(vehicle)),
      session_(parameters.session),
      builder_(parameters) {
  step();
}

std::unique_ptr<sim::Frontseat> ClosedLoop::frontseatFor(const sim::SandsharkConfig& vehicle) {
  return std::make_unique<sim::SandsharkFrontseat>(vehicle);
}

std::unique_ptr<sim::Frontseat> ClosedLoop::frontseatFor(const sim::KingfisherConfig& vehicle) {
  return std::make_unique<sim::KingfisherFrontseat>(vehicle);
}

// --- Time ---

vehicle::Now ClosedLoop::now() const {
  const vehicle::UtcTime utc = vehicleTime() + clock_error_;
  return {vehicle::SteadyTime{kSteadyStart + elapsed_}, utc,
          stamps_at_zero_ ? vehicle::UtcTime{0} : utc};
}

void ClosedLoop::pass(Duration duration) {
  const Duration end = elapsed_ + duration;
  int steps_at_once = 0;
  while (nextEvent() <= end) {
    steps_at_once = nextEvent() > elapsed_ ? 0 : steps_at_once + 1;
    // On the driver's thread it would be a loop that takes all of a processor.
    if (steps_at_once > kMostStepsAtOnce) throw std::logic_error{"steps are asked for without end"};
    elapsed_ = std::max(elapsed_, nextEvent());
    vehicleSteps();
    deliver();
    step();
  }
  elapsed_ = end;
}

Duration ClosedLoop::nextEvent() const {
  const vehicle::SteadyTime next_step = session_->nextStep();
  Duration next = next_tick_;
  if (next_step < vehicle::SteadyTime{kSteadyStart + next}) {
    next = std::max(elapsed_, next_step.time_since_epoch() - kSteadyStart);
  }
  if (!to_vehicle_.empty()) next = std::min(next, to_vehicle_.front().due);
  if (!to_driver_.empty()) next = std::min(next, to_driver_.front().due);
  return next;
}

void ClosedLoop::vehicleSteps() {
  if (elapsed_ < next_tick_) return;
  next_tick_ += frontseat_->tick();
  frontseat_->step(vehicleTime(), *this);
  if (std::exchange(vehicle_hung_up_, false)) disconnect();
}

void ClosedLoop::deliver() {
  for (; !to_vehicle_.empty() && to_vehicle_.front().due <= elapsed_; to_vehicle_.pop_front()) {
    const std::string& bytes = to_vehicle_.front().bytes;
    under_way_ -= std::min(under_way_, bytes.size());
    frontseat_->clientBytes(client_, bytes, vehicleTime());
  }
  for (; !to_driver_.empty() && to_driver_.front().due <= elapsed_; to_driver_.pop_front()) {
    if (watch.arrives) watch.arrives(to_driver_.front().bytes);
    session_->receive(now(), to_driver_.front().bytes, output());
    step();
  }
}

void ClosedLoop::step() {
  session_->step(now(), output());
  if (watch.step) watch.step();
}

// --- The link ---

void ClosedLoop::connect() {
  if (std::exchange(connected_, true)) return;
  frontseat_->clientConnected(++client_, vehicleTime());
  session_->connected(now(), output());
  step();
}

void ClosedLoop::disconnect() {
  if (!std::exchange(connected_, false)) return;
  lose();
  frontseat_->clientDisconnected(client_);
  session_->disconnected(now(), output());
  if (watch.lost) watch.lost();
  step();
}

void ClosedLoop::abandon() {
  lose();
  frontseat_->clientDisconnected(client_);
  link.delivers = false;
}

void ClosedLoop::lose() {
  to_vehicle_.clear();
  to_driver_.clear();
  under_way_ = 0;
}

// Three sentences.
bool ClosedLoop::congested() const {
  return link.congested || (link.room > 0 && under_way_ > 3UL * 80);
}

bool ClosedLoop::send(const vehicle::Now&, std::string_view sentence) {
  const bool has_room = link.room == 0 || under_way_ + sentence.size() <= link.room;
  if (!connected_ || !link.takes || !has_room) {
    if (watch.refused) watch.refused();
    return false;
  }
  const Sent sent{elapsed_, withoutLineEnd(sentence)};
  if (keeps_records_) sent_.push_back(sent);
  under_way_ += sentence.size();
  if (link.delivers) send(to_vehicle_, std::string{sentence}, link.read_every);
  if (watch.sent) watch.sent(sent);
  return true;
}

void ClosedLoop::send(sim::ClientId client, std::string_view bytes) {
  if (client != client_ || !connected_ || !link.delivers) return;
  std::string arriving = link.edit ? link.edit(bytes) : std::string{bytes};
  if (arriving.empty()) return;
  if (watch.said) watch.said(arriving);
  send(to_driver_, std::move(arriving), Duration{0});
}

// TCP keeps the order, so nothing arrives before what was sent before it.
void ClosedLoop::send(std::deque<Parcel>& way, std::string bytes, Duration least_gap) {
  if (link_random_.chance(link.corrupt)) {
    char& byte = bytes[link_random_.below(bytes.size())];
    byte = static_cast<char>(byte ^ (1 << link_random_.below(8)));
  }
  std::size_t from = 0;
  while (from < bytes.size()) {
    std::size_t size = bytes.size() - from;
    if (link_random_.chance(link.cut)) size = 1 + link_random_.below(size);
    const Duration extra{link.jitter.count() > 0
                             ? static_cast<std::int64_t>(static_cast<double>(link.jitter.count()) *
                                                         link_random_.uniform())
                             : 0};
    Duration due = elapsed_ + link.delay + extra;
    if (!way.empty()) due = std::max(due, way.back().due + least_gap);
    way.push_back({due, bytes.substr(from, size)});
    from += size;
  }
}

void ClosedLoop::disconnect(sim::ClientId client) {
  if (client == client_) vehicle_hung_up_ = true;
}

// --- What a user does ---

ros_layer::Converted ClosedLoop::convert(const Wanted& wanted) const {
  const auto north_offset_deg = builder_->northOffset_deg();
  if (const auto* behavior = std::get_if<Behavior>(&wanted)) {
    return ros_layer::toCommand(*behavior, north_offset_deg);
  }
  if (const auto* drive = std::get_if<Drive>(&wanted)) return ros_layer::toCommand(*drive);
  if (const auto* helm = std::get_if<Helm>(&wanted)) return ros_layer::toCommand(*helm);
  if (const auto* course = std::get_if<Course>(&wanted)) {
    return ros_layer::toCommand(*course, north_offset_deg);
  }
  return ros_layer::toCommand(std::get<geometry_msgs::Twist>(wanted), parameters_.max_speed_m_s,
                              parameters_.max_yaw_rate_rad_s);
}

std::string ClosedLoop::publish(const Wanted& wanted, Duration waited) {
  const auto converted = convert(wanted);
  if (const auto* refusal = std::get_if<std::string>(&converted)) {
    session_->countRefusedCommands(now(), 1, *refusal);
    return *refusal;
  }
  const auto refusal = session_->command(now(), std::get<vehicle::Command>(converted),
                                         now().steady - waited, output());
  step();
  return refusal;
}

void ClosedLoop::publishFor(const Wanted& wanted, Duration period, Duration duration) {
  for (const Duration end = elapsed_ + duration; elapsed_ < end;) {
    publish(wanted);
    pass(std::min(period, end - elapsed_));
  }
}

std::size_t ClosedLoop::request(session::Request request) {
  const std::size_t number = asked_.size();
  asked_.push_back({elapsed_, {}});
  session_->request(
      now(), std::move(request),
      [this, number](const session::Answer& answer) {
        asked_[number].answers.push_back({elapsed_, answer});
        if (watch.answered) watch.answered(number, answer);
      },
      output());
  step();
  return number;
}

std::size_t ClosedLoop::modify(const Behavior& behavior) {
  const auto converted = convert(behavior);
  const auto* refusal = std::get_if<std::string>(&converted);
  if (!refusal) {
    return request(std::get<vehicle::BehaviorCommand>(std::get<vehicle::Command>(converted)));
  }
  const session::Answer answer{false, *refusal};
  asked_.push_back({elapsed_, {{elapsed_, answer}}});
  if (watch.answered) watch.answered(asked_.size() - 1, answer);
  return asked_.size() - 1;
}

std::string ClosedLoop::payloadStatus(bool ok, const std::string& message) {
  const std::string refusal = session_->setPayloadStatus(now(), {ok, message});
  step();
  return refusal;
}

void ClosedLoop::stop() {
  session_->stop(now(), output());
  step();
}

void ClosedLoop::gate(bool open) {
  session_->setCommandsEnabled(now(), open, output());
  step();
}

void ClosedLoop::leave() {
  session_->leave(now(), output());
  step();
}

void ClosedLoop::load() {
  disconnect();
  session_.emplace(parameters_.session);
  builder_.emplace(parameters_);
  step();
}

// --- What the vehicle tells ---

void ClosedLoop::heard(const vehicle::Now&, std::string_view line) {
  if (watch.heard) watch.heard(line);
}

void ClosedLoop::navigation(const sim::Truth& truth) {
  if (watch.truth) watch.truth(truth);
  if (watch.told) return;
  truths_[truth.stamp] = truth;
  if (truths_.size() > 1000) truths_.erase(truths_.begin());
}

void ClosedLoop::event(const vehicle::Now& now, const vehicle::Event& event) {
  if (session_->dialect()) builder_->setDialect(*session_->dialect());
  if (watch.event) watch.event(now, event);
  if (const auto* control = std::get_if<vehicle::Control>(&event)) {
    reason_ = std::string{control->reason};
    commanding_ = control->commanding;
  }
  if (const auto* clock = std::get_if<vehicle::ClockSample>(&event)) builder_->take(*clock, now);
  if (const auto* imu = std::get_if<vehicle::RawImu>(&event)) builder_->take(*imu, now);
  if (const auto* fix = std::get_if<vehicle::GpsFix>(&event)) builder_->take(*fix, now);
  if (const auto* gps = std::get_if<vehicle::GpsVelocity>(&event)) builder_->take(*gps, now);
  if (const auto* velocity = std::get_if<vehicle::Velocity>(&event)) take(*velocity, now);
  const auto* navigation = std::get_if<vehicle::Navigation>(&event);
  const bool told = navigation && take(*navigation, now);
  if (watch.told) watch.told(event, told ? &odometry_ : nullptr);
}

void ClosedLoop::take(const vehicle::Velocity& velocity, const vehicle::Now& arrival) {
  builder_->take(velocity, arrival);
  if (!watch.imu) return;
  if (const auto imu = builder_->imu()) watch.imu(*imu);
}

bool ClosedLoop::take(const vehicle::Navigation& navigation, const vehicle::Now& arrival) {
  builder_->take(navigation, arrival);
  const auto odometry = builder_->odometry();
  if (!odometry) return false;
  odometry_ = *odometry;
  if (!watch.odometry) return true;
  const auto truth = truths_.find(ros_layer::toUtcTime(odometry_.header.stamp));
  if (truth != truths_.end()) watch.odometry(odometry_, truth->second);
  return true;
}

double ClosedLoop::yaw() const { return yawOf(odometry_.pose.pose.orientation); }

std::vector<Sent> ClosedLoop::sent(std::string_view address, Duration from) const {
  std::vector<Sent> found;
  for (const Sent& one : sent_) {
    if (one.at >= from && one.sentence.compare(1, address.size(), address) == 0) {
      found.push_back(one);
    }
  }
  return found;
}

// --- Words and numbers ---

std::string sentence(const std::string& body) {
  std::array<char, 8> end{};
  std::snprintf(end.data(), end.size(), "*%02X", nmea::checksum(body));
  return "$" + body + end.data();
}

std::vector<std::string> fields(const std::string& sentence) {
  std::vector<std::string> all;
  std::istringstream in{sentence.substr(1, sentence.rfind('*') - 1) + ','};
  for (std::string field; std::getline(in, field, ',');) all.push_back(field);
  return all;
}

double yawOf(const geometry_msgs::Quaternion& q) {
  return std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z));
}

double apart(double a_rad, double b_rad) {
  return std::abs(std::remainder(a_rad - b_rad, 2.0 * M_PI));
}

Drive drive(double left, double right) {
  Drive message;
  message.left = left;
  message.right = right;
  return message;
}

Helm helm(double thrust, double yaw_rate) {
  Helm message;
  message.thrust = thrust;
  message.yaw_rate = yaw_rate;
  return message;
}

Course course(double yaw, double speed) {
  Course message;
  message.yaw = yaw;
  message.speed = speed;
  return message;
}

Behavior heading(double yaw) {
  Behavior message;
  message.horizontal_mode = Behavior::HORIZONTAL_HEADING;
  message.horizontal = yaw;
  return message;
}

sim::SandsharkConfig quietSandshark() {
  sim::SandsharkConfig config;
  config.start_time = kNoon;
  config.noise = false;
  config.mission.ready_s = 1.0;
  config.mission.legs = {{{0.0, 5000.0}, 0.0, sim::Setpoint::VerticalMode::Depth, 1.5}};
  return config;
}

sim::KingfisherConfig quietKingfisher() {
  sim::KingfisherConfig config;
  config.start_time = kNoon;
  config.noise = false;
  config.waves_deg = 0.0;
  config.loop.clear();
  return config;
}

}  // namespace frontseat_driver::closed_loop
