#pragma once

#include <optional>
#include <string>
#include <vector>

namespace frontseat_driver::sim {

// Parameters as text, without regard to the locale.

std::string toText(double value);
std::string toText(const std::vector<double>& numbers);  ///< `[1, 2]`

/// A finite number and nothing else.
std::optional<double> toNumber(const std::string& text);

/// Words between commas, blanks and brackets.
std::vector<std::string> toWords(std::string text);

/// The same, all of them numbers.
std::optional<std::vector<double>> toNumbers(const std::string& text);

}  // namespace frontseat_driver::sim
