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
#include "frontseat_driver/session/permission.h"
#include "frontseat_driver/session/session.h"

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
  std::uint64_t bad_fields = 0;     ///< single fields that did not parse
  std::uint64_t unknown = 0;        ///< well-formed sentences without a layout in this dialect
  std::uint64_t other_dialect = 0;  ///< those of them that belong to the other dialect
  std::uint64_t oversized = 0;      ///< lines longer than nmea::Framer::kMaxLine
  std::uint64_t refused_commands = 0;
};

/// The conversation in either NMEA dialect (SPI 0.1, section 4; Kingfisher 0.1, section 2).
///
/// After every connect to a Sandshark: BPVER, BPLOG ACK, then the other log sentences, one write
/// each, send_spacing apart, waiting for no answer. A Kingfisher is sent nothing. With no dialect
/// given, the first BF or CP talker of the connection decides; after two seconds without one BPVER
/// is sent, which a boat ignores.
class NmeaSession : public Session {
 public:
  explicit NmeaSession(NmeaOptions options);

  void connected(const Now& now, Output& out) override;
  void disconnected(const Now& now, Output& out) override;
  void receive(const Now& now, std::string_view bytes, Output& out) override;
  void step(const Now& now, Output& out) override;
  SteadyTime nextStep() const override;

  /// As given or as heard on this connection; empty while not known.
  std::optional<protocol::Dialect> dialect() const { return dialect_; }

  NmeaCounters counters() const;

 private:
  void hear(const Now& now, std::string_view line, Output& out);
  void take(const Now& now, const nmea::Sentence& sentence, Output& out);
  void takeMessage(const Now& now, const protocol::Message& message, Output& out);
  void count(const nmea::Failure& failure);
  void learnDialect(const Now& now, protocol::Dialect dialect, Output& out);
  void continueHandshake(const Now& now, Output& out);
  bool send(const Now& now, nmea::SentenceWriter sentence, Output& out);
  void reportControl(const Now& now, Output& out);
  std::chrono::milliseconds sendSpacing() const;

  const NmeaOptions options_;
  const std::vector<std::string> log_requests_;  ///< in the order they are sent

  nmea::Framer framer_;
  NmeaCounters counters_;
  Permission permission_;
  std::optional<ControlState> reported_control_;

  std::optional<protocol::Dialect> dialect_;
  bool connected_ = false;
  bool confirmed_ = false;     ///< a good sentence was heard on this connection
  bool version_sent_ = false;  ///< BPVER went out on this connection
  std::size_t next_log_request_ = 0;
  SteadyTime handshake_due_ = SteadyTime::max();
  SteadyTime next_send_{};  ///< when send_spacing allows the next sentence
};

}  // namespace frontseat_driver::session
