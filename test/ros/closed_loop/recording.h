#pragma once

#include <ros/serialization.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "closed_loop.h"
#include "record_player.h"
#include "vehicle_messages.h"

namespace frontseat_driver::closed_loop {

using ros_layer::VehicleMessage;
using ros_layer::VehicleTopic;

/// One message as it goes over the wire.
struct Published {
  VehicleTopic topic{};
  std::string bytes;

  bool operator==(const Published& other) const {
    return topic == other.topic && bytes == other.bytes;
  }
};

/// Everything that would be published, in order.
class Outlet : public ros_layer::MessageOutlet {
 public:
  bool wanted(VehicleTopic) const override { return true; }

  void publish(VehicleTopic topic, VehicleMessage message) override {
    if (watch) watch(topic, message);
    if (topic == VehicleTopic::Control) return;  // depends on the link and on commands
    if (auto* ack = std::get_if<CommandAck>(&message)) {
      ack->round_trip = std::numeric_limits<double>::quiet_NaN();  // what was sent is not replayed
    }
    published.push_back({topic, std::visit([](const auto& any) { return bytesOf(any); }, message)});
  }

  std::vector<Published> published;
  std::function<void(VehicleTopic, const VehicleMessage&)> watch;

 private:
  template <class Message>
  static std::string bytesOf(const Message& message) {
    std::string bytes(ros::serialization::serializationLength(message), '\0');
    ros::serialization::OStream out(reinterpret_cast<std::uint8_t*>(&bytes[0]),
                                    static_cast<std::uint32_t>(bytes.size()));
    ros::serialization::serialize(out, message);
    return bytes;
  }
};

/// A message of `nmea/rx`.
struct RecordLine {
  vehicle::UtcTime stamp{};
  std::string connection;
  std::string line;

  bool operator==(const RecordLine& other) const {
    return stamp == other.stamp && connection == other.connection && line == other.line;
  }
};

/// Takes down what a driver hears and publishes, as the bridge does it.
class Recording {
 public:
  /// `driver` tells one run of the driver from another.
  Recording(ClosedLoop& loop, const ros_layer::Parameters& parameters,
            const std::string& driver = "1778450400.000")
      : loop_(loop), messages_(parameters), driver_(driver) {
    loop.watch.event = [this](const vehicle::Now& now, const vehicle::Event& event) {
      const auto dialect = loop_.session().dialect();
      if (dialect) messages_.builder().setDialect(*dialect);
      messages_.take(guarded(now), event, outlet);
    };
    loop.watch.heard = [this](std::string_view line) {
      record.push_back({guarded(loop_.now()).stamp,
                        "connection_" + std::to_string(connects_) + "@" + driver_,
                        std::string{line}});
    };
  }

  /// Lets the time pass; connects whenever there is no connection.
  void pass(Duration duration) {
    for (const Duration end = loop_.elapsed() + duration; loop_.elapsed() < end;) {
      if (!loop_.connected()) {
        ++connects_;
        loop_.connect();
      }
      loop_.passUntil([&] { return !loop_.connected(); }, end - loop_.elapsed());
    }
  }

  std::vector<RecordLine> record;
  Outlet outlet;

 private:
  // As HostClocks does it.
  vehicle::Now guarded(vehicle::Now now) {
    last_ = std::max(last_, now.stamp);
    now.stamp = last_;
    return now;
  }

  ClosedLoop& loop_;
  ros_layer::VehicleMessages messages_;
  const std::string driver_;
  int connects_ = 0;
  vehicle::UtcTime last_{};
};

/// Plays a record, as the bridge does it.
class Playing : private driver::Listener {
 public:
  explicit Playing(const ros_layer::Parameters& parameters)
      : session_(listening(parameters.session)),
        messages_(parameters),
        player_(session_, *this, [this](ros_layer::Restart what) {
          if (what == ros_layer::Restart::Driver) return messages_.builder().startAfresh();
          messages_.builder().reset();
        }) {}

  void play(const std::vector<RecordLine>& lines) {
    for (const RecordLine& one : lines) player_.play({one.stamp, one.connection, one.line});
  }

  const session::NmeaSession& session() const { return session_; }

  std::vector<RecordLine> record;
  Outlet outlet;
  std::vector<std::string> connections;  ///< and why they ended

 private:
  static session::NmeaOptions listening(session::NmeaOptions options) {
    options.listen_only = true;
    return options;
  }

  void onConnected(const vehicle::Now&, const std::string& endpoint) override {
    connections.push_back(endpoint);
  }
  void onDisconnected(const vehicle::Now&, const std::string& reason) override {
    connections.push_back(reason);
  }
  void onConnectFailed(const vehicle::Now&, const std::string&,
                       std::chrono::milliseconds) override {}
  void onHeard(const vehicle::Now& now, std::string_view line) override {
    record.push_back({now.stamp, player_.connection(), std::string{line}});
  }
  void onSent(const vehicle::Now&, std::string_view) override {}
  void onEvent(const vehicle::Now& now, const vehicle::Event& event) override {
    if (session_.dialect()) messages_.builder().setDialect(*session_.dialect());
    messages_.take(now, event, outlet);
  }
  void onTick(const vehicle::Now&) override {}

  session::NmeaSession session_;
  ros_layer::VehicleMessages messages_;
  ros_layer::RecordPlayer player_;
};

}  // namespace frontseat_driver::closed_loop
