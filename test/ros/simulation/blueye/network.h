#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "frontseat_driver/link/zmq_client.h"
#include "frontseat_driver/session/blueye_session.h"
#include "frontseat_driver/sim/blueye/drone.h"
#include "frontseat_driver/sim/random.h"
#include "plan.h"

namespace frontseat_driver::blueye_simulation {

/// What passes between driver and drone, with the order in which the drone said it.
struct Word {
  std::uint64_t order = 0;  ///< of all that the drone said, whichever way it went
  std::string type;
  std::string payload;
};

/// Sees what passes. `control` and `request` are what the link took.
class Watcher {
 public:
  virtual ~Watcher() = default;
  virtual void control(std::string_view type, std::string_view payload) = 0;
  virtual void request(std::string_view type, std::chrono::milliseconds timeout) = 0;
  virtual void linkRefused() = 0;
  virtual void telemetry(const Word& word) = 0;
  virtual void reply(const Word& word) = 0;
  virtual void noReply() = 0;
  virtual void connected() = 0;
  virtual void disconnected() = 0;  ///< and the session has been told
};

/// The driver's three connections to the drone in virtual time, as link::ZmqClient makes them: each
/// in order and at its own pace, all lost together, one request at a time, a late reply thrown
/// away.
class Network : public session::BlueyeOutput, public sim::BlueyeDrone::Sink {
 public:
  using Clock = std::function<vehicle::Now()>;

  Network(Clock clock, sim::BlueyeDrone& drone, Watcher& watcher, std::uint64_t seed);

  /// Connects for this session, or for none.
  void serve(session::BlueyeSession* session);

  /// When act() has something to do.
  Duration next() const;
  /// Delivers what has arrived and does what is due.
  void act();

  void lose(const std::string& reason);
  /// What another client asks; its answer is in other_reply.
  void askAsOther(std::string_view type, const std::string& payload);

  // session::BlueyeOutput
  bool publish(const vehicle::Now& now, std::string_view type, std::string_view payload) override;
  bool request(const vehicle::Now& now, std::string_view type, std::string_view payload,
               std::chrono::milliseconds timeout) override;
  void reconnect(const vehicle::Now&, const std::string& reason) override { lose(reason); }

  // sim::BlueyeDrone::Sink
  void publish(const std::string& name, std::string data) override;
  void reply(const std::string& peer, const std::string& name, std::string data) override;
  void truth(const sim::Truth&) override {}

  /// One of the connections: first in, first out.
  struct Channel {
    Duration stalled_until{0};
    Duration slower_by{0};  ///< than the others
    Duration last_arrival{0};
    struct Passing {
      Duration at;
      std::uint64_t socket;  ///< of requests and replies
      Word word;
    };
    std::deque<Passing> passing;
  };

  Duration delay{std::chrono::milliseconds{1}};
  Duration jitter{0};
  bool takes = true;     ///< false: the control socket is full
  bool delivers = true;  ///< false: nothing arrives anywhere, and nobody says so
  bool listens = true;   ///< false: the drone's host refuses
  Channel to_telemetry, to_reply, to_control, to_request;
  std::string other_reply;
  std::uint64_t connects = 0;
  std::uint64_t failures = 0;
  std::uint64_t delivered = 0;

 private:
  void send(Channel& channel, Word word);
  bool deliverOne();
  void deliver(Channel& channel);
  void attempt();
  void checkTime();
  void drop();
  Duration elapsed() const;

  const Clock clock_;
  sim::BlueyeDrone& drone_;
  Watcher& watcher_;
  const link::ZmqClient::Options options_;
  session::BlueyeSession* session_ = nullptr;
  sim::Random random_;
  bool connected_ = false;
  std::uint64_t order_ = 0;   ///< of the drone's last word
  std::uint64_t socket_ = 0;  ///< of requests: a new one after each that got no reply
  Duration attempt_at_;
  Duration fails_at_;
  Duration reply_due_;
  Duration last_heard_{0};
};

}  // namespace frontseat_driver::blueye_simulation
