#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "frontseat_driver/vehicle/clock.h"
#include "frontseat_driver/vehicle/command.h"
#include "frontseat_driver/vehicle/event.h"

namespace frontseat_driver::session {

/// End the mission (BPABT).
struct AbortRequest {
  std::string reason;
  bool with_errors = true;
};

/// Turn one kind of sentence on or off (BPLOG).
struct LogSwitch {
  std::string sentence;  ///< three letters, or "ALL"
  bool enable = true;
};

/// Any sentence, without `$` and checksum.
struct RawSentence {
  std::string body;
};

/// What a caller waits for. A behavior command here goes out once and is not repeated.
using Request = std::variant<AbortRequest, vehicle::BehaviorCommand, LogSwitch, RawSentence>;

/// The vehicle's final word, or why there is none.
struct Answer {
  bool success = false;
  std::string message;
};

using Respond = std::function<void(const Answer&)>;

/// A final acknowledgement in words for people: the vehicle's own, behind what its status means.
std::string finalWords(const vehicle::Acknowledgement& ack);

/// Requests that wait to be sent or answered. Each is answered exactly once: by the vehicle's final
/// acknowledgement, by its deadline, or by the end of the connection.
class RequestQueue {
 public:
  using SteadyTime = vehicle::SteadyTime;
  using Id = std::uint64_t;

  static constexpr std::size_t kMost = 64;

  struct Open {
    Id id = 0;
    Request request;
    Respond respond;
    std::string note;  ///< said with the answer, such as that a text was changed
    SteadyTime deadline{};
    SteadyTime due{};  ///< when to send it, or send it again; max() for never
    bool sent = false;
    bool pending = false;  ///< the vehicle said that it is working on it
  };

  explicit RequestQueue(std::chrono::nanoseconds ack_timeout) : ack_timeout_(ack_timeout) {}

  std::size_t size() const { return open_.size(); }
  bool full() const { return open_.size() >= kMost; }

  void add(Request request, std::string note, Respond respond, SteadyTime now);

  /// The oldest request to be sent now: an abort, or one of the others. Null if there is none.
  const Open* dueAbort(SteadyTime now) const { return due(now, true); }
  const Open* dueOther(SteadyTime now) const { return due(now, false); }

  /// The request went out. One that may be repeated without harm is due again if no answer comes;
  /// without acknowledgements, having been sent is the answer.
  void sent(Id id, SteadyTime now, bool acknowledged);

  void take(Id id, const vehicle::Acknowledgement& ack);

  /// Answers what is past its deadline, and tells which.
  std::vector<Id> expire(SteadyTime now);

  void failAll(const std::string& reason);

  /// Commanding has ended: a behavior that has not gone out yet must not go out after it.
  void failUnsentBehaviors(const std::string& reason);

  /// As that, and raw sentences too, which may be commands: everything was to end.
  void failUnsentCommands(const std::string& reason);

  SteadyTime nextDue() const;
  SteadyTime nextDeadline() const;

 private:
  using Requests = std::list<Open>;

  const Open* due(SteadyTime now, bool abort) const;
  Requests::iterator find(Id id);
  void answer(Requests::iterator open, bool success, const std::string& message);
  template <class... Kinds>
  void failUnsent(const std::string& reason);

  const std::chrono::nanoseconds ack_timeout_;
  Id last_id_ = 0;
  Requests open_;
};

}  // namespace frontseat_driver::session
