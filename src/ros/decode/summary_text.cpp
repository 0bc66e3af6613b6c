#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "field_text.h"
#include "summary.h"

namespace frontseat_driver::decode {
namespace {

using std::chrono::nanoseconds;
using Seconds = std::chrono::duration<double>;

template <class... Values>
std::string print(const char* format, Values... values) {
  char text[200];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

unsigned long long count(std::uint64_t number) { return number; }

std::string duration(nanoseconds time) {
  const double seconds = Seconds(time).count();
  const auto whole = static_cast<long long>(seconds);
  if (whole < 60) return print("%.3f s", seconds);
  const double rest = seconds - static_cast<double>(whole - whole % 60);
  if (whole < 3600) return print("%lld min %06.3f s", whole / 60, rest);
  return print("%lld h %02lld min %06.3f s", whole / 3600, whole / 60 % 60, rest);
}

/// A moment of the record's clock, or of the vehicle's, whose days have no date.
std::string moment(const std::optional<vehicle::UtcTime>& at, bool recorded) {
  std::string text;
  if (!at) return text;
  appendUtc(text, *at);
  return recorded ? text : text.substr(11, 15);  // without date and Z
}

std::string addressOf(std::uint64_t key) {
  std::string address;
  for (; key != 0; key >>= 8) address.insert(address.begin(), static_cast<char>(key & 0xFF));
  return address;
}

class Text {
 public:
  explicit Text(bool recorded) : recorded_(recorded) {}

  void line(const std::string& text) { text_ += text + "\n"; }

  void sentence(const std::string& address, const SentenceFigures& figures) {
    const auto rate = figures.rate_hz();
    std::string row =
        print("  %-8s %-38.*s %10llu", address.c_str(), static_cast<int>(figures.title.size()),
              figures.title.data(), count(figures.count));
    if (rate) row += print(" %9.3f", *rate);
    if (figures.gap_begins) {
      row += print(" %10.3f  ", Seconds(figures.longest_gap).count()) +
             moment(figures.gap_begins, recorded_);
    }
    line(row);
  }

  void occurrences(const char* what, const Occurrences& these, const char* unit = nullptr) {
    std::string row = print("  %-30s %10llu", what, count(these.count));
    if (these.count > 0) {
      row += print("  first at sentence %llu", count(these.first_line));
      if (these.first_at) row += ", " + moment(these.first_at, recorded_);
      if (unit != nullptr) row += print("; largest %.3f %s", these.largest, unit);
    }
    line(row);
  }

  void number(const char* what, std::uint64_t value) {
    line(print("  %-30s %10llu", what, count(value)));
  }

  std::string take() { return std::move(text_); }

 private:
  bool recorded_;
  std::string text_;
};

void writeAcks(const AckRoundTrips::Counts& acks, Text& out) {
  if (acks.commands == 0 && acks.acks == 0) return;
  out.line("Acknowledgements");
  out.number("commands", acks.commands);
  out.number("done", acks.done);
  out.number("refused", acks.refused);
  out.number("pending", acks.pending);
  out.number("for no command of the record", acks.not_matched);
  const std::uint64_t answered = acks.done + acks.refused;
  out.number("commands without an answer", acks.commands - answered);
  if (answered == 0) return;
  const double mean_s = Seconds(acks.sum).count() / static_cast<double>(answered);
  out.line(print("  %-30s %10.3f least, %.3f mean, %.3f most", "round trip, s",
                 Seconds(acks.shortest).count(), mean_s, Seconds(acks.longest).count()));
}

}  // namespace

std::string Summary::text(const capture::ReadCounters& read) const {
  Text out{recorded_times_};
  out.line(print("%llu sentences: %llu from the vehicle, %llu to it", count(lines_),
                 count(from_vehicle_), count(lines_ - from_vehicle_)));
  if (all_.earliest) {
    out.line(duration(*all_.latest - *all_.earliest) + ", from " +
             moment(all_.earliest, recorded_times_) + " to " +
             moment(all_.latest, recorded_times_) +
             (recorded_times_ ? "" : " by the vehicle's clock: the record has no times"));
  }
  if (!kinds_.empty()) {
    out.line(print("  %-8s %-38s %10s %9s %10s  %s", "sentence", "what it is", "count", "per s",
                   "gap, s", "longest gap begins"));
  }
  std::vector<std::pair<std::string, const SentenceFigures*>> rows;
  for (const auto& [key, figures] : kinds_) rows.emplace_back(addressOf(key), &figures);
  std::sort(rows.begin(), rows.end());
  for (const auto& [address, figures] : rows) out.sentence(address, *figures);
  if (other_kinds_ > 0) out.number("of further kinds", other_kinds_);
  out.line("Faults");
  out.occurrences("wrong checksum", bad_checksums_);
  out.occurrences("missing checksum", missing_checksums_);
  out.occurrences("malformed", malformed_);
  out.occurrences("with bad fields", bad_fields_);
  out.number("unknown", unknown_);
  out.number("too long", read.oversized);
  out.number("cut off by the next one", read.cut_off);
  out.number("lines without a sentence", read.other_lines);
  if (read.sent_again > 0) out.number("bytes of TCP sent again", read.sent_again);
  if (read.missing > 0) out.number("bytes of TCP not captured", read.missing);
  if (read.breaks_off) out.line("  the capture breaks off, or is damaged from here on");
  out.line("Surprises");
  if (all_.gap_begins) {
    out.line(
        print("  %-30s %10.3f  begins ", "longest silence, s", Seconds(all_.longest_gap).count()) +
        moment(all_.gap_begins, recorded_times_));
  }
  out.occurrences(print("position jumps, over %.0f m/s", kMaxSpeed_m_s).c_str(), jumps_, "m");
  if (recorded_times_) out.occurrences("record goes back in time", record_goes_back_, "s");
  out.occurrences("vehicle's clock goes back", vehicle_goes_back_, "s");
  writeAcks(acks_.counts(), out);
  return out.take();
}

}  // namespace frontseat_driver::decode
