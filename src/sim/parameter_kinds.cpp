#include "parameter_kinds.h"

namespace frontseat_driver::sim {

Parameter number(std::string name, double& (*in_config)(Config&), double low, double high,
                 std::string meaning) {
  return ParameterKinds<Config>::number(std::move(name), in_config, low, high, std::move(meaning));
}

Parameter flag(std::string name, bool& (*in_config)(Config&), std::string meaning) {
  return ParameterKinds<Config>::flag(std::move(name), in_config, std::move(meaning));
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
  return ParameterKinds<Config>::numbers(std::move(name), std::move(meaning), std::move(accepted),
                                         take, get);
}

}  // namespace frontseat_driver::sim
