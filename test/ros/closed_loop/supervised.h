#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "closed_loop.h"
#include "ledger.h"
#include "written.h"

namespace frontseat_driver::closed_loop {

/// A closed loop whose every step is held against what the driver promises, by a model of its own
/// of connection, permission and command. What a user does goes through here; what the link does to
/// what is under way may be set on the loop. The vehicle may be told anything.
///
/// Promised: nothing is sent without permission but an abort, a zero thrust and the conversation;
/// spacing is kept; only the newest command is sent, as it was given, never one that is older than
/// command_timeout or from before a stop; a boat hears zero in time; a fresh BPRMB is repeated
/// within 5 s; an abort is next; each request is answered once, within ack_timeout, by the
/// acknowledgement of its own sentence; what is
/// to be logged is asked for on every connection; what `control` says is so; every line that came
/// is heard and every byte is counted; nothing queues up.
class Supervised {
 public:
  Supervised(ClosedLoop& loop, const ros_layer::Parameters& parameters, protocol::Dialect vehicle);

  void connect();
  void disconnect();
  void stepSystemClock(Duration by);
  void setTakes(bool takes) { loop_.link.takes = takes; }

  /// A command that reached the computer `waited` ago. Refused or taken as the model says.
  void publish(const Wanted& wanted, Duration waited = Duration{0});
  void publish();          ///< a command unlike all before
  void publishForeign();   ///< for the other vehicle
  void publishNonsense();  ///< with a NaN
  void stop();
  void gate(bool open);
  void leave();
  void load();  ///< a new driver after one that has left
  void requestAbort(const std::string& reason = "leak", bool with_errors = true);
  void requestBehavior();  ///< unlike all before
  void requestLog(const std::string& sentence, bool enable = true);
  void payloadStatus(bool ok, const std::string& message);

  /// Where the vehicle was seen last, as far as it was published.
  void seenAt(double latitude_deg, double longitude_deg);

  /// The first promise that was broken, and when; empty while all are kept.
  const std::string& broken() const { return broken_; }
  void promise(bool kept, const char* what, std::string_view detail = {});

  /// What there was to look at.
  struct Seen {
    std::uint64_t sentences_sent = 0;
    std::uint64_t commands_sent = 0;
    std::uint64_t commands_taken = 0;
    std::uint64_t commands_refused = 0;
    std::uint64_t zeros = 0;
    std::uint64_t aborts = 0;
    std::uint64_t requests = 0;
    std::uint64_t acknowledged = 0;  ///< requests that the vehicle answered
    std::uint64_t sentences_heard = 0;
  };
  const Seen& seen() const { return seen_; }

 private:
  enum class Kind { Abort, Behavior, Log };

  struct Open {
    std::size_t number = 0;
    Kind kind = Kind::Log;
    Duration at{};
    std::string text;                ///< of an abort or a log request
    bool flag = true;                ///< likewise
    std::optional<Written> written;  ///< of a behavior
    bool sent = false;
    std::vector<std::string> times;  ///< that its sentences carried
    bool acknowledged = false;       ///< finally, by a line that is being heard
  };
  struct Command {
    Written written;
    Duration received{};
  };
  struct Ack {
    std::string command;  ///< three letters
    std::string time;
    std::string status;
  };

  bool permitted() const;
  void notePermission();
  bool fillable(const Wanted& wanted) const;
  void hearPresent(std::string_view formatter, const Fields& fields);
  bool fills() const { return options_.format.fill_behavior_fields; }
  bool isBoat() const { return dialect_ == protocol::Dialect::Kingfisher; }
  bool aborting() const;
  bool alive() const;  ///< there is a command, and it is fresh
  bool expected(const std::optional<Written>& written, Duration waited) const;
  void endCommand();
  std::size_t begin(Open open);
  Wanted numbered(std::uint64_t number) const;
  static Behavior numberedBehavior(std::uint64_t number);
  Duration spacing() const;
  std::optional<double> convergence_deg(const Wanted& wanted) const;

  void checkSent(const Sent& sent);
  void checkTime(const Sent& sent, const Fields& fields);
  void checkCommand(const Sent& sent, const Fields& fields);
  bool isRequest(const Sent& sent, const Fields& fields);
  void checkAbort(const Sent& sent, const Fields& fields);
  void checkZero(const Sent& sent);
  void checkLog(const Sent& sent, const Fields& fields);
  void checkMatch(const Open& open, const session::Answer& answer);
  void checkStatus(const Sent& sent, const Fields& fields);
  void checkStep();
  void checkInTime();
  void checkLogRequests();
  void checkAnswers();
  void checkCounters();
  void hear(std::string_view line);
  void hearAck(const Fields& fields);
  void permissionHeard(bool granted);
  void answered(std::size_t number, const session::Answer& answer);
  void forgetConnection();

  ClosedLoop& loop_;
  const session::NmeaOptions options_;
  const WritingRules rules_;
  const protocol::Dialect vehicle_;
  Ledger ledger_;

  // Of this connection.
  std::optional<protocol::Dialect> dialect_;
  std::optional<bool> control_;  ///< the vehicle's last word
  std::optional<Duration> last_sent_;
  bool motion_on_wire_ = false;  ///< the last that a boat heard moves it
  bool zero_allowed_ = false;
  std::optional<Duration> heading_at_;  ///< when each was last told
  std::optional<Duration> depth_at_;
  std::optional<Duration> speed_at_;
  std::optional<Duration> asks_from_;  ///< when it became a Sandshark's
  std::set<std::string> asked_for_;    ///< by BPLOG
  std::optional<Ack> hearing_;         ///< the acknowledgement that is being heard

  bool gate_open_;
  bool left_ = false;
  bool logs_changed_ = false;    ///< by a user
  Duration refused_at_{-1};      ///< when the link last took no sentence
  Duration congested_at_{-1};    ///< when it was last seen full
  Duration permitted_since_{0};  ///< or stopped, or aborted
  bool was_permitted_ = false;
  std::optional<Duration> ended_;  ///< when the last command ended; empty while there is one
  std::optional<Command> current_;
  Duration repeated_at_{0};  ///< when it was last sent or given
  std::optional<double> grid_convergence_deg_;
  std::uint64_t last_number_ = 0;
  std::deque<Open> open_;                     ///< oldest first
  std::optional<std::size_t> waiting_abort_;  ///< request that is to be sent next
  Duration abort_asked_{0};
  Duration ambiguous_until_{0};  ///< two sentences may carry the same time
  bool status_ok_ = true;
  std::string status_text_ = "OK";
  std::uint64_t sentences_sent_ = 0;  ///< by this driver
  std::uint64_t bytes_sent_ = 0;
  std::uint64_t refused_ = 0;
  Seen seen_;
  std::string broken_;
};

}  // namespace frontseat_driver::closed_loop
