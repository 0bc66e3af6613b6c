#include "text_values.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <locale>
#include <sstream>
#include <string_view>

namespace frontseat_driver::sim {

std::string toText(double value) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::setprecision(12) << value;
  return out.str();
}

std::optional<double> toNumber(const std::string& text) {
  std::istringstream in{text};
  in.imbue(std::locale::classic());
  double value = 0.0;
  if (!(in >> value) || !(in >> std::ws).eof() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::vector<std::string> toWords(std::string text) {
  std::replace_if(
      text.begin(), text.end(),
      [](char c) { return std::string_view{",[]{}"}.find(c) != std::string_view::npos; }, ' ');
  std::istringstream in{text};
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

std::optional<std::vector<double>> toNumbers(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& word : toWords(text)) {
    const auto number = toNumber(word);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

std::string toText(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : ", ") + toText(number);
  return "[" + text + "]";
}

}  // namespace frontseat_driver::sim
