#include <algorithm>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "frontseat_driver/nmea/framer.h"
#include "frontseat_driver/protocol/message.h"
#include "fuzz.h"

// Bytes from a vehicle: framer, sentence and decoders, and from the structs back to text. The first
// byte is the size of the pieces that the rest comes in.

namespace frontseat_driver::fuzz {
namespace {

using nmea::ChecksumRule;

void checkCounters(const nmea::Framer& framer) {
  const nmea::Framer::Counters& count = framer.counters();
  promise(count.bytes ==
              count.sentence_bytes + count.line_end_bytes + count.dropped_bytes + framer.pending(),
          "a byte is not accounted for");
}

std::vector<std::string> linesOf(std::string_view bytes, std::size_t piece) {
  nmea::Framer framer;
  std::vector<std::string> lines;
  for (; !bytes.empty(); bytes.remove_prefix(std::min(piece, bytes.size()))) {
    framer.feed(bytes.substr(0, piece), [&](std::string_view line) {
      promise(line.size() <= nmea::Framer::kMaxLine, "a line is too long");
      checkCounters(framer);
      lines.emplace_back(line);
    });
    checkCounters(framer);
  }
  return lines;
}

/// Shows every field, and counts them.
class Count : public protocol::FieldVisitor {
 public:
  int fields = 0;

  void time(const protocol::Field&, const std::optional<nmea::TimeOfDay>&) override { ++fields; }
  void date(const protocol::Field&, const std::optional<nmea::Date>&) override { ++fields; }
  void position(const protocol::Field&, const std::optional<nmea::LatLon>&) override { ++fields; }
  void number(const protocol::Field&, const std::optional<double>&) override { ++fields; }
  void integer(const protocol::Field&, const std::optional<std::int64_t>&) override { ++fields; }
  void flag(const protocol::Field&, const std::optional<bool>&) override { ++fields; }
  void choice(const protocol::Field&, const std::optional<std::size_t>& value,
              Words words) override {
    promise(!value || *value < words.size(), "a choice has no word");
    ++fields;
  }
  void text(const protocol::Field&, std::string_view value) override {
    promise(value.find_first_of(",*$\r\n") == std::string_view::npos, "a text breaks sentences");
    ++fields;
  }
};

std::string written(std::string_view talker, const protocol::Message& message) {
  return std::visit(
      [talker](const auto& one) {
        nmea::SentenceWriter out = protocol::write(talker, one);
        const auto text = out.finish();
        return std::string{text.value_or("")};
      },
      message);
}

std::string_view withoutLineEnd(std::string_view text) { return text.substr(0, text.size() - 2); }

/// What was read can be written, if it is in range; and that text reads as itself from then on.
void checkWayBack(std::string_view talker, const protocol::Message& message) {
  const std::string text = written(talker, message);
  if (text.empty()) return;
  const auto sentence = nmea::parseSentence(withoutLineEnd(text), ChecksumRule::Required);
  promise(static_cast<bool>(sentence), "what was written is no sentence: " + text);
  const auto reading = protocol::decode(*sentence);
  promise(reading && reading->message.index() == message.index(), "it changed its type: " + text);
  promise(reading->faults.count == 0, "what was written has a fault: " + text);
  promise(written(talker, reading->message) == text, "it is not read as it was written: " + text);
}

void checkLine(std::string_view line) {
  for (const ChecksumRule rule : {ChecksumRule::Required, ChecksumRule::Optional}) {
    const auto sentence = nmea::parseSentence(line, rule);
    if (!sentence) continue;
    const auto reading = protocol::decode(*sentence);
    if (!reading) continue;
    Count count;
    protocol::describe(reading->message, count);
    promise(count.fields > 0, "a sentence without fields was described");
    checkWayBack(sentence->talker(), reading->message);
  }
}

}  // namespace

void run(std::string_view bytes) {
  Dice dice{bytes};
  const std::size_t piece = dice.byte() + 1;
  const std::string_view stream = dice.rest();
  const std::vector<std::string> lines = linesOf(stream, stream.size());
  promise(lines == linesOf(stream, piece), "the lines depend on how they come");
  for (const std::string& line : lines) checkLine(line);
}

}  // namespace frontseat_driver::fuzz
