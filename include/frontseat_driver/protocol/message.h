#pragma once

#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/protocol/bluefin/abort_mission.h"
#include "frontseat_driver/protocol/bluefin/acknowledgement.h"
#include "frontseat_driver/protocol/bluefin/backseat_control.h"
#include "frontseat_driver/protocol/bluefin/behavior_begin.h"
#include "frontseat_driver/protocol/bluefin/behavior_change.h"
#include "frontseat_driver/protocol/bluefin/behavior_end.h"
#include "frontseat_driver/protocol/bluefin/ctd.h"
#include "frontseat_driver/protocol/bluefin/dvl.h"
#include "frontseat_driver/protocol/bluefin/log_request.h"
#include "frontseat_driver/protocol/bluefin/mission_status.h"
#include "frontseat_driver/protocol/bluefin/payload_shutdown.h"
#include "frontseat_driver/protocol/bluefin/payload_status.h"
#include "frontseat_driver/protocol/bluefin/payload_version.h"
#include "frontseat_driver/protocol/bluefin/raw_vehicle_speed.h"
#include "frontseat_driver/protocol/bluefin/sound_speed.h"
#include "frontseat_driver/protocol/bluefin/vehicle_version.h"
#include "frontseat_driver/protocol/field_visitor.h"
#include "frontseat_driver/protocol/gps/course_and_speed.h"
#include "frontseat_driver/protocol/gps/fix.h"
#include "frontseat_driver/protocol/gps/minimum_data.h"
#include "frontseat_driver/protocol/kingfisher/battery_voltage.h"
#include "frontseat_driver/protocol/kingfisher/heading_and_speed.h"
#include "frontseat_driver/protocol/kingfisher/motor_thrust.h"
#include "frontseat_driver/protocol/kingfisher/raw_compass.h"
#include "frontseat_driver/protocol/kingfisher/raw_imu.h"
#include "frontseat_driver/protocol/kingfisher/thrust_and_yaw_rate.h"
#include "frontseat_driver/protocol/navigation_update.h"
#include "frontseat_driver/protocol/velocity_update.h"

namespace frontseat_driver::protocol {

/// The two NMEA interfaces.
enum class Dialect {
  Sandshark,  ///< Bluefin Sandshark Standard Payload Interface 0.1: talkers BF and BP
  Kingfisher  ///< Clearpath Kingfisher USV NMEA Interface 0.1: talkers CP and PY
};

const char* toString(Dialect dialect);  ///< "sandshark" or "kingfisher", as the parameter has it

/// The dialect a vehicle's talker gives away: BF or CP. A GPS receiver's talker tells nothing.
std::optional<Dialect> dialectOf(std::string_view talker);

/// Any sentence of either dialect, either direction.
using Message =
    std::variant<NavigationUpdate, VelocityUpdate, bluefin::VehicleVersion,
                 bluefin::PayloadShutdown, bluefin::MissionStatus, bluefin::Acknowledgement,
                 bluefin::BackseatControl, bluefin::Dvl, bluefin::Ctd, bluefin::RawVehicleSpeed,
                 bluefin::BehaviorBegin, bluefin::BehaviorEnd, bluefin::SoundSpeed,
                 bluefin::PayloadVersion, bluefin::LogRequest, bluefin::PayloadStatus,
                 bluefin::BehaviorChange, bluefin::AbortMission, kingfisher::RawCompass,
                 kingfisher::BatteryVoltage, kingfisher::RawImu, kingfisher::ThrustAndYawRate,
                 kingfisher::HeadingAndSpeed, kingfisher::MotorThrust, gps::Fix, gps::MinimumData,
                 gps::CourseAndSpeed>;

/// A sentence read into its struct, with what was wrong with single fields. A bad field costs that
/// field only. Texts are views into the line.
struct Reading {
  Message message;
  nmea::FieldFaults faults;
};

/// Reads any sentence either dialect knows; others are Fault::UnknownType.
nmea::Decoded<Reading> decode(const nmea::Sentence& sentence);

/// A sentence that decode() knows. An empty talker is any.
struct KnownSentence {
  std::string_view talker;
  std::string_view formatter;
  std::string_view title;  ///< in plain words: "navigation update"
};

std::vector<KnownSentence> knownSentences();

/// What a sentence is, in plain words.
std::string_view titleOf(const Message& message);

/// Shows `out` every field of the message's sentence.
void describe(const Message& message, FieldVisitor& out);

/// A finished writer for a message whose talker is fixed. Keep it while its finish() is in use.
template <class T>
nmea::SentenceWriter write(const T& message) {
  nmea::SentenceWriter out{T::kTalker, T::kFormatter};
  message.encode(out);
  return out;
}

/// The same for a message that several talkers send.
template <class T>
nmea::SentenceWriter write(std::string_view talker, const T& message) {
  nmea::SentenceWriter out{talker, T::kFormatter};
  message.encode(out);
  return out;
}

}  // namespace frontseat_driver::protocol
