#pragma once

#include <arpa/inet.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "frontseat_driver/sim/parameter.h"
#include "text_values.h"

namespace frontseat_driver::sim {

/// A number without limit.
constexpr double kAny = 1e9;

/// The kinds of parameters there are, for one type of configuration.
template <class Config>
struct ParameterKinds {
  using Parameter = ParameterOf<Config>;

  /// A number from `low` to `high`; `in_config` finds it.
  static Parameter number(std::string name, double& (*in_config)(Config&), double low, double high,
                          std::string meaning) {
    const std::string range =
        high >= kAny ? toText(low) + " or more" : "from " + toText(low) + " to " + toText(high);
    return {std::move(name), std::move(meaning), "a number, " + range,
            [=](Config& config, const std::string& text) {
              const auto value = toNumber(text);
              if (!value || *value < low || *value > high) return false;
              in_config(config) = *value;
              return true;
            },
            [=](const Config& config) {
              Config copy = config;
              return toText(in_config(copy));
            }};
  }

  /// A whole number from `low` to `high`.
  template <class Integer>
  static Parameter whole(std::string name, Integer& (*in_config)(Config&), double low, double high,
                         std::string meaning) {
    const std::string range = "from " + toText(low) + " to " + toText(high);
    return {std::move(name), std::move(meaning), "a whole number " + range,
            [=](Config& config, const std::string& text) {
              const auto value = toNumber(text);
              if (!value || *value < low || *value > high || *value != std::floor(*value))
                return false;
              in_config(config) = static_cast<Integer>(*value);
              return true;
            },
            [=](const Config& config) {
              Config copy = config;
              return toText(static_cast<double>(in_config(copy)));
            }};
  }

  /// true or false, also as Python and numbers have them.
  static Parameter flag(std::string name, bool& (*in_config)(Config&), std::string meaning) {
    return {std::move(name), std::move(meaning), "true or false",
            [=](Config& config, const std::string& text) {
              const bool on = text == "true" || text == "True" || text == "1";
              if (!on && text != "false" && text != "False" && text != "0") return false;
              in_config(config) = on;
              return true;
            },
            [=](const Config& config) {
              Config copy = config;
              return std::string{in_config(copy) ? "true" : "false"};
            }};
  }

  /// A list of numbers; `take` refuses one that it cannot use.
  static Parameter numbers(std::string name, std::string meaning, std::string accepted,
                           bool (*take)(Config&, const std::vector<double>&),
                           std::vector<double> (*get)(const Config&)) {
    return {std::move(name), std::move(meaning), std::move(accepted),
            [take](Config& config, const std::string& text) {
              const auto values = toNumbers(text);
              return values && take(config, *values);
            },
            [get](const Config& config) { return toText(get(config)); }};
  }

  /// An address to listen on.
  static Parameter address(std::string name, std::string& (*in_config)(Config&)) {
    return {std::move(name), "address to listen on", "an IPv4 or IPv6 address in numbers",
            [=](Config& config, const std::string& text) {
              std::array<unsigned char, sizeof(in6_addr)> parsed{};
              if (inet_pton(AF_INET, text.c_str(), parsed.data()) != 1 &&
                  inet_pton(AF_INET6, text.c_str(), parsed.data()) != 1) {
                return false;
              }
              in_config(config) = text;
              return true;
            },
            [=](const Config& config) {
              Config copy = config;
              return in_config(copy);
            }};
  }
};

}  // namespace frontseat_driver::sim
