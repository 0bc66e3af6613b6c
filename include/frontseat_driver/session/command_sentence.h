#pragma once

#include <optional>
#include <vector>

#include "frontseat_driver/protocol/message.h"
#include "frontseat_driver/vehicle/command.h"
#include "frontseat_driver/vehicle/event.h"

namespace frontseat_driver::session {

/// What one propeller speed gives.
struct SpeedPoint {
  double speed_m_s = 0.0;
  double rpm = 0.0;
};

/// How commands are put into words; names and defaults as in the parameter table.
struct CommandFormat {
  int thrust_decimals = 0;
  bool yaw_rate_in_degrees = false;     ///< PYDEP in deg/s, as Heron firmware reads it
  std::vector<SpeedPoint> speed_table;  ///< strictly increasing; empty: speeds are sent as m/s
  bool fill_behavior_fields = false;    ///< send the present value where an aspect is left alone
};

/// What the vehicle does at present, in its own frames.
struct PresentState {
  std::optional<double> heading_deg;
  std::optional<double> depth_m;
  std::optional<double> speed_m_s;  ///< over ground
};

/// The dialect a command belongs to.
protocol::Dialect dialectOf(const vehicle::Command& command);

/// The sentence for a command, carrying `time` where its layout has one. Sandshark SPI 0.1, section
/// 7.3; Kingfisher 0.1, section 4.0.
nmea::SentenceWriter commandSentence(const vehicle::Command& command, const CommandFormat& format,
                                     const PresentState& present, nmea::TimeOfDay time);

/// False while a behavior would go out with an empty field although the format fills them, because
/// the vehicle's present state is not known: a frontseat that cannot take one would die of it.
bool canBeSent(const vehicle::Command& command, const CommandFormat& format,
               const PresentState& present);

/// No thrust on either motor: how commanding a Kingfisher ends.
nmea::SentenceWriter zeroThrust();

/// Linear between the points. Below the first point between it and standstill; above the last one
/// its rpm, which is the most that was measured.
double rpmFor(double speed_m_s, const std::vector<SpeedPoint>& table);

}  // namespace frontseat_driver::session
