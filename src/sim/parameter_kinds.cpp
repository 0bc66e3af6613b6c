#include "parameter_kinds.h"

namespace frontseat_driver::sim {

Parameter number(std::string name, double& (*in_config)(Config&), double low, double high,
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

Parameter flag(std::string name, bool& (*in_config)(Config&), std::string meaning) {
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

Parameter choice(std::string name, std::vector<Choice> choices, std::string meaning,
                 std::function<std::string(const Config&)> get) {
  std::string accepted;
  for (const Choice& row : choices) accepted += (accepted.empty() ? "" : " or ") + row.word;
  return {std::move(name), std::move(meaning), accepted,
          [choices = std::move(choices)](Config& config, const std::string& text) {
            for (const Choice& row : choices) {
              if (row.word != text) continue;
              row.choose(config);
              return true;
            }
            return false;
          },
          std::move(get)};
}

Parameter numbers(std::string name, std::string meaning, std::string accepted,
                  bool (*take)(Config&, const std::vector<double>&),
                  std::vector<double> (*get)(const Config&)) {
  return {std::move(name), std::move(meaning), std::move(accepted),
          [take](Config& config, const std::string& text) {
            const auto values = toNumbers(text);
            return values && take(config, *values);
          },
          [get](const Config& config) { return toText(get(config)); }};
}

}  // namespace frontseat_driver::sim
