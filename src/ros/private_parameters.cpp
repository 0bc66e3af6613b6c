#include "private_parameters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <locale>
#include <numeric>
#include <optional>
#include <sstream>

namespace frontseat_driver::ros_layer {

namespace {

using XmlRpc::XmlRpcValue;

/// A log line must stay readable whatever somebody put on the parameter server.
constexpr std::size_t kLongestValue = 100;

/// Streams in the classic locale: the process that loads the nodelet may have set another.
std::string fewestDigits(double value) {
  if (value == std::floor(value) && std::abs(value) < 1e15) {
    return std::to_string(static_cast<std::int64_t>(value));
  }
  for (int digits = 1;; ++digits) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(digits);
    out << value;
    std::istringstream in(out.str());
    in.imbue(std::locale::classic());
    double back = 0.0;
    if (digits == std::numeric_limits<double>::max_digits10 || (in >> back && back == value)) {
      return out.str();
    }
  }
}

std::string quoted(const std::string& text) {
  constexpr const char* kHex = "0123456789abcdef";
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte != 0x7F) {
      out += c;
    } else {
      out += {'\\', 'x', kHex[byte >> 4], kHex[byte & 0xF]};
    }
  }
  return out + '"';
}

std::string listText(const XmlRpcValue& list) {
  std::string out;
  for (int i = 0; i < list.size(); ++i) {
    out += (i == 0 ? "" : ", ") + toText(list[i]);
    if (out.size() > kLongestValue) break;
  }
  return '[' + out + ']';
}

std::string structText(const XmlRpcValue& members) {
  std::string out;
  for (const auto& member : members) {
    out += (out.empty() ? "" : ", ") + member.first + ": " + toText(member.second);
    if (out.size() > kLongestValue) break;
  }
  return '{' + out + '}';
}

std::string wholeText(const XmlRpcValue& value) {
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      return static_cast<const bool&>(value) ? "true" : "false";
    case XmlRpcValue::TypeInt:
      return std::to_string(static_cast<const int&>(value));
    case XmlRpcValue::TypeDouble:
      return fewestDigits(static_cast<const double&>(value));
    case XmlRpcValue::TypeString:
      return quoted(static_cast<const std::string&>(value));
    case XmlRpcValue::TypeArray:
      return listText(value);
    case XmlRpcValue::TypeStruct:
      return structText(value);
    case XmlRpcValue::TypeDateTime:
      return "a date";
    case XmlRpcValue::TypeBase64:
      return "binary data";
    case XmlRpcValue::TypeInvalid:
      break;
  }
  return "nothing";
}

std::optional<double> asNumber(const XmlRpcValue& value) {
  if (value.getType() == XmlRpcValue::TypeInt) return static_cast<const int&>(value);
  if (value.getType() != XmlRpcValue::TypeDouble) return std::nullopt;
  const double number = static_cast<const double&>(value);
  return std::isfinite(number) ? std::optional<double>(number) : std::nullopt;
}

std::vector<std::string> split(const std::string& text, const char* separators) {
  std::vector<std::string> words;
  for (std::size_t end = 0, begin = 0; begin != std::string::npos; begin = end) {
    begin = text.find_first_not_of(separators, end);
    if (begin == std::string::npos) break;
    end = text.find_first_of(separators, begin);
    words.push_back(text.substr(begin, end == std::string::npos ? end : end - begin));
  }
  return words;
}

std::optional<double> parseNumber(const std::string& word) {
  std::istringstream in(word);
  in.imbue(std::locale::classic());
  double number = 0.0;
  const bool whole = in >> number && in.peek() == std::istringstream::traits_type::eof();
  return whole && std::isfinite(number) ? std::optional<double>(number) : std::nullopt;
}

/// Appends every number in `list`, which may be one of lists of `row` numbers; false if there is
/// anything else in it.
bool appendNumbers(const XmlRpcValue& list, int row, std::vector<double>& numbers) {
  for (int i = 0; i < list.size(); ++i) {
    const bool is_row =
        row > 0 && list[i].getType() == XmlRpcValue::TypeArray && list[i].size() == row;
    const std::optional<double> number = asNumber(list[i]);
    if (number) numbers.push_back(*number);
    if (!number && !(is_row && appendNumbers(list[i], 0, numbers))) return false;
  }
  return true;
}

bool appendParsed(const std::string& text, std::vector<double>& numbers) {
  for (const std::string& word : split(text, " ,[]")) {
    const std::optional<double> number = parseNumber(word);
    if (!number) return false;
    numbers.push_back(*number);
  }
  return true;
}

std::string acceptedBy(const Range& range) {
  const std::string unit = *range.unit == '\0' ? "" : std::string(" ") + range.unit;
  const std::string high = fewestDigits(range.high) + unit;
  if (range.low_excluded) {
    return "a number above " + fewestDigits(range.low) + " and up to " + high;
  }
  return "a number " + fewestDigits(range.low) + ".." + high;
}

bool contains(const Range& range, double number) {
  const bool above_low = range.low_excluded ? number > range.low : number >= range.low;
  return above_low && number <= range.high;
}

/// Insertions, deletions, replacements and swaps of neighbours that lead from one to the other.
std::size_t editDistance(const std::string& from, const std::string& to) {
  std::vector<std::size_t> before_last;
  std::vector<std::size_t> last(to.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= from.size(); ++i) {
    std::vector<std::size_t> row(to.size() + 1, i);
    for (std::size_t j = 1; j <= to.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (from[i - 1] == to[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      const bool swapped = i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last = std::exchange(last, std::move(row));
  }
  return last[to.size()];
}

void appendLeaves(const std::string& name, const XmlRpcValue& value,
                  std::vector<std::string>& leaves) {
  if (value.getType() != XmlRpcValue::TypeStruct || value.size() == 0) {
    leaves.push_back(name);
    return;
  }
  for (const auto& member : value) appendLeaves(name + '/' + member.first, member.second, leaves);
}

std::string listed(const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) out += i + 1 == names.size() ? " or " : ", ";
    out += names[i];
  }
  return out;
}

}  // namespace

Range between(double low, double high, const char* unit) { return {low, high, false, unit}; }

Range above(double low, double high, const char* unit) { return {low, high, true, unit}; }

PrivateParameters::PrivateParameters(const XmlRpcValue& values) : values_(values) {}

bool PrivateParameters::has(const std::string& name) { return find(name) != nullptr; }

bool PrivateParameters::boolean(const std::string& name, bool fallback) {
  const XmlRpcValue* value = find(name);
  if (value == nullptr) return fallback;
  if (value->getType() != XmlRpcValue::TypeBoolean) refuse(name, "true or false");
  return static_cast<const bool&>(*value);
}

double PrivateParameters::number(const std::string& name, double fallback, const Range& range) {
  const XmlRpcValue* value = find(name);
  if (value == nullptr) return fallback;
  const std::optional<double> number = asNumber(*value);
  if (!number || !contains(range, *number)) refuse(name, acceptedBy(range));
  return *number;
}

std::int64_t PrivateParameters::integer(const std::string& name, std::int64_t fallback,
                                        std::int64_t low, std::int64_t high) {
  const XmlRpcValue* value = find(name);
  if (value == nullptr) return fallback;
  const std::optional<double> number = asNumber(*value);
  const Range range = between(static_cast<double>(low), static_cast<double>(high));
  if (!number || std::floor(*number) != *number || !contains(range, *number)) {
    refuse(name, "a whole number " + std::to_string(low) + ".." + std::to_string(high));
  }
  return static_cast<std::int64_t>(*number);
}

std::string PrivateParameters::text(const std::string& name, const std::string& fallback,
                                    const char* accepted) {
  const XmlRpcValue* value = find(name);
  if (value == nullptr) return fallback;
  if (value->getType() != XmlRpcValue::TypeString) refuse(name, accepted);
  return static_cast<const std::string&>(*value);
}

std::string PrivateParameters::textOrNumber(const std::string& name, const std::string& fallback,
                                            const char* accepted) {
  const XmlRpcValue* value = find(name);
  if (value != nullptr && asNumber(*value)) return ros_layer::toText(*value);
  return text(name, fallback, accepted);
}

std::vector<double> PrivateParameters::numbers(const std::string& name, const char* accepted,
                                               int row) {
  std::vector<double> numbers;
  const XmlRpcValue* value = find(name);
  if (value == nullptr) return numbers;
  const bool is_list = value->getType() == XmlRpcValue::TypeArray;
  const bool is_text = value->getType() == XmlRpcValue::TypeString;
  const bool read = (is_list && appendNumbers(*value, row, numbers)) ||
                    (is_text && appendParsed(static_cast<const std::string&>(*value), numbers));
  if (!read) refuse(name, accepted);
  return numbers;
}

std::vector<std::string> PrivateParameters::words(const std::string& name,
                                                  const std::vector<std::string>& fallback,
                                                  const char* accepted) {
  const XmlRpcValue* value = find(name);
  if (value == nullptr) return fallback;
  if (value->getType() != XmlRpcValue::TypeArray) return split(text(name, "", accepted), " ,");
  std::vector<std::string> words;
  for (int i = 0; i < value->size(); ++i) {
    if ((*value)[i].getType() != XmlRpcValue::TypeString) refuse(name, accepted);
    words.push_back(static_cast<const std::string&>((*value)[i]));
  }
  return words;
}

void PrivateParameters::refuse(const std::string& name, const std::string& accepted) const {
  const bool set = values_.getType() == XmlRpcValue::TypeStruct && values_.hasMember(name);
  const std::string value = set ? ros_layer::toText(values_[name]) : "not set";
  throw ParameterError("parameter " + name + " is " + value + ": " + accepted + " is accepted");
}

void PrivateParameters::alsoKnown(std::initializer_list<const char*> names) {
  known_.insert(names.begin(), names.end());
}

std::vector<std::string> PrivateParameters::unknownIn(const XmlRpcValue& values) const {
  if (values.getType() != XmlRpcValue::TypeStruct) return {};
  std::vector<std::string> unknown;
  for (const auto& member : values) {
    if (known_.count(member.first) == 0) appendLeaves(member.first, member.second, unknown);
  }
  for (std::string& name : unknown) {
    const std::string nearest = nearestName(name.substr(name.rfind('/') + 1), known_);
    name = "parameter " + name + " is not known; did you mean " + nearest + "?";
  }
  return unknown;
}

const XmlRpcValue* PrivateParameters::find(const std::string& name) {
  known_.insert(name);
  const bool set = values_.getType() == XmlRpcValue::TypeStruct && values_.hasMember(name);
  return set ? &values_[name] : nullptr;
}

std::ptrdiff_t PrivateParameters::indexOf(const std::string& name,
                                          const std::vector<std::string>& names) {
  const XmlRpcValue* value = find(name);
  // YAML reads an unquoted `true` as a boolean, also where it is the name of a north.
  const bool is_name =
      value->getType() == XmlRpcValue::TypeString || value->getType() == XmlRpcValue::TypeBoolean;
  if (!is_name) refuse(name, listed(names));
  const std::string given = value->getType() == XmlRpcValue::TypeString
                                ? static_cast<const std::string&>(*value)
                                : wholeText(*value);
  const auto found = std::find(names.begin(), names.end(), given);
  if (found == names.end()) refuse(name, listed(names));
  return found - names.begin();
}

std::string toText(const XmlRpcValue& value) {
  const std::string text = wholeText(value);
  return text.size() <= kLongestValue ? text : text.substr(0, kLongestValue) + "...";
}

std::string nearestName(const std::string& name, const std::set<std::string>& names) {
  const auto nearest =
      std::min_element(names.begin(), names.end(), [&](const std::string& a, const std::string& b) {
        return editDistance(name, a) < editDistance(name, b);
      });
  return nearest == names.end() ? std::string{} : *nearest;
}

}  // namespace frontseat_driver::ros_layer
