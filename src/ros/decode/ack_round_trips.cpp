#include "ack_round_trips.h"

#include <algorithm>
#include <variant>

#include "frontseat_driver/session/to_vehicle.h"

namespace frontseat_driver::decode {
namespace {

using namespace protocol;

template <class... Sentences>
std::optional<std::string_view> formatterOfAny(const Message& message) {
  std::optional<std::string_view> formatter;
  ((std::holds_alternative<Sentences>(message) ? void(formatter = Sentences::kFormatter) : void()),
   ...);
  return formatter;
}

/// What a frontseat acknowledges (SPI 0.1, section 6.4).
std::optional<std::string_view> acknowledged(const Message& message) {
  return formatterOfAny<bluefin::BehaviorChange, bluefin::LogRequest, bluefin::AbortMission>(
      message);
}

}  // namespace

void AckRoundTrips::add(const DecodedLine& line) {
  if (!line.reading) return;
  if (line.direction == capture::Direction::ToVehicle) return addCommand(line);
  const auto* const ack = std::get_if<bluefin::Acknowledgement>(&line.reading->message);
  if (ack != nullptr) addAck(*ack, vehicle::SteadyTime{line.at.value_or(vehicle::UtcTime{})});
}

void AckRoundTrips::addCommand(const DecodedLine& line) {
  const auto formatter = acknowledged(line.reading->message);
  if (!formatter) return;
  ++counts_.commands;
  session::AckTracker::Sent sent;
  sent.formatter = *formatter;
  sent.time = session::sentAt(line.reading->message);
  sent.at = vehicle::SteadyTime{line.at.value_or(vehicle::UtcTime{})};
  tracker_.sent(sent);
}

void AckRoundTrips::addAck(const bluefin::Acknowledgement& ack, vehicle::SteadyTime at) {
  ++counts_.acks;
  vehicle::Acknowledgement neutral;
  neutral.command = session::commandFormatter(ack.command);
  neutral.command_time = ack.command_time;
  neutral.status = static_cast<vehicle::Acknowledgement::Status>(ack.status.value_or(0));
  const auto sent = tracker_.match(neutral, at);
  if (!sent) {
    ++counts_.not_matched;
    return;
  }
  if (neutral.status == vehicle::Acknowledgement::Status::Pending) {
    ++counts_.pending;
    return;
  }
  const bool first = counts_.done + counts_.refused == 0;
  ++(neutral.status == vehicle::Acknowledgement::Status::Done ? counts_.done : counts_.refused);
  const std::chrono::nanoseconds trip = at - sent->at;
  counts_.shortest = first ? trip : std::min(counts_.shortest, trip);
  counts_.longest = std::max(counts_.longest, trip);
  counts_.sum += trip;
}

}  // namespace frontseat_driver::decode
