#include "frontseat_driver/protocol/bluefin/dvl.h"

#include "../fields.h"

namespace frontseat_driver::protocol::bluefin {

Dvl Dvl::decode(nmea::FieldReader& in) {
  Dvl message;
  message.sent_at = in.timeOfDay();
  message.bow_m_s = in.number();
  message.starboard_m_s = in.number();
  message.down_m_s = in.number();
  for (auto& range : message.beam_range_m) range = in.number();
  message.temperature_c = in.number();
  message.measured_at = in.timeOfDay();
  return message;
}

void Dvl::encode(nmea::SentenceWriter& out) const {
  out.timeOfDay(sent_at);
  out.number(bow_m_s, kVelocityDecimals);
  out.number(starboard_m_s, kVelocityDecimals);
  out.number(down_m_s, kVelocityDecimals);
  for (const auto& range : beam_range_m) out.number(range, kLengthDecimals);
  out.number(temperature_c, kLengthDecimals);
  out.timeOfDay(measured_at);
}

void Dvl::describe(FieldVisitor& out) const {
  out.time({1, "sent_at"}, sent_at);
  out.number({2, "bow", unit::kMetersPerSecond}, bow_m_s);
  out.number({3, "starboard", unit::kMetersPerSecond}, starboard_m_s);
  out.number({4, "down", unit::kMetersPerSecond}, down_m_s);
  constexpr std::string_view kNames[] = {"beam_range_1", "beam_range_2", "beam_range_3",
                                         "beam_range_4"};
  for (std::size_t i = 0; i < beam_range_m.size(); ++i) {
    out.number({5 + static_cast<int>(i), kNames[i], unit::kMeters}, beam_range_m[i]);
  }
  out.number({9, "temperature", unit::kCelsius}, temperature_c);
  out.time({10, "measured_at"}, measured_at);
}

}  // namespace frontseat_driver::protocol::bluefin
