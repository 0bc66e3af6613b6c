#include "baselines.h"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "frontseat_driver/protocol/message.h"

namespace frontseat_driver::bench {
namespace {

using namespace protocol;

template <class Use>
void forEachLine(std::string_view bytes, Use use) {
  const char* at = bytes.data();
  const char* const end = at + bytes.size();
  while (at != end) {
    const void* found = std::memchr(at, '\n', static_cast<std::size_t>(end - at));
    if (found == nullptr) return;
    const char* const line_end = static_cast<const char*>(found);
    use(at, line_end);
    at = line_end + 1;
  }
}

int hexValue(char c) { return c <= '9' ? c - '0' : (c | 0x20) - 'a' + 10; }

/// The star is looked for where it stands in every good line; CR and LF follow the checksum.
bool checksumMatches(const char* line, const char* end, const char*& star) {
  star = end - 4;
  if (star <= line || *star != '*') return false;
  unsigned sum = 0;
  for (const char* at = line + 1; at != star; ++at) sum ^= static_cast<unsigned char>(*at);
  return sum == static_cast<unsigned>(hexValue(star[1]) * 16 + hexValue(star[2]));
}

/// The fields of a sentence as texts that end in zero, so that strtod stops; that is why the line
/// is copied.
class CutFields {
 public:
  CutFields(const char* from, const char* to) {
    const auto size = static_cast<std::size_t>(to - from);
    std::memcpy(text_, from, size);
    text_[size] = '\0';
    fields_[count_++] = text_;
    for (char* at = text_; *at != '\0'; ++at) {
      if (*at != ',') continue;
      *at = '\0';
      if (count_ < kMost) fields_[count_++] = at + 1;
    }
  }

  const char* operator[](std::size_t index) const { return index < count_ ? fields_[index] : ""; }

  std::optional<double> number(std::size_t index) const {
    const char* const text = (*this)[index];
    char* end = nullptr;
    const double value = std::strtod(text, &end);
    if (end == text || *end != '\0' || !std::isfinite(value)) return std::nullopt;
    return value;
  }

 private:
  static constexpr std::size_t kMost = 32;
  char text_[1024];
  const char* fields_[kMost];
  std::size_t count_ = 0;
};

/// The same by the means of the C++ library.
class StreamFields {
 public:
  StreamFields(const char* from, const char* to) {
    std::istringstream in{std::string{from, to}};
    for (std::string field; std::getline(in, field, ',');) fields_.push_back(field);
  }

  const char* operator[](std::size_t index) const {
    return index < fields_.size() ? fields_[index].c_str() : "";
  }

  std::optional<double> number(std::size_t index) const {
    if (index >= fields_.size()) return std::nullopt;
    std::istringstream in{fields_[index]};
    double value = 0.0;
    if (!(in >> value)) return std::nullopt;
    return value;
  }

 private:
  std::vector<std::string> fields_;
};

template <class Fields>
std::optional<nmea::TimeOfDay> timeOfDay(const Fields& in, std::size_t index) {
  const auto value = in.number(index);
  if (!value) return std::nullopt;
  const auto whole = static_cast<long>(*value);
  const long whole_minutes = whole / 10000 * 60 + whole / 100 % 100;
  const double seconds = 60.0 * static_cast<double>(whole_minutes) + std::fmod(*value, 100.0);
  return nmea::TimeOfDay{std::lround(seconds * 1e6)};
}

double degrees(double value) {
  const double whole = std::floor(value / 100.0);
  return whole + (value - whole * 100.0) / 60.0;
}

template <class Fields>
std::optional<nmea::LatLon> position(const Fields& in, std::size_t index) {
  const auto latitude = in.number(index);
  const auto longitude = in.number(index + 2);
  if (!latitude || !longitude) return std::nullopt;
  return nmea::LatLon{*in[index + 1] == 'S' ? -degrees(*latitude) : degrees(*latitude),
                      *in[index + 3] == 'W' ? -degrees(*longitude) : degrees(*longitude)};
}

template <class Fields>
std::optional<std::int64_t> integer(const Fields& in, std::size_t index) {
  const auto value = in.number(index);
  return value ? std::optional<std::int64_t>{static_cast<std::int64_t>(*value)} : std::nullopt;
}

template <class Fields>
NavigationUpdate navigation(const Fields& in) {
  NavigationUpdate out;
  out.sent_at = timeOfDay(in, 1);
  out.position = position(in, 2);
  out.from_gps = integer(in, 6).value_or(0) > 0;
  out.altitude_m = in.number(7);
  out.depth_m = in.number(8);
  out.heading_deg = in.number(9);
  out.roll_deg = in.number(10);
  out.pitch_deg = in.number(11);
  out.computed_at = timeOfDay(in, 12);
  return out;
}

template <class Fields>
VelocityUpdate velocity(const Fields& in) {
  VelocityUpdate out;
  out.sent_at = timeOfDay(in, 1);
  out.east_m_s = in.number(2);
  out.north_m_s = in.number(3);
  out.down_m_s = in.number(4);
  out.pitch_rate_deg_s = in.number(5);
  out.roll_rate_deg_s = in.number(6);
  out.yaw_rate_deg_s = in.number(7);
  return out;
}

template <class Fields>
kingfisher::RawImu rawImu(const Fields& in) {
  kingfisher::RawImu out;
  out.sent_at = timeOfDay(in, 1);
  out.rate_x_deg_s = in.number(2);
  out.rate_y_deg_s = in.number(3);
  out.rate_z_deg_s = in.number(4);
  out.acceleration_x = in.number(5);
  out.acceleration_y = in.number(6);
  out.acceleration_z = in.number(7);
  return out;
}

template <class Fields>
kingfisher::RawCompass compass(const Fields& in) {
  kingfisher::RawCompass out;
  out.sent_at = timeOfDay(in, 1);
  out.compass_id = integer(in, 2);
  out.heading_deg = in.number(3);
  out.pitch_deg = in.number(4);
  out.roll_deg = in.number(5);
  out.measured_at = timeOfDay(in, 6);
  return out;
}

template <class Fields>
kingfisher::BatteryVoltage battery(const Fields& in) {
  kingfisher::BatteryVoltage out;
  out.sent_at = timeOfDay(in, 1);
  out.stack_v = in.number(2);
  out.lowest_cell_v = in.number(3);
  out.highest_cell_v = in.number(4);
  out.temperature_c = in.number(5);
  return out;
}

template <class Fields>
gps::MinimumData minimumData(const Fields& in) {
  gps::MinimumData out;
  out.measured_at = timeOfDay(in, 1);
  out.valid = *in[2] == 'A';
  out.position = position(in, 3);
  out.speed_kn = in.number(7);
  out.course_deg = in.number(8);
  const auto date = integer(in, 9);
  if (date) {
    out.date = nmea::Date{static_cast<int>(2000 + *date % 100), static_cast<int>(*date / 100 % 100),
                          static_cast<int>(*date / 10000)};
  }
  return out;
}

template <class Fields>
gps::Fix gpsFix(const Fields& in) {
  gps::Fix out;
  out.measured_at = timeOfDay(in, 1);
  out.position = position(in, 2);
  out.quality = integer(in, 6);
  out.satellites = integer(in, 7);
  out.hdop = in.number(8);
  out.altitude_m = in.number(9);
  out.geoid_separation_m = in.number(11);
  return out;
}

template <class Fields>
bluefin::Acknowledgement acknowledgement(const Fields& in) {
  bluefin::Acknowledgement out;
  out.sent_at = timeOfDay(in, 1);
  out.command = in[2];
  out.command_time = timeOfDay(in, 3);
  out.behavior_id = in[4];
  out.status = integer(in, 5);
  out.message = in[7];
  return out;
}

template <class Fields>
bluefin::MissionStatus missionStatus(const Fields& in) {
  bluefin::MissionStatus out;
  out.sent_at = timeOfDay(in, 1);
  out.dive_file = in[2];
  out.status = in[3];
  out.details = in[4];
  return out;
}

template <class Fields>
bool decode(const Fields& in, Message& out) {
  const std::string_view address = in[0];
  const std::string_view type = address.substr(2);
  if (type == "NVG") {
    out = navigation(in);
  } else if (type == "NVR") {
    out = velocity(in);
  } else if (type == "IMU") {
    out = rawImu(in);
  } else if (type == "RCM") {
    out = compass(in);
  } else if (type == "RBS") {
    out = battery(in);
  } else if (type == "RMC") {
    out = minimumData(in);
  } else if (type == "GGA") {
    out = gpsFix(in);
  } else if (type == "ACK") {
    out = acknowledgement(in);
  } else if (type == "MIS") {
    out = missionStatus(in);
  } else {
    return false;
  }
  return true;
}

template <class Fields>
std::size_t decodeAll(std::string_view bytes) {
  std::size_t decoded = 0;
  forEachLine(bytes, [&](const char* line, const char* end) {
    const char* star = nullptr;
    if (!checksumMatches(line, end, star)) return;
    const Fields fields{line + 1, star};
    Message message;
    decoded += decode(fields, message) ? 1 : 0;
    asm volatile("" : : "r"(&message) : "memory");  // somebody may look at all of it
  });
  return decoded;
}

}  // namespace

std::size_t lineEnds(std::string_view bytes) {
  std::size_t lines = 0;
  forEachLine(bytes, [&](const char*, const char*) { ++lines; });
  return lines;
}

std::size_t byteWiseChecksum(std::string_view bytes) {
  std::size_t good = 0;
  forEachLine(bytes, [&](const char* line, const char* end) {
    const char* star = nullptr;
    good += checksumMatches(line, end, star) ? 1 : 0;
  });
  return good;
}

std::size_t strtodDecoder(std::string_view bytes) { return decodeAll<CutFields>(bytes); }

std::size_t streamDecoder(std::string_view bytes) { return decodeAll<StreamFields>(bytes); }

}  // namespace frontseat_driver::bench
