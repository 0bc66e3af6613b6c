#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "frontseat_driver/nmea/sentence_writer.h"

namespace frontseat_driver::session {

/// Longest sentence to a vehicle with its line end, in bytes: a field frontseat reads 256 at once.
constexpr std::size_t kMostBytesSent = 200;

/// Free text as it can stand in a sentence to a Sandshark.
struct SentenceText {
  std::string text;
  bool lowered = false;  ///< it held a command's name in capitals and was put into lower case
};

/// Whether a text holds RMB, LOG, ABT, STS or VER: field frontseats find the command by the first
/// of them anywhere in the line.
bool holdsCommand(std::string_view text);

/// So a text that holds one of them is put into lower case. Nothing for a text that would break the
/// sentence: a comma, an asterisk, `$`, control or non-ASCII characters.
std::optional<SentenceText> toSentenceText(std::string_view text);

/// What is wrong with a text that toSentenceText() refused: its field, the first character that
/// would break the sentence and where it stands, counted from 1, and what is accepted.
std::string textRefusal(const std::string& field, std::string_view text);

/// What is wrong with a text that makes its sentence longer than kMostBytesSent.
std::string lengthRefusal(const std::string& field, std::string_view text);

/// A sentence as the user wrote it, "PYDIR,0,0", with or without `$`; the checksum is added. What
/// is no sentence makes the writer invalid.
nmea::SentenceWriter rawSentence(std::string_view body);

/// What is wrong with a text that rawSentence() made no sentence of, or one that is too long.
std::string rawRefusal(std::string_view body);

}  // namespace frontseat_driver::session
