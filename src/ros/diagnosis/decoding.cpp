#include "diagnosis/diagnosis.h"

namespace frontseat_driver::ros_layer {

namespace {

using Level = Diagnosis::Level;

// One bad line may be the one that the connection began in the middle of.
constexpr std::uint64_t kFewest = 2;
constexpr double kShareWarned = 0.01;
constexpr double kShareUseless = 0.5;

double share(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

bool isMuch(std::uint64_t part, std::uint64_t whole) {
  return part >= kFewest && share(part, whole) > kShareWarned;
}

void judge(const Health& health, Diagnosis& diagnosis) {
  const session::NmeaCounters& recent = health.recent;
  const std::uint64_t sentences = recent.sentences_received;
  const std::uint64_t lines = sentences + recent.no_sentences + recent.oversized;
  const std::uint64_t damaged = recent.bad_checksums + recent.bad_frames + recent.oversized;
  if (health.other_dialect_only) {
    diagnosis.level = Level::Error;
    diagnosis.message = "the vehicle speaks the other dialect; parameter dialect is " +
                        health.parameter_dialect + ": set it to auto";
  } else if (isMuch(damaged, lines)) {
    diagnosis.level = share(damaged, lines) > kShareUseless ? Level::Error : Level::Warn;
    diagnosis.message = printed(
        "%.1f %% of the lines are damaged (%llu wrong checksums, %llu malformed in 10 s) and cost "
        "their data: noise on a serial line behind the TCP port? Check cable, ground and baud rate "
        "there; topic nmea/rx shows the lines",
        100.0 * share(damaged, lines), static_cast<unsigned long long>(recent.bad_checksums),
        static_cast<unsigned long long>(recent.bad_frames) + recent.oversized);
  } else if (isMuch(recent.other_dialect, sentences)) {
    diagnosis.level = Level::Warn;
    diagnosis.message = printed(
        "%.1f %% of the sentences are of the other dialect and ignored: do "
        "two vehicles share this port?",
        100.0 * share(recent.other_dialect, sentences));
  } else if (isMuch(recent.bad_fields, sentences)) {
    diagnosis.level = Level::Warn;
    diagnosis.message = printed(
        "%llu fields in the last 10 s could not be read and count as blank: has the vehicle new "
        "firmware? nmea_decode tells sentence and field of what topic nmea/rx shows",
        static_cast<unsigned long long>(recent.bad_fields));
  } else {
    diagnosis.message = "sentences are well-formed";
  }
}

}  // namespace

Diagnosis diagnoseDecoding(const Health& health) {
  Diagnosis diagnosis;
  judge(health, diagnosis);
  const session::NmeaCounters& all = health.counters;
  diagnosis.values = {{"sentences received", std::to_string(all.sentences_received)},
                      {"decoded", std::to_string(all.decoded)},
                      {"wrong checksum", std::to_string(all.bad_checksums)},
                      {"malformed lines", std::to_string(all.bad_frames)},
                      {"malformed fields", std::to_string(all.bad_fields)},
                      {"unknown", std::to_string(all.unknown)},
                      {"of the other dialect", std::to_string(all.other_dialect)},
                      {"too long", std::to_string(all.oversized)}};
  return diagnosis;
}

}  // namespace frontseat_driver::ros_layer
