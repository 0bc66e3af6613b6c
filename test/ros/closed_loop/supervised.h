#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "closed_loop.h"

namespace frontseat_driver::closed_loop {

/// A closed loop whose every step is held against what the driver promises, by a model of its own
/// of connection, permission and command. What a user does goes through here; what the link does to
/// what is under way may be set on the loop. The vehicle may be told anything.
///
/// Promised: nothing is sent without permission but an abort, a zero thrust and the conversation;
/// spacing is kept; only the newest command is sent, never one that is older than command_timeout
/// or from before a stop; a boat hears zero in time; each request is answered once, within
/// ack_timeout; what `control` says is so; the counters add up.
class Supervised {
 public:
  Supervised(ClosedLoop& loop, const session::NmeaOptions& options, protocol::Dialect vehicle);

  void connect();
  void disconnect();
  void setTakes(bool takes);

  void publish();          ///< a command unlike all before
  void publishForeign();   ///< for the other vehicle
  void publishNonsense();  ///< with a NaN
  void stop();
  void gate(bool open);
  void leave();
  void requestAbort();
  void requestBehavior();  ///< unlike all before
  void requestLog(const std::string& sentence);

  /// The first promise that was broken, and when; empty while all are kept.
  const std::string& broken() const { return broken_; }

 private:
  struct Issued {
    Duration at{};
    std::optional<std::size_t> request;  ///< empty: a command that is repeated
    bool sent = false;
  };

  void promise(bool kept, const std::string& what);
  bool permitted() const;
  bool alive() const;  ///< there is a command, and it is fresh
  void endCommand();
  void ask(session::Request request);
  Wanted wanted(std::uint64_t number) const;
  Duration spacing() const;

  void checkSent(const Sent& sent);
  void checkCommand(const Sent& sent);
  void checkZero();
  void checkStep();
  void checkZeroInTime();
  void checkAbortInTime();
  void checkRequests();
  void checkCounters();
  void hear(std::string_view line);
  void forgetConnection();

  ClosedLoop& loop_;
  const session::NmeaOptions options_;
  const protocol::Dialect vehicle_;

  // Of this connection.
  std::optional<protocol::Dialect> dialect_;
  std::optional<bool> control_;  ///< the vehicle's last BFCTL
  std::optional<Duration> last_sent_;
  bool motion_on_wire_ = false;  ///< the last that a boat heard moves it
  bool zero_allowed_ = false;

  bool gate_open_;
  bool left_ = false;
  Duration takes_since_{0};
  std::optional<Duration> ended_;  ///< when the last command ended; empty while there is one
  std::uint64_t current_ = 0;      ///< number of the command; 0: none
  std::uint64_t last_number_ = 0;
  std::map<std::string, Issued> issued_;  ///< by what of the sentence is its own
  std::map<std::uint64_t, Duration> accepted_;
  std::vector<std::size_t> open_requests_;
  std::size_t aborts_ = 0;                    ///< that were asked for
  std::optional<std::size_t> waiting_abort_;  ///< request that is to be sent next
  std::uint64_t lines_ = 0;
  std::uint64_t bytes_sent_ = 0;
  std::uint64_t refused_ = 0;
  std::string broken_;
};

}  // namespace frontseat_driver::closed_loop
