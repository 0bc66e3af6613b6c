#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "frontseat_driver/sim/blueye/drone.h"
#include "messages.h"

namespace frontseat_driver::sim {

/// 2026-03-01 12:00:00 UTC.
constexpr UtcTime kBlueyeNoon = std::chrono::seconds{1772366400};

/// A drone without noise, at the surface over 20 m of water, bow north.
BlueyeConfig quietDrone();

/// A drone in virtual time with everything it says.
class Deck : public BlueyeDrone::Sink {
 public:
  explicit Deck(const BlueyeConfig& config = quietDrone()) : drone(config) {}

  /// Sends a control message.
  template <class Message>
  void tell(const Message& message) {
    drone.control(message.GetTypeName(), message.SerializeAsString());
  }

  /// Sends a request and takes its answer; empty if there was none, or one of another name.
  template <class Reply, class Request>
  std::optional<Reply> ask(const Request& request) {
    replies.clear();
    drone.request("peer", request.GetTypeName(), request.SerializeAsString());
    drone.step(drone.now(), *this);
    Reply reply;
    if (replies.size() != 1 || replies[0].first != reply.GetTypeName()) return std::nullopt;
    if (!reply.ParseFromString(replies[0].second)) return std::nullopt;
    return reply;
  }

  /// Connects as somebody who wants control, and keeps the watchdog happy while time runs.
  std::uint32_t connect(bool observer = false);

  /// Lets `s` seconds pass; a watchdog every half second for `pets`, unless it is 0.
  void run(double s);
  /// Lets time pass until `done`, or `limit_s`; false then.
  bool runUntil(const std::function<bool()>& done, double limit_s);

  /// The newest telemetry of its kind; a message of defaults if none came yet.
  template <class Message>
  Message latest() const {
    Message message;
    const auto found = published.find(message.GetTypeName());
    if (found != published.end()) message.ParseFromString(found->second.back());
    return message;
  }
  template <class Message>
  std::size_t count() const {
    const auto found = published.find(Message{}.GetTypeName());
    return found == published.end() ? 0 : found->second.size();
  }

  /// Pushes the stick.
  void push(float surge, float sway, float heave, float yaw);
  const VehicleState& state() const { return drone.model().state(); }

  /// All kinds of notifications so far.
  std::vector<int> notifications() const;

  void publish(const std::string& name, std::string data) override {
    published[name].push_back(std::move(data));
  }
  void reply(const std::string&, const std::string& name, std::string data) override {
    replies.emplace_back(name, std::move(data));
  }
  void truth(const Truth& truth) override { truths.push_back(truth); }

  BlueyeDrone drone;
  std::uint32_t pets = 0;  ///< whose watchdog is sent
  std::map<std::string, std::vector<std::string>> published;
  std::vector<std::pair<std::string, std::string>> replies;
  std::vector<Truth> truths;

 private:
  UtcTime next_pet_{0};
};

}  // namespace frontseat_driver::sim
