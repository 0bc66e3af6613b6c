#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <string>
#include <string_view>

#include "frontseat_driver/vehicle/clock.h"

namespace frontseat_driver::session {

/// Where the output of a BlueyeSession goes. All calls come from inside the session's own calls.
class BlueyeOutput {
 public:
  virtual ~BlueyeOutput() = default;

  /// A control message for the drone; false if the link did not take it.
  virtual bool publish(const vehicle::Now& now, std::string_view type,
                       std::string_view payload) = 0;

  /// A request to the drone; false if the link cannot send it now. Its reply, or word that there is
  /// none within `timeout`, comes back to the session.
  virtual bool request(const vehicle::Now& now, std::string_view type, std::string_view payload,
                       std::chrono::milliseconds timeout) = 0;

  /// These connections are worth nothing any more: others are to be made.
  virtual void reconnect(const vehicle::Now& now, const std::string& reason) = 0;
};

/// What became of a request. The views hold while the answer is given.
struct BlueyeReply {
  bool received = false;
  std::string_view type;     ///< with package; empty if there was no reply
  std::string_view payload;  ///< empty if there was no reply
  std::string reason;        ///< why there was none
};

/// One request at a time, since the drone answers in order; the others wait. Every request is
/// answered exactly once: by the reply, by word that there is none or that it expired, or by
/// failAll().
class BlueyeRequests {
 public:
  /// May make new requests.
  using Respond = std::function<void(const vehicle::Now&, const BlueyeReply&, BlueyeOutput&)>;
  /// Makes a payload when it is sent, which may be later: those before it are answered first.
  using Payload = std::function<std::string(const vehicle::Now&)>;

  static constexpr std::size_t kMost = 256;

  /// `type` with package. A full queue answers at once. What has not been sent at `expires` is not
  /// sent any more.
  void add(const vehicle::Now& now, std::string type, std::string payload,
           std::chrono::milliseconds timeout, Respond respond, BlueyeOutput& out,
           vehicle::SteadyTime expires = vehicle::SteadyTime::max());
  void add(const vehicle::Now& now, std::string type, Payload payload,
           std::chrono::milliseconds timeout, Respond respond, BlueyeOutput& out,
           vehicle::SteadyTime expires = vehicle::SteadyTime::max());

  void reply(const vehicle::Now& now, std::string_view type, std::string_view payload,
             BlueyeOutput& out);
  void noReply(const vehicle::Now& now, const std::string& reason, BlueyeOutput& out);

  /// Sends the first one, if none is under way.
  void step(const vehicle::Now& now, BlueyeOutput& out);

  /// SteadyTime::max() while there is nothing to send.
  vehicle::SteadyTime nextStep() const;

  /// Answers all, but not the one under way if it is of the type `but`.
  void failAll(const vehicle::Now& now, const std::string& reason, BlueyeOutput& out,
               std::string_view but = {});

 private:
  struct Waiting {
    std::string type;
    Payload payload;
    std::chrono::milliseconds timeout;
    Respond respond;
    vehicle::SteadyTime expires;
  };

  void answer(const vehicle::Now& now, const BlueyeReply& reply, BlueyeOutput& out);

  std::deque<Waiting> waiting_;  ///< the first is under way if under_way_
  bool under_way_ = false;
  vehicle::SteadyTime retry_at_{};
};

}  // namespace frontseat_driver::session
