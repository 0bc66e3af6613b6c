#include "selection.h"

#include <algorithm>

#include "frontseat_driver/capture/text_reader.h"

namespace frontseat_driver::decode {
namespace {

bool names(const std::vector<std::string>& wanted, std::string_view address) {
  return std::any_of(wanted.begin(), wanted.end(), [&](std::string_view name) {
    return address == name || (address.size() == 5 && address.substr(2) == name);
  });
}

/// Nothing for a talker that no dialect has to itself.
std::optional<protocol::Dialect> dialectOf(std::string_view address) {
  const std::string_view talker = address.substr(0, 2);
  if (talker == "BF" || talker == "BP") return protocol::Dialect::Sandshark;
  if (talker == "CP" || talker == "PY") return protocol::Dialect::Kingfisher;
  return std::nullopt;
}

}  // namespace

std::optional<Moment> toMoment(std::string_view text) {
  constexpr std::chrono::seconds kLongestRecord{100'000'000};  // three years
  if (text.empty() || text.front() < '0' || text.front() > '9') return std::nullopt;
  // What is not understood ends the reading of a prefix, so a mark behind tells whether it was.
  const capture::LinePrefix read = capture::readPrefix(std::string{text} + " <");
  if (!read.time || !read.direction) return std::nullopt;
  return Moment{*read.time, *read.time < kLongestRecord};
}

bool Selection::accepts(const DecodedLine& line) {
  if (line.at) at_ = line.at;
  if (!start_) start_ = at_;
  if (!acceptsName(line.address) || !acceptsTime()) return false;
  const auto dialect = dialectOf(line.address);
  return !config_.dialect || !dialect || *dialect == *config_.dialect;
}

bool Selection::acceptsName(std::string_view address) const {
  return (config_.only.empty() || names(config_.only, address)) && !names(config_.except, address);
}

bool Selection::acceptsTime() const {
  if (config_.from && !isAtOrAfter(*config_.from)) return false;
  return !config_.to || !isAtOrAfter(*config_.to);
}

bool Selection::isAtOrAfter(const Moment& moment) const {
  if (!at_) return moment.after_start && moment.time.count() == 0;
  return *at_ >= moment.time + (moment.after_start ? *start_ : vehicle::UtcTime{});
}

}  // namespace frontseat_driver::decode
