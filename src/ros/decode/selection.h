#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "decoded_line.h"

namespace frontseat_driver::decode {

/// A moment as the user gives it: 2014-11-19T15:13:20Z or UNIX seconds, or seconds after the first
/// line of the record, which are below a hundred million.
struct Moment {
  vehicle::UtcTime time{};
  bool after_start = false;
};

/// Nothing for text that is no moment.
std::optional<Moment> toMoment(std::string_view text);

/// Which lines the user wants to see. Names are addresses ("BFNVG") or what they end with ("NVG").
class Selection {
 public:
  struct Config {
    std::vector<std::string> only;  ///< none: all
    std::vector<std::string> except;
    std::optional<Moment> from;                ///< and later
    std::optional<Moment> to;                  ///< before it
    std::optional<protocol::Dialect> dialect;  ///< also the sentences of GPS receivers
  };

  explicit Selection(Config config) : config_(std::move(config)) {}

  /// For every line of the record, in order. A line without a time counts as of the line before.
  bool accepts(const DecodedLine& line);

  /// The time is past `to`: what follows is not wanted either, unless the record goes back in time.
  bool filtersTime() const { return config_.from || config_.to; }

 private:
  bool acceptsName(std::string_view address) const;
  bool acceptsTime() const;
  bool isAtOrAfter(const Moment& moment) const;

  Config config_;
  std::optional<vehicle::UtcTime> start_;
  std::optional<vehicle::UtcTime> at_;
};

}  // namespace frontseat_driver::decode
