#include "frontseat_driver/sim/editable_sentence.h"

#include <array>
#include <cstdio>

#include "frontseat_driver/nmea/sentence.h"

namespace frontseat_driver::sim {
namespace {

/// Number of the latitude field; the longitude is two further.
std::size_t latitudeField(std::string_view formatter) {
  if (formatter == "NVG" || formatter == "GGA") return 2;
  if (formatter == "RMC") return 3;
  return 0;
}

/// dd09.123456 to dd9.123456; `degree_digits` is 2 for latitudes, 3 for longitudes.
void unpadMinutes(std::string& text, std::size_t degree_digits) {
  if (text.size() > degree_digits + 1 && text[degree_digits] == '0' &&
      text[degree_digits + 1] != '.') {
    text.erase(degree_digits, 1);
  }
}

void dropLeadingZeros(std::string& text) {
  while (text.size() > 1 && text[0] == '0' && text[1] != '.') text.erase(0, 1);
}

/// hhmm00.fff to the minute before and second 60.
void toSecondSixty(std::string& time) {
  if (time.size() < 6 || time.compare(4, 2, "00") != 0) return;
  const auto digit = [&time](std::size_t at) { return time[at] - '0'; };
  const int minute = (digit(0) * 10 + digit(1)) * 60 + digit(2) * 10 + digit(3);
  const int before = (minute + 24 * 60 - 1) % (24 * 60);
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%02d%02d60", before / 60, before % 60);
  time.replace(0, 6, text.data());
}

/// Numbers of the fields that hold times; 0 where there is no second one.
std::array<std::size_t, 2> timeFields(std::string_view formatter) {
  if (formatter == "NVG") return {1, 12};
  if (formatter == "RCM") return {1, 6};
  if (formatter == "RIM" || formatter == "IMU") return {1, 8};
  return {1, 0};
}

void rewritePosition(EditableSentence& sentence, const Quirks& quirks) {
  const std::size_t latitude = latitudeField(sentence.formatter());
  if (latitude == 0) return;
  for (const std::size_t number : {latitude, latitude + 2}) {
    std::string* text = sentence.field(number);
    if (text == nullptr || text->empty()) continue;
    if (quirks.unpadded_minutes) unpadMinutes(*text, number == latitude ? 2 : 3);
    if (quirks.dropped_zeros) dropLeadingZeros(*text);
  }
}

}  // namespace

EditableSentence::EditableSentence(std::string_view sentence) {
  std::string_view rest = sentence.substr(1, sentence.rfind('*') - 1);
  for (std::size_t comma = rest.find(','); comma != std::string_view::npos;
       comma = rest.find(',')) {
    fields_.emplace_back(rest.substr(0, comma));
    rest.remove_prefix(comma + 1);
  }
  fields_.emplace_back(rest);
}

std::string_view EditableSentence::formatter() const {
  return std::string_view{fields_.front()}.substr(2);
}

std::string* EditableSentence::field(std::size_t number) {
  return number < fields_.size() ? &fields_[number] : nullptr;
}

void EditableSentence::erase(std::size_t number) {
  if (number < fields_.size()) fields_.erase(fields_.begin() + static_cast<std::ptrdiff_t>(number));
}

std::string EditableSentence::render(std::string_view line_end) const {
  std::string body = fields_.front();
  for (std::size_t i = 1; i < fields_.size(); ++i) body.append(1, ',').append(fields_[i]);
  std::array<char, 4> hex{};
  std::snprintf(hex.data(), hex.size(), "*%02X", nmea::checksum(body));
  return "$" + body + hex.data() + std::string{line_end};
}

bool rewrites(const Quirks& quirks) {
  return quirks.unpadded_minutes || quirks.dropped_zeros || quirks.battery_without_id ||
         quirks.nan_velocities || quirks.cr_lf_lf || quirks.seconds_sixty;
}

std::string rewrite(std::string_view text, const Quirks& quirks, bool standing) {
  EditableSentence sentence{text};
  rewritePosition(sentence, quirks);
  if (quirks.nan_velocities && standing && sentence.formatter() == "NVR") {
    for (const std::size_t number : {2U, 3U, 4U}) *sentence.field(number) = "nan";
  }
  if (quirks.seconds_sixty) {
    for (const std::size_t number : timeFields(sentence.formatter())) {
      if (number != 0 && sentence.field(number) != nullptr) toSecondSixty(*sentence.field(number));
    }
  }
  if (quirks.battery_without_id && sentence.formatter() == "RBS") sentence.erase(2);
  return sentence.render(quirks.cr_lf_lf ? "\r\n\n" : "\r\n");
}

}  // namespace frontseat_driver::sim
