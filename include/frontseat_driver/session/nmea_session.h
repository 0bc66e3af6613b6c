#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frontseat_driver/nmea/framer.h"
#include "frontseat_driver/protocol/message.h"
#include "frontseat_driver/session/ack_tracker.h"
#include "frontseat_driver/session/command_sentence.h"
#include "frontseat_driver/session/command_slot.h"
#include "frontseat_driver/session/effect_monitor.h"
#include "frontseat_driver/session/permission.h"
#include "frontseat_driver/session/request_queue.h"
#include "frontseat_driver/session/session.h"
#include "frontseat_driver/vehicle/command.h"

namespace frontseat_driver::session {

/// What the user chose for the conversation; names and defaults as in the parameter table.
struct NmeaOptions {
  std::optional<protocol::Dialect> dialect;  ///< empty: told by the first talker heard
  std::string interface_version = "0.1";
  std::vector<std::string> log_sentences = {"NVG", "NVR", "MIS", "CTL"};
  bool use_acks = true;
  bool commands_enabled = true;
  ControlHook control_hook = ControlHook::Ctl;
  std::optional<std::chrono::milliseconds> send_spacing;  ///< empty: 60 sandshark, 20 kingfisher
  bool listen_only = false;  ///< a record is played: nothing is ever sent

  std::chrono::nanoseconds command_timeout{std::chrono::seconds{1}};
  double command_rate_hz = 5.0;
  CommandFormat format;
  std::chrono::nanoseconds ack_timeout{std::chrono::seconds{3}};
  std::chrono::nanoseconds effect_timeout{std::chrono::seconds{10}};
  std::chrono::nanoseconds max_data_age{std::chrono::seconds{2}};
  double status_rate_hz = 1.0;  ///< BPSTS; 0: none
};

/// What came in and what became of it, since the session began.
struct NmeaCounters {
  std::uint64_t bytes_received = 0;
  std::uint64_t bytes_sent = 0;
  std::uint64_t sentences_received = 0;  ///< complete lines that start with `$`
  std::uint64_t sentences_sent = 0;
  std::uint64_t decoded = 0;        ///< sentences of this dialect read into their struct
  std::uint64_t bad_checksums = 0;  ///< lines whose checksum is wrong
  std::uint64_t bad_frames = 0;     ///< lines without frame or checksum, or cut off by the next `$`
  std::uint64_t no_sentences = 0;   ///< those of them that are not in sentences_received: noise and
                                    ///< what was cut off
  std::uint64_t bad_fields = 0;     ///< single fields that did not parse
  std::uint64_t unknown = 0;        ///< well-formed sentences without a layout in this dialect
  std::uint64_t other_dialect = 0;  ///< those of them that belong to the other dialect
  std::uint64_t oversized = 0;      ///< lines longer than nmea::Framer::kMaxLine
  std::uint64_t refused_commands = 0;

  // Where every byte went: after each call of the session these four make up bytes_received.
  std::uint64_t decoded_bytes = 0;   ///< of the sentences in `decoded`
  std::uint64_t refused_bytes = 0;   ///< of all other lines, and of what is no line
  std::uint64_t line_end_bytes = 0;  ///< CR and LF
  std::uint64_t pending_bytes = 0;   ///< of a sentence that has begun and not ended
};

/// A command that came to nothing, and why.
struct CommandRefusal {
  SteadyTime at{};
  std::string words;
};

/// The conversation in either NMEA dialect (SPI 0.1, section 4; Kingfisher 0.1, sections 2 and 4).
///
/// After every connect to a Sandshark: BPVER, BPLOG ACK, then the other log sentences, one write
/// each, send_spacing apart, waiting for no answer. A Kingfisher is sent nothing that was not asked
/// for. With no dialect given, the first BF or CP talker of the connection decides; after two
/// seconds without one BPVER is sent, which a boat ignores.
///
/// Commands: one newest, repeated while it is fresh and permitted. When commanding ends, for
/// whatever reason but a lost link, a Kingfisher is sent one zero thrust and a Sandshark nothing,
/// so that it takes over again. An abort or a zero thrust goes next, ahead of anything that waits.
/// A process that stood still ends commanding, and refuses what it reads in the next fifth of a
/// second.
class NmeaSession : public Session {
 public:
  explicit NmeaSession(NmeaOptions options);

  void connected(const Now& now, Output& out) override;
  void disconnected(const Now& now, Output& out) override;
  void receive(const Now& now, std::string_view bytes, Output& out) override;
  void step(const Now& now, Output& out) override;
  SteadyTime nextStep() const override;
  void stoodStill(const Now& now, Output& out) override;
  void leave(const Now& now, Output& out) override;
  bool hasLeft() const override { return leaving_ && !zero_due_; }

  /// Takes the place of the command before. `received` is when it reached this computer. Returns
  /// why it was refused, or nothing; a refused command changes nothing.
  std::string command(const Now& now, const vehicle::Command& command, SteadyTime received,
                      Output& out);

  /// Ends commanding at once; a connected Kingfisher hears zero thrust in any case.
  void stop(const Now& now, Output& out);

  /// Opens or closes the gate. Closing ends commanding; opening revives nothing.
  void setCommandsEnabled(const Now& now, bool enabled, Output& out);

  /// Sends the request as soon as spacing allows and answers once, within ack_timeout; from inside
  /// this call if it cannot be sent. The respond function must not call the session. An abort ends
  /// commanding; a boat's also if it cannot be sent, since to a boat none can.
  void request(const Now& now, Request request, Respond respond, Output& out);

  /// What BPSTS says from now on, at once and at status_rate. Returns why it was refused, or
  /// nothing.
  std::string setPayloadStatus(const Now& now, const vehicle::PayloadStatus& status);

  /// Counts commands that were refused before they got here, and keeps why the last one was.
  void countRefusedCommands(const Now& now, std::uint64_t count, std::string words);

  /// As given or as heard on this connection; empty while not known.
  std::optional<protocol::Dialect> dialect() const { return dialect_; }

  NmeaCounters counters() const;

  ControlState control() const;

  /// Commanded and measured, where the vehicle does not follow; empty while all is well.
  const std::string& effectComplaint() const { return effect_.complaint(); }

  /// What is being repeated to the vehicle; empty when nothing is.
  const std::optional<vehicle::Command>& commanded() const { return slot_.command(); }

  /// The vehicle's last refusal of a repeated command, BFACK 0 or 1 for a BPRMB, in its own words
  /// with the status. On this connection; empty if there was none. One that a service waited for is
  /// its caller's to hear, and not here.
  const std::optional<CommandRefusal>& lastRefusal() const { return last_refusal_; }

  /// The last command that this driver would not take, and why; empty if there was none.
  const std::optional<CommandRefusal>& lastRefusedCommand() const { return last_refused_command_; }

  /// What a Sandshark is asked for on every connection, in this order.
  const std::vector<LogSwitch>& logRequests() const { return log_requests_; }

  /// Since when the link has taken no command that was due, zero thrust included, being full or
  /// congested; empty while it does, and while none is due.
  const std::optional<SteadyTime>& heldBackSince() const { return held_back_since_; }

  /// Requests that are not answered yet.
  std::size_t openRequests() const { return requests_.size(); }

  /// Commands sent that the vehicle has not acknowledged yet.
  std::size_t unacknowledged() const { return acks_.outstanding(); }

 private:
  void hear(const Now& now, std::string_view line, Output& out);
  bool take(const Now& now, const nmea::Sentence& sentence, Output& out);  ///< true: decoded
  void takeMessage(const Now& now, const protocol::Reading& reading, Output& out);
  void takeAcknowledgement(const Now& now, vehicle::Acknowledgement& ack);
  void takeMotion(const Now& now, const vehicle::Event& event);
  void count(const nmea::Failure& failure);
  void learnDialect(const Now& now, protocol::Dialect dialect, Output& out);
  void permissionChanged(const Now& now, Output& out);
  void endEverything(const Now& now, const char* why, Output& out);
  void endCommanding(const Now& now, Output& out);

  std::string refusalOf(const Now& now, const vehicle::Command& command) const;
  std::string refusalOf(const Now& now, SteadyTime received) const;
  std::string refusalOf(const Request& request, const Now& now) const;
  std::string refuseAbort(const Now& now, const std::string& refusal, Output& out);
  void remember(const LogSwitch& log);
  PresentState present(const Now& now) const;

  void sendWhatIsDue(const Now& now, Output& out);
  bool sendUrgent(const Now& now, Output& out);
  bool sendCommand(const Now& now, Output& out);
  bool sendOther(const Now& now, Output& out);
  bool sendHandshake(const Now& now, Output& out);
  bool sendRequest(const Now& now, const RequestQueue::Open& open, Output& out);
  bool sendStatus(const Now& now, Output& out);
  bool send(const Now& now, nmea::SentenceWriter sentence, Output& out);
  void holdBack(const Now& now);
  void emptySlot();
  bool isAcknowledged(const LogSwitch& log) const;
  nmea::SentenceWriter sentenceFor(const Request& request, const Now& now) const;

  void reportControl(const Now& now, Output& out);
  bool isBoat() const { return dialect_ == protocol::Dialect::Kingfisher; }
  SteadyTime nextSend() const;
  std::chrono::milliseconds sendSpacing() const;

  const NmeaOptions options_;
  std::vector<LogSwitch> log_requests_;  ///< in the order they are sent, ACK first
  bool use_acks_;

  nmea::Framer framer_;
  NmeaCounters counters_;
  Permission permission_;
  std::optional<ControlState> reported_control_;

  // Of this connection.
  std::optional<protocol::Dialect> dialect_;
  bool connected_ = false;
  bool confirmed_ = false;     ///< a good sentence was heard
  bool version_sent_ = false;  ///< BPVER went out
  std::size_t next_log_request_ = 0;
  SteadyTime handshake_due_ = SteadyTime::max();
  SteadyTime status_due_ = SteadyTime::max();
  SteadyTime next_send_{};  ///< when send_spacing allows the next sentence

  bool permitted_ = false;
  SteadyTime permitted_since_{};  ///< or stopped, or aborted: a command must not be older
  SteadyTime awake_since_{};      ///< what was read before may be of any age

  CommandSlot slot_;
  std::optional<SteadyTime> held_back_since_;
  bool zero_due_ = false;          ///< a Kingfisher is to hear zero thrust
  bool command_was_last_ = false;  ///< so that a fast publisher leaves room for everything else
  bool leaving_ = false;
  RequestQueue requests_;
  AckTracker acks_;
  EffectMonitor effect_;
  std::optional<CommandRefusal> last_refusal_;
  std::optional<CommandRefusal> last_refused_command_;
  vehicle::PayloadStatus payload_status_{true, "OK"};
  PresentState present_;
  SteadyTime navigation_at_{};
  SteadyTime velocity_at_{};
};

}  // namespace frontseat_driver::session
