#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "frontseat_driver/driver/driver.h"
#include "frontseat_driver/session/session.h"

namespace frontseat_driver::ros_layer {

/// One message of a recorded `nmea/rx`.
struct RecordedLine {
  vehicle::UtcTime stamp{};     ///< when it arrived
  std::string_view connection;  ///< which connection it came by; empty in a record that has none
  std::string_view line;        ///< from the `$` on, without the line end
};

/// What of a record begins anew: it plays from an earlier time, or its driver was restarted.
enum class Restart { Record, Driver };

/// Plays a record of `nmea/rx` into a session in the place of a link. All times are those of the
/// record, so the same comes out at any speed; nothing is ever sent. No thread, no clock.
class RecordPlayer : private session::Output {
 public:
  /// Session and listener must outlive this. `on_restart` is called before anything of what begins
  /// anew is told.
  RecordPlayer(session::Session& session, driver::Listener& listener,
               std::function<void(Restart)> on_restart);

  void play(const RecordedLine& recorded);

  /// Runs a task on the session at the record's time, here and now.
  void post(const std::function<void(const vehicle::Now& now, session::Output& out)>& task);

  /// The one that the last line came by.
  const std::string& connection() const { return connection_; }

 private:
  void begin(const vehicle::Now& now, const RecordedLine& recorded);
  void beginAnew(const vehicle::Now& now, const RecordedLine& recorded, Restart what);
  void end(const vehicle::Now& now, const char* reason);
  void tickUntil(const vehicle::Now& now);

  bool send(const vehicle::Now& now, std::string_view sentence) override;
  void heard(const vehicle::Now& now, std::string_view line) override;
  void event(const vehicle::Now& now, const vehicle::Event& event) override;
  void confirmed() override {}

  session::Session& session_;
  driver::Listener& listener_;
  std::function<void(Restart)> on_restart_;
  std::optional<vehicle::Now> last_;
  std::string connection_;
  std::string line_;
  vehicle::UtcTime next_tick_{};
};

}  // namespace frontseat_driver::ros_layer
