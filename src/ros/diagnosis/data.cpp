#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "diagnosis/diagnosis.h"

namespace frontseat_driver::ros_layer {

namespace {

using Rate = SentenceRates::Rate;
using Level = Diagnosis::Level;

// A sentence that came regularly is gone after so many of its usual periods.
constexpr double kMissedPeriods = 5.0;
constexpr double kSlow = 0.5;  // of the usual rate
// Fewer than this in the window, as usual, tell no rate: one that comes every 15 s is in it or not.
constexpr double kFewestInWindow = 5.0;

// Sent at a rate; all others come when there is something to say.
constexpr std::array<std::string_view, 13> kPeriodic = {
    "NVG", "NVR", "RCM", "RBS", "RIM", "IMU", "RMC", "GGA", "VTG", "DVL", "CTD", "RVL", "SVS"};

bool isSandshark(const Health& health) { return health.dialect == "sandshark"; }

std::string addressOf(const Health& health, const char* formatter) {
  return (isSandshark(health) ? "BF" : "CP") + std::string{formatter};
}

/// The last word of the user about a sentence of a Sandshark.
bool askedFor(const Health& health, std::string_view formatter) {
  bool asked = false;
  for (const session::LogSwitch& log : health.log_requests) {
    if (log.sentence == formatter || log.sentence == "ALL") asked = log.enable;
  }
  return asked;
}

/// A boat says everything to everyone; in a record there is what was asked for then.
bool isWanted(const Health& health, std::string_view formatter) {
  return health.replay || !isSandshark(health) || askedFor(health, formatter);
}

const Rate* rateOf(const Health& health, const std::string& address) {
  const auto found = std::find_if(health.rates.begin(), health.rates.end(),
                                  [&](const Rate& rate) { return rate.address == address; });
  return found == health.rates.end() ? nullptr : &*found;
}

std::string whatToDoAbout(const Health& health, const std::string& formatter, bool came_before) {
  if (health.replay) return "the record has none there";
  const session::NmeaCounters& recent = health.recent;
  if (recent.bytes_received > 0 && recent.decoded + recent.unknown == 0) {
    return "bytes come in, but no sentence that can be read: has the baud rate of a serial line "
           "behind the TCP port changed, or is it another port of a serial server?";
  }
  if (came_before)
    return "it came before: has the vehicle's navigation stopped, or starts it again?";
  if (!isSandshark(health)) return "is it turned off on the vehicle?";
  return "it was asked for (BPLOG," + formatter +
         ",ON): see the vehicle's answer on topic ack, and whether its payload configuration "
         "allows it; restarting its payload service helps a frontseat that forgot";
}

/// What is missing without a sentence that everything needs, or nothing.
std::string missing(const Health& health, const char* formatter, const char* consequence) {
  if (!isWanted(health, formatter)) return {};
  const std::string address = addressOf(health, formatter);
  const Rate* rate = rateOf(health, address);
  const double silent_s = rate != nullptr ? rate->age_s : health.link.connected_s;
  const double patience_s =
      rate != nullptr ? health.max_data_age_s : std::max(kStartPatience_s, health.max_data_age_s);
  const double period_s = rate != nullptr && rate->usual_hz ? 1.0 / *rate->usual_hz : 0.0;
  if (period_s > health.max_data_age_s && silent_s < kMissedPeriods * period_s) {
    return printed(
        "%s comes every %.1f s, and what is older than max_data_age, %.1f s, is not "
        "used: %s; raise max_data_age or the vehicle's rate",
        address.c_str(), period_s, health.max_data_age_s, consequence);
  }
  if (silent_s <= patience_s) return {};
  return printed("no %s for %.1f s: %s; ", address.c_str(), silent_s, consequence) +
         whatToDoAbout(health, formatter, rate != nullptr);
}

/// A sentence that came regularly and does not any more, or nothing.
std::string fallenBehind(const Health& health, const Rate& rate) {
  const std::string_view formatter = std::string_view{rate.address}.substr(2);
  const bool periodic = std::find(kPeriodic.begin(), kPeriodic.end(), formatter) != kPeriodic.end();
  if (!periodic || !rate.usual_hz || !isWanted(health, formatter)) return {};
  const double patience_s = std::max(health.max_data_age_s, kMissedPeriods / *rate.usual_hz);
  if (rate.age_s > patience_s) {
    return printed("no %s for %.1f s, where %.1f Hz are usual: is the sensor on?",
                   rate.address.c_str(), rate.age_s, *rate.usual_hz);
  }
  const bool tells = *rate.usual_hz * SentenceRates::kWindow >= kFewestInWindow;
  if (tells && rate.hz < kSlow * *rate.usual_hz) {
    return printed(
        "%s comes at %.1f Hz, where %.1f Hz are usual: the link or the vehicle is "
        "overloaded; what else uses them?",
        rate.address.c_str(), rate.hz, *rate.usual_hz);
  }
  return {};
}

bool hasTalker(const Rate& rate, std::string_view talker) {
  return rate.address.compare(0, talker.size(), talker) == 0;
}

std::string addresses(const Health& health) {
  std::string all;
  for (const Rate& rate : health.rates) all += (all.empty() ? "" : ", ") + rate.address;
  return all;
}

/// What comes in is no vehicle's, if anything comes in at all.
std::string notAVehicle(const Health& health) {
  if (health.connection.bytes_received == 0) {
    return printed(
        "connected for %.1f s, and the vehicle has said nothing: a Sandshark serves one "
        "client, so is another one connected? Is its payload interface on that port?",
        health.link.connected_s);
  }
  if (health.connection.sentences_received == 0) {
    return "bytes come in, but no sentence that starts with $: are host and port those of the "
           "vehicle's payload interface?";
  }
  const bool vehicle = std::any_of(health.rates.begin(), health.rates.end(), [](const Rate& rate) {
    return hasTalker(rate, "BF") || hasTalker(rate, "CP");
  });
  if (vehicle) return {};
  return "sentences come in (" + addresses(health) +
         "), but none of a vehicle, which begin with BF or CP: are host and port those of its "
         "payload interface?";
}

std::string fine(const Health& health) {
  const std::string navigation = addressOf(health, "NVG");
  if (!isWanted(health, "NVG")) {
    return navigation +
           " is not asked for, so odom, nav/fix and tf stand still; see parameter "
           "log_sentences and service set_logging";
  }
  const Rate* rate = rateOf(health, navigation);
  if (rate == nullptr) return "waiting for the first " + navigation;
  const std::string comes = printed("%s comes at %.1f Hz", navigation.c_str(), rate->hz);
  if (health.position_known) return comes;
  return comes + ", without a position so far: odom, nav/fix and tf wait for the first GPS fix";
}

void judge(const Health& health, Diagnosis& diagnosis) {
  const bool patient = health.link.connected_s < kStartPatience_s;
  if (health.other_dialect_only || (patient && health.dialect.empty())) {
    diagnosis.message = patient ? "waiting for the first sentences" : "sentences come in";
    return;
  }
  if (!patient) diagnosis.message = notAVehicle(health);
  if (diagnosis.message.empty() && health.dialect.empty()) {
    diagnosis.message = "sentences come in";  // none could be read: decoding tells more
    return;
  }
  if (diagnosis.message.empty()) {
    diagnosis.message = missing(health, "NVG", "no odom, nav/fix and tf");
  }
  if (!diagnosis.message.empty()) {
    diagnosis.level = Level::Error;
    return;
  }
  diagnosis.level = Level::Warn;
  diagnosis.message = missing(health, "NVR", "odom has no twist, imu/data stands still");
  for (const Rate& rate : health.rates) {
    if (diagnosis.message.empty()) diagnosis.message = fallenBehind(health, rate);
  }
  if (!diagnosis.message.empty()) return;
  diagnosis.level = Level::Ok;
  diagnosis.message = fine(health);
}

std::string describe(const Rate& rate) {
  std::string text = printed("%.1f Hz, the last %.1f s ago", rate.hz, rate.age_s);
  if (rate.longest_s > 0.0) {
    text += printed(", %.2f to %.2f s apart", rate.shortest_s, rate.longest_s);
  }
  if (rate.usual_hz) text += printed(", usually %.1f Hz", *rate.usual_hz);
  return text;
}

}  // namespace

Diagnosis diagnoseData(const Health& health) {
  Diagnosis diagnosis;
  judge(health, diagnosis);
  for (const Rate& rate : health.rates) diagnosis.values.emplace_back(rate.address, describe(rate));
  diagnosis.values.emplace_back("positions dropped as jumps", std::to_string(health.jumps));
  return diagnosis;
}

}  // namespace frontseat_driver::ros_layer
