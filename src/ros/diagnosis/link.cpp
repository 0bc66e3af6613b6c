#include "diagnosis/diagnosis.h"

namespace frontseat_driver::ros_layer {

namespace {

// The driver's thread reports once a second.
constexpr double kReportsAtLeastEvery_s = 5.0;
// In a minute: a vehicle that starts again is lost once or twice.
constexpr std::size_t kManyLosses = 3;

struct Advice {
  const char* in_reason;
  const char* text;
};

// The reasons are those of link::TcpClient and of the operating system.
constexpr Advice kAdvice[] = {
    {"not found", "is parameter host spelt right? An address in numbers needs no name server"},
    {"looked up",
     "is parameter host spelt right, and is there a name server? An address in numbers "
     "needs none"},
    {"connection refused",
     "the computer is there, but nothing listens on this port: is the "
     "vehicle's payload interface on, and is parameter port right (29500 on "
     "both vehicles)?"},
    {"no answer from host",
     "it is off, elsewhere, or a firewall drops what it is sent: try ping, "
     "then nc -v HOST PORT, and let the firewall pass TCP to that port"},
    {"unreachable",
     "has this computer an address in the vehicle's network (ip addr), and is the "
     "cable in?"},
    {"no route",
     "has this computer an address in the vehicle's network (ip addr), and is the "
     "cable in?"},
    {"no byte",
     "the vehicle says nothing: a Sandshark serves one client, so is another one "
     "connected? Is the payload interface on that port?"},
    {"closed the connection", "is it starting again, or serving another client?"},
    {"reset the connection", "is it starting again, or serving another client?"},
};

Diagnosis diagnoseReplay(const Health& health) {
  Diagnosis diagnosis;
  diagnosis.message = health.link.connected ? "playing a record from " + health.link.endpoint
                                            : "waiting for a record on nmea/replay";
  return diagnosis;
}

std::string otherDialect(const Health& health) {
  return "the vehicle speaks the other dialect, and is not asked for what it could say; parameter "
         "dialect is " +
         health.parameter_dialect + ": set it to auto";
}

/// The last failure and what to do about it.
std::string failure(const Health& health) {
  const std::string advice =
      health.other_dialect_only ? otherDialect(health) : linkAdvice(health.link.last_failure);
  return health.link.last_failure + (advice.empty() ? "" : "; " + advice);
}

/// Connected, and not better off for it. Where bytes come in and no sentence, diagnoseData soon
/// tells more.
bool isSilentAgain(const Health& health) {
  const bool silent = health.connection.bytes_received == 0;
  return health.link.connected && health.link.failed &&
         (silent || health.link.connected_s < kStartPatience_s);
}

void judge(const Health& health, Diagnosis& diagnosis) {
  const LinkHealth& link = health.link;
  if (link.unreported_s > kReportsAtLeastEvery_s) {
    diagnosis.level = Diagnosis::Level::Error;
    diagnosis.message =
        printed("the driver itself has reported nothing for %.0f s; restart it", link.unreported_s);
  } else if (isSilentAgain(health)) {
    diagnosis.level = Diagnosis::Level::Error;
    diagnosis.message =
        "connected to " + link.endpoint + " again, nothing heard yet; before: " + failure(health);
  } else if (link.connected && link.losses_lately >= kManyLosses) {
    diagnosis.level = Diagnosis::Level::Warn;
    diagnosis.message =
        printed("connected to %s, but lost %zu times in the last minute; the last time: ",
                link.endpoint.c_str(), link.losses_lately) +
        failure(health);
  } else if (link.connected) {
    diagnosis.message = "connected to " + link.endpoint;
  } else if (!link.failed) {
    diagnosis.message = "connecting to " + link.endpoint;
  } else {
    diagnosis.level = Diagnosis::Level::Error;
    diagnosis.message = "not connected to " + link.endpoint + ": " + failure(health);
  }
}

}  // namespace

std::string linkAdvice(const std::string& reason) {
  for (const Advice& advice : kAdvice) {
    if (reason.find(advice.in_reason) != std::string::npos) return advice.text;
  }
  return {};
}

Diagnosis diagnoseLink(const Health& health) {
  if (health.replay) return diagnoseReplay(health);
  Diagnosis diagnosis;
  judge(health, diagnosis);
  diagnosis.values = {{"dialect", health.dialect},
                      {"connected for", printed("%.0f s", health.link.connected_s)},
                      {"lost in the last minute", std::to_string(health.link.losses_lately)},
                      {"bytes received", std::to_string(health.counters.bytes_received)},
                      {"bytes sent", std::to_string(health.counters.bytes_sent)},
                      {"sentences sent", std::to_string(health.counters.sentences_sent)}};
  return diagnosis;
}

}  // namespace frontseat_driver::ros_layer
