#include <cmath>
#include <string>

#include "blueye.h"
#include "blueye/control.pb.h"
#include "blueye/req_rep.pb.h"
#include "frontseat_driver/protocol/blueye_catalogue.h"
#include "frontseat_driver/sim/blueye/drone.h"

// The simulated drone and what clients send to it: requests, control messages, and time.

namespace frontseat_driver::fuzz {
namespace {

using sim::BlueyeDrone;
using sim::UtcTime;

// So much of the drone's time that an input takes some hundredths of a second.
constexpr int kMostSteps = 120;
constexpr std::chrono::milliseconds kStep{50};

sim::BlueyeConfig anyDrone(unsigned flags) {
  sim::BlueyeConfig config;
  config.start_time = std::chrono::seconds{1772366400};
  config.multibeam.beams = 8;
  config.multibeam.ranges = 8;
  config.noise = (flags & 1U) != 0;
  config.conventions.pause_instructions = (flags & 2U) != 0;
  config.conventions.yaw_clockwise = (flags & 4U) == 0;
  if ((flags & 8U) != 0) config.devices.clear();
  if ((flags & 16U) != 0) config.environment.bottom_depth_m = 3.0;
  return config;
}

const protocol::BlueyeCatalogue& catalogue() {
  static const protocol::BlueyeCatalogue kCatalogue;
  return kCatalogue;
}

bool finite(const sim::VehicleState& state) {
  return std::isfinite(state.east_m) && std::isfinite(state.north_m) &&
         std::isfinite(state.depth_m) && std::isfinite(state.heading_rad) &&
         std::isfinite(state.roll_rad) && std::isfinite(state.pitch_rad);
}

class Visit : private BlueyeDrone::Sink {
 public:
  explicit Visit(Dice& dice) : dice_(dice), drone_(anyDrone(dice.byte())) {}

  void run() {
    pass(0);
    while (!dice_.empty()) act();
    pass(10);
    promise(answered_ == asked_, "a request was not answered once");
  }

 private:
  void act() {
    const unsigned what = dice_.byte();
    switch (what % 4) {
      case 0:
        return request(anyFrames(dice_));
      case 1:
        return control(anyFrames(dice_));
      case 2:
        return pass(static_cast<int>(what / 4));
      default:
        if (what == 255) return reboot();
        return pet(what / 4 % 4);
    }
  }

  void request(const Frames& frames) {
    ++asked_;
    drone_.request("peer", frames.type, frames.payload);
  }

  void control(const Frames& frames) { drone_.control(frames.type, frames.payload); }

  void pet(std::uint32_t id) {
    blueye::protocol::WatchdogCtrl message;
    message.set_client_id(id);
    drone_.control(message.GetTypeName(), message.SerializeAsString());
  }

  void reboot() {
    pass(0);  // what waits is lost with the drone
    drone_.reboot();
    drone_.step(drone_.now() + std::chrono::seconds{10}, *this);
    promise(drone_.online(), "it does not come back");
  }

  void pass(int steps) {
    drone_.step(drone_.now(), *this);
    for (; steps > 0 && steps_ < kMostSteps; --steps, ++steps_) {
      drone_.step(drone_.now() + kStep, *this);
      const sim::VehicleState& state = drone_.model().state();
      promise(finite(state), "the drone is nowhere");
      promise(std::hypot(state.velocity_east_m_s, state.velocity_north_m_s) < 5.0, "it flies");
    }
  }

  void publish(const std::string& name, std::string data) override {
    promise(catalogue().knows(name), "telemetry of no known type: " + name);
    blueye::protocol::PingRep any_message;  // reads any fields
    promise(any_message.ParseFromString(data), "telemetry that is no message: " + name);
  }

  void reply(const std::string& peer, const std::string& name, std::string) override {
    promise(peer == "peer" && !name.empty(), "an answer to nobody");
    ++answered_;
  }

  void truth(const sim::Truth& truth) override {
    promise(std::abs(truth.position.latitude_deg) <= 90.0, "the drone left the earth");
  }

  Dice& dice_;
  BlueyeDrone drone_;
  int steps_ = 0;
  std::size_t asked_ = 0, answered_ = 0;
};

}  // namespace

void run(std::string_view bytes) {
  Dice dice{bytes};
  Visit{dice}.run();
}

}  // namespace frontseat_driver::fuzz
