#pragma once

#include <frontseat_driver/Sentence.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include <functional>
#include <mutex>
#include <optional>

#include "frontseat_driver/driver/driver.h"
#include "frontseat_driver/session/session.h"

namespace frontseat_driver::ros_layer {

/// Plays a recorded `nmea/rx` into a session in the place of a link. Time is what the record says,
/// so the same comes out at any speed; nothing is ever sent.
class Replay : private session::Output {
 public:
  /// Session and listener must outlive this.
  Replay(ros::NodeHandle node, session::Session& session, driver::Listener& listener);

  /// Runs a task on the session at the record's time, here and now.
  void post(const std::function<void(const vehicle::Now& now, session::Output& out)>& task);

  /// Hears nothing more.
  void close() { subscriber_.shutdown(); }

 private:
  void take(const Sentence& sentence);
  void begin(const vehicle::Now& now);
  void tickUntil(const vehicle::Now& now);

  bool send(const vehicle::Now& now, std::string_view sentence) override;
  void heard(const vehicle::Now& now, std::string_view line) override;
  void event(const vehicle::Now& now, const vehicle::Event& event) override;
  void confirmed() override {}

  std::mutex mutex_;  ///< of everything below: services come on threads of their own
  session::Session& session_;
  driver::Listener& listener_;
  std::optional<vehicle::Now> last_;
  vehicle::UtcTime next_tick_{};
  ros::Subscriber subscriber_;
};

}  // namespace frontseat_driver::ros_layer
