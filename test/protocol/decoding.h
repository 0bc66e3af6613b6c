#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "../nmea/lines.h"
#include "frontseat_driver/nmea/sentence.h"
#include "frontseat_driver/protocol/message.h"

namespace frontseat_driver::protocol {

/// A line with its checksum, decoded. Its texts live as long as this does.
class Line {
 public:
  /// `body` is what stands between `$` and `*`.
  explicit Line(std::string_view body) : line_(test::framed(body)) {}
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

  nmea::Decoded<Reading> decoded() const {
    const auto sentence = nmea::parseSentence(line_, nmea::ChecksumRule::Required);
    if (!sentence) return sentence.failure();
    return decode(*sentence);
  }

 private:
  std::string line_;
};

/// The line without line end that `message` is written as, or "invalid".
inline std::string written(std::string_view talker, const Message& message) {
  return std::visit(
      [&](const auto& m) -> std::string {
        nmea::SentenceWriter out = write(talker, m);
        const auto line = out.finish();
        return line ? std::string{line->substr(0, line->size() - 2)} : "invalid";
      },
      message);
}

}  // namespace frontseat_driver::protocol
