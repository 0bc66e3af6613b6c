#include <array>
#include <chrono>
#include <string_view>
#include <variant>

#include "frontseat_driver/nmea/sentence.h"
#include "frontseat_driver/protocol/message.h"
#include "frontseat_driver/session/to_vehicle.h"
#include "fuzz.h"
#include "message_promises.h"
#include "vehicle_messages.h"

// Sentences of an NMEA vehicle as ROS messages. The first byte chooses parameters; then come lines,
// each behind a byte that tells how long after the last one it arrived, if that is no `$`.
// Checksums are left out, so that they need not be guessed.

namespace frontseat_driver::fuzz {
namespace {

namespace layer = ros_layer;
using namespace std::chrono_literals;

layer::Parameters anyParameters(unsigned flags) {
  layer::Parameters out;
  const bool shark = (flags & 1U) != 0;
  out.session.dialect = shark ? protocol::Dialect::Sandshark : protocol::Dialect::Kingfisher;
  out.stamp = static_cast<layer::StampMode>((flags >> 1U) % 3);
  if ((flags & 8U) != 0) out.compass_convention = layer::CompassConvention::Heron;
  if ((flags & 16U) != 0) out.acceleration_unit = layer::AccelerationUnit::StandardGravity;
  if ((flags & 32U) != 0) out.max_jump_m_s = 1e9;
  if ((flags & 64U) != 0) out.datum = vehicle::Position{89.9, 179.9};
  if ((flags & 128U) != 0) out.magnetic_declination_rad = -3.0;
  return out;
}

class Checks : public layer::MessageOutlet {
 public:
  bool wanted(layer::VehicleTopic) const override { return true; }

  void publish(layer::VehicleTopic topic, layer::VehicleMessage message) override {
    std::visit(
        [&](const auto& any) {
          check(any);
          checkStamp(topic, any.header.stamp);
        },
        message);
  }

 private:
  void checkStamp(layer::VehicleTopic topic, const ros::Time& stamp) {
    ros::Time& last = last_.at(static_cast<std::size_t>(topic));
    promise(stamp >= last, "a stamp goes back");
    last = stamp;
  }

  std::array<ros::Time, static_cast<std::size_t>(layer::VehicleTopic::Count)> last_;
};

class Vehicle {
 public:
  explicit Vehicle(unsigned flags) : messages_(anyParameters(flags)) {}

  void say(std::string_view line) {
    if (!line.empty() && line.front() != '$') {
      pass(std::chrono::milliseconds{100} * static_cast<unsigned char>(line.front()));
      line.remove_prefix(1);
    }
    pass(1ms);
    const auto sentence =
        nmea::parseSentence(line.substr(0, line.find('*')), nmea::ChecksumRule::Optional);
    if (!sentence) return;
    const auto reading = protocol::decode(*sentence);
    if (!reading) return;
    const auto sent_at = session::sentAt(reading->message);
    if (sent_at) take(vehicle::ClockSample{*sent_at});
    if (const auto event = session::toVehicle(reading->message)) take(*event);
  }

 private:
  void pass(std::chrono::nanoseconds duration) {
    now_.steady += duration;
    now_.utc += duration;
    now_.stamp += duration;
  }

  void take(const vehicle::Event& event) { messages_.take(now_, event, outlet_); }

  static vehicle::Now start() {
    vehicle::Now now;
    now.utc = 1416407400s;  // 2014-11-19 14:30
    now.stamp = now.utc;
    return now;
  }

  vehicle::Now now_ = start();
  layer::VehicleMessages messages_;
  Checks outlet_;
};

}  // namespace

void run(std::string_view bytes) {
  Dice dice{bytes};
  Vehicle vehicle{dice.byte()};
  while (!dice.empty()) {
    std::string_view line = dice.line();
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    vehicle.say(line);
  }
}

}  // namespace frontseat_driver::fuzz
