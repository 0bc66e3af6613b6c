#include "frontseat_driver/session/sentence_text.h"

#include <algorithm>

namespace frontseat_driver::session {

namespace {

constexpr std::string_view kCommands[] = {"RMB", "LOG", "ABT", "STS", "VER"};

char lower(char letter) {
  return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

}  // namespace

std::optional<SentenceText> toSentenceText(std::string_view text) {
  if (!nmea::isFieldText(text)) return std::nullopt;
  SentenceText result{std::string{text}, false};
  for (const std::string_view command : kCommands) {
    if (text.find(command) != std::string_view::npos) result.lowered = true;
  }
  if (result.lowered) {
    std::transform(text.begin(), text.end(), result.text.begin(), lower);
  }
  return result;
}

std::string textRefusal(const std::string& field) {
  return field +
         " holds a character that would break the sentence; printable ASCII without comma, "
         "asterisk "
         "and $ is accepted";
}

nmea::SentenceWriter rawSentence(std::string_view body) {
  if (!body.empty() && body.front() == '$') body.remove_prefix(1);
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

}  // namespace frontseat_driver::session
