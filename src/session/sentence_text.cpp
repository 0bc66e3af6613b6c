#include "frontseat_driver/session/sentence_text.h"

#include <algorithm>
#include <cstdio>
#include <iterator>

namespace frontseat_driver::session {

namespace {

constexpr std::string_view kCommands[] = {"RMB", "LOG", "ABT", "STS", "VER"};

char lower(char letter) {
  return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

/// One character, also where it cannot be printed.
std::string inWords(std::string_view one) {
  const auto byte = static_cast<unsigned char>(one.empty() ? 0 : one.front());
  if (byte >= 0x20 && byte < 0x7F) return "'" + std::string{one} + "'";
  char text[16];
  std::snprintf(text, sizeof text, "byte 0x%02X", byte);
  return text;
}

/// Without the `$` that may stand in front.
std::string_view withoutStart(std::string_view body) {
  if (!body.empty() && body.front() == '$') body.remove_prefix(1);
  return body;
}

}  // namespace

bool holdsCommand(std::string_view text) {
  return std::any_of(std::begin(kCommands), std::end(kCommands), [text](std::string_view command) {
    return text.find(command) != std::string_view::npos;
  });
}

std::optional<SentenceText> toSentenceText(std::string_view text) {
  if (!nmea::isFieldText(text)) return std::nullopt;
  SentenceText result{std::string{text}, holdsCommand(text)};
  if (result.lowered) {
    std::transform(text.begin(), text.end(), result.text.begin(), lower);
  }
  return result;
}

std::string textRefusal(const std::string& field, std::string_view text) {
  std::size_t at = 0;
  while (at < text.size() && nmea::isFieldText(text.substr(at, 1))) ++at;
  return field + " holds " + inWords(text.substr(at, 1)) + " as character " +
         std::to_string(at + 1) +
         ", which would break the sentence; printable ASCII without comma, asterisk and $ is "
         "accepted";
}

std::string lengthRefusal(const std::string& field, std::string_view text) {
  return field + " has " + std::to_string(text.size()) + " characters; a sentence takes " +
         std::to_string(kMostBytesSent) + " bytes in all";
}

nmea::SentenceWriter rawSentence(std::string_view body) {
  body = withoutStart(body);
  std::size_t comma = body.find(',');
  const std::string_view address = body.substr(0, comma);
  nmea::SentenceWriter writer{address.substr(0, 2),
                              address.substr(std::min<std::size_t>(2, address.size()))};
  while (comma != std::string_view::npos) {
    body.remove_prefix(comma + 1);
    comma = body.find(',');
    writer.text(body.substr(0, comma));
  }
  return writer;
}

std::string rawRefusal(std::string_view body) {
  constexpr std::size_t kAround = 6;  // `$`, `*`, two digits, CR, LF
  if (withoutStart(body).size() + kAround > kMostBytesSent) return lengthRefusal("sentence", body);
  return "sentence is '" + std::string{body} +
         "'; an address such as PYDIR and fields of printable ASCII without asterisk and $ are "
         "accepted, and the checksum is added";
}

}  // namespace frontseat_driver::session
