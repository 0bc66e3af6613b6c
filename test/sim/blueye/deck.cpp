#include "deck.h"

namespace frontseat_driver::sim {
namespace {

constexpr std::chrono::milliseconds kPetPeriod{500};

}  // namespace

BlueyeConfig quietDrone() {
  BlueyeConfig config;
  config.noise = false;
  config.buoyancy_n = 0.0;
  config.start_time = kBlueyeNoon;
  return config;
}

std::uint32_t Deck::connect(bool observer) {
  bp::ConnectClientReq request;
  request.mutable_client_info()->set_type("test");
  request.mutable_client_info()->set_is_observer(observer);
  const auto reply = ask<bp::ConnectClientRep>(request);
  if (!reply) return 0;
  if (!observer) pets = reply->client_id();
  return reply->client_id();
}

void Deck::run(double s) {
  const UtcTime end =
      drone.now() + std::chrono::duration_cast<UtcTime>(std::chrono::duration<double>{s});
  while (drone.now() < end) {
    if (pets != 0 && drone.now() >= next_pet_) {
      bp::WatchdogCtrl watchdog;
      watchdog.set_client_id(pets);
      tell(watchdog);
      next_pet_ = drone.now() + kPetPeriod;
    }
    drone.step(std::min<UtcTime>(end, drone.now() + BlueyeDrone::kTick), *this);
  }
}

bool Deck::runUntil(const std::function<bool()>& done, double limit_s) {
  for (double passed = 0.0; !done(); passed += 0.1) {
    if (passed >= limit_s) return false;
    run(0.1);
  }
  return true;
}

void Deck::push(float surge, float sway, float heave, float yaw) {
  bp::MotionInputCtrl message;
  message.mutable_motion_input()->set_surge(surge);
  message.mutable_motion_input()->set_sway(sway);
  message.mutable_motion_input()->set_heave(heave);
  message.mutable_motion_input()->set_yaw(yaw);
  tell(message);
}

std::vector<int> Deck::notifications() const {
  std::vector<int> types;
  const auto found = published.find("blueye.protocol.NotificationTel");
  if (found == published.end()) return types;
  for (const std::string& data : found->second) {
    bp::NotificationTel message;
    message.ParseFromString(data);
    types.push_back(message.notification().type());
  }
  return types;
}

}  // namespace frontseat_driver::sim
