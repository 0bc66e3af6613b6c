#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frontseat_driver/nmea/framer.h"
#include "frontseat_driver/protocol/message.h"
#include "frontseat_driver/session/session.h"

namespace frontseat_driver::session {

/// What the user chose for the conversation; names and defaults as in the parameter table.
struct NmeaOptions {
  std::optional<protocol::Dialect> dialect;  ///< empty: told by the first talker heard
  std::string interface_version = "0.1";
  std::vector<std::string> log_sentences = {"NVG", "NVR", "MIS", "CTL"};
  bool use_acks = true;
  bool commands_enabled = true;
  enum class ControlHook { Ctl, Mis, None };
  ControlHook control_hook = ControlHook::Ctl;
  std::optional<std::chrono::milliseconds> send_spacing;  ///< empty: 60 ms sandshark, 20 ms kingfisher
};

/// What came in and what became of it, since the session began.
struct NmeaCounters {
  std::uint64_t bytes_received = 0;
  std::uint64_t bytes_sent = 0;
  std::uint64_t sentences_received = 0;  ///< complete lines that start with `$`
  std::uint64_t sentences_sent = 0;
  std::uint64_t decoded = 0;             ///< sentences read into their struct
  std::uint64_t bad_checksums = 0;
  std::uint64_t bad_frames = 0;          ///< no frame, no checksum, cut off by the next `$`
  std::uint64_t bad_fields = 0;          ///< single fields that did not parse
  std::uint64_t unknown = 0;             ///< no layout, or of the other dialect
  std::uint64_t oversized = 0;
  std::uint64_t refused_commands = 0;
};

/// The conversation in either NMEA dialect (Sandshark SPI 0.1, section 4; Kingfisher 0.1, section 2).
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

  /// As given or as heard; empty while not known.
  std::optional<protocol::Dialect> dialect() const { return dialect_; }

  NmeaCounters counters() const;
};

}  // namespace frontseat_driver::session
