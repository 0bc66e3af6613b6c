#include <cmath>
#include <string>
#include <variant>

#include "frontseat_driver/nmea/sentence.h"
#include "frontseat_driver/session/command_sentence.h"
#include "frontseat_driver/session/sentence_text.h"
#include "fuzz.h"

// Any command becomes a sentence that says the same, or none at all.

namespace frontseat_driver::fuzz {
namespace {

using protocol::bluefin::BehaviorChange;
using vehicle::BehaviorCommand;

constexpr double kDegreesPerRadian = 57.29577951308232;

vehicle::Command anyCommand(Dice& dice) {
  switch (dice.byte() % 4) {
    case 0: {
      BehaviorCommand behavior;
      const unsigned which = dice.byte();
      if (which & 1U) {
        behavior.horizontal = {static_cast<BehaviorCommand::Horizontal>(dice.byte() % 2),
                               dice.value<double>()};
      }
      if (which & 2U) {
        behavior.vertical = {static_cast<BehaviorCommand::Vertical>(dice.byte() % 4),
                             dice.value<double>()};
      }
      if (which & 4U) {
        behavior.speed = {static_cast<BehaviorCommand::Speed>(dice.byte() % 2),
                          dice.value<double>()};
      }
      return behavior;
    }
    case 1:
      return vehicle::DriveCommand{dice.value<double>(), dice.value<double>()};
    case 2:
      return vehicle::HelmCommand{dice.value<double>(), dice.value<double>()};
    default:
      return vehicle::CourseCommand{dice.value<double>(), dice.value<double>()};
  }
}

session::CommandFormat anyFormat(Dice& dice) {
  session::CommandFormat format;
  format.thrust_decimals = static_cast<int>(dice.byte() % 7);
  format.yaw_rate_in_degrees = dice.flag();
  return format;
}

void same(double wanted, const std::optional<double>& said, double resolution, const char* what) {
  const double most = resolution * 0.5 + std::abs(wanted) * 1e-15;
  promise(said && std::abs(*said - wanted) <= most, std::string{what} + " is not what was wanted");
}

void sameAngle(double wanted_deg, const std::optional<double>& said_deg, double resolution_deg,
               const char* what) {
  promise(said_deg && *said_deg >= 0.0 && *said_deg < 360.0, std::string{what} + " out of range");
  const double apart = std::abs(std::remainder(*said_deg - wanted_deg, 360.0));
  promise(apart <= resolution_deg * 0.5 + std::abs(wanted_deg) * 1e-13,
          std::string{what} + " is another heading");
}

struct Same {
  const session::CommandFormat& format;
  const protocol::Message& message;

  void operator()(const BehaviorCommand& wanted) const {
    const auto& said = std::get<BehaviorChange>(message);
    promise(wanted.horizontal.has_value() == said.horizontal.has_value() &&
                wanted.vertical.has_value() == said.vertical.has_value() &&
                wanted.speed.has_value() == said.speed.has_value(),
            "an aspect came or went");
    promise(said.horizontal.has_value() == said.horizontal_mode.has_value() &&
                said.vertical.has_value() == said.vertical_mode.has_value() &&
                said.speed.has_value() == said.speed_mode.has_value(),
            "a value without its mode, or the other way round");
    if (wanted.horizontal) {
      const bool rudder = wanted.horizontal->mode == BehaviorCommand::Horizontal::Rudder;
      promise(rudder == (said.horizontal_mode == BehaviorChange::HorizontalMode::Rudder), "mode");
      if (rudder) same(wanted.horizontal->value, said.horizontal, 1e-4, "rudder");
      if (!rudder) sameAngle(wanted.horizontal->value, said.horizontal, 1e-4, "heading");
    }
    if (wanted.vertical) {
      promise(static_cast<int>(wanted.vertical->mode) == static_cast<int>(*said.vertical_mode),
              "vertical mode");
      same(wanted.vertical->value, said.vertical, 1e-3, "vertical");
    }
    if (wanted.speed) {
      const bool rpm = wanted.speed->mode == BehaviorCommand::Speed::Rpm;
      promise(rpm == (said.speed_mode == BehaviorChange::SpeedMode::Rpm), "speed mode");
      same(wanted.speed->value, said.speed, 1e-3, "speed");
    }
  }

  void operator()(const vehicle::DriveCommand& wanted) const {
    const auto& said = std::get<protocol::kingfisher::MotorThrust>(message);
    same(wanted.port * 100.0, said.port_pct, thrustResolution(), "port thrust");
    same(wanted.starboard * 100.0, said.starboard_pct, thrustResolution(), "starboard thrust");
  }

  void operator()(const vehicle::HelmCommand& wanted) const {
    const auto& said = std::get<protocol::kingfisher::ThrustAndYawRate>(message);
    const double unit = format.yaw_rate_in_degrees ? kDegreesPerRadian : 1.0;
    same(wanted.thrust * 100.0, said.thrust_pct, thrustResolution(), "thrust");
    same(wanted.yaw_rate_rad_s * unit, said.yaw_rate, 1e-4, "yaw rate");
  }

  void operator()(const vehicle::CourseCommand& wanted) const {
    const auto& said = std::get<protocol::kingfisher::HeadingAndSpeed>(message);
    sameAngle(wanted.heading_deg, said.heading_deg, 1.0, "course");
    same(wanted.speed_m_s, said.speed_m_s, 1e-3, "speed");
  }

  double thrustResolution() const { return std::pow(10.0, -format.thrust_decimals); }
};

bool within(double value, double low, double high) { return value >= low && value <= high; }

/// What the ROS side lets pass, and more: this must become a sentence.
struct Usable {
  bool operator()(const BehaviorCommand& command) const {
    return (!command.horizontal || within(command.horizontal->value, -720.0, 720.0)) &&
           (!command.vertical || within(command.vertical->value, -6000.0, 6000.0)) &&
           (!command.speed || within(command.speed->value, -1e4, 1e4));
  }
  bool operator()(const vehicle::DriveCommand& command) const {
    return within(command.port, -1.0, 1.0) && within(command.starboard, -1.0, 1.0);
  }
  bool operator()(const vehicle::HelmCommand& command) const {
    return within(command.thrust, -1.0, 1.0) && within(command.yaw_rate_rad_s, -10.0, 10.0);
  }
  bool operator()(const vehicle::CourseCommand& command) const {
    return within(command.heading_deg, -720.0, 720.0) && within(command.speed_m_s, 0.0, 10.0);
  }
};

void checkSentence(std::string_view text) {
  promise(text.size() >= 2 && text.substr(text.size() - 2) == "\r\n", "no CR LF at the end");
  for (const char c : text.substr(0, text.size() - 2)) {
    promise(c >= 0x20 && c < 0x7F, "a byte that is not printable");
  }
  promise(text.find('+') == std::string_view::npos, "a plus");
  promise(
      text.find(",-0,") == std::string_view::npos && text.find(",-0*") == std::string_view::npos,
      "minus zero");
}

void checkCommand(Dice& dice) {
  const session::CommandFormat format = anyFormat(dice);
  const vehicle::Command command = anyCommand(dice);
  const nmea::TimeOfDay time = std::chrono::milliseconds{dice.value<std::uint32_t>() % 86400000};
  nmea::SentenceWriter writer = session::commandSentence(command, format, {}, time);
  const auto text = writer.finish();
  const bool usable = std::visit(Usable{}, command);
  promise(text || !usable, "a usable command became no sentence");
  if (!text) return;
  checkSentence(*text);
  promise(text->size() <= session::kMostBytesSent, "a command is too long");
  const auto sentence =
      nmea::parseSentence(text->substr(0, text->size() - 2), nmea::ChecksumRule::Required);
  promise(static_cast<bool>(sentence), "a command is no sentence");
  const auto reading = protocol::decode(*sentence);
  promise(static_cast<bool>(reading), "a command is of no known type");
  if (!usable && reading->faults.count > 0) return;
  promise(reading->faults.count == 0, "a command cannot be read");
  std::visit(Same{format, reading->message}, command);
}

/// Free text either stands in a sentence as one field, or is refused.
void checkText(std::string_view text) {
  const auto allowed = session::toSentenceText(text);
  if (!allowed) return;
  for (const char* name : {"RMB", "LOG", "ABT", "STS", "VER"}) {
    promise(allowed->text.find(name) == std::string::npos, "a text holds a command's name");
  }
  promise(nmea::isFieldText(allowed->text), "a text breaks the sentence");
  nmea::SentenceWriter raw = session::rawSentence(text);
  if (const auto sentence = raw.finish()) checkSentence(*sentence);
}

}  // namespace

void run(std::string_view bytes) {
  Dice dice{bytes};
  if (dice.flag()) return checkText(dice.rest());
  checkCommand(dice);
}

}  // namespace frontseat_driver::fuzz
