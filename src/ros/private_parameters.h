#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace frontseat_driver::ros_layer {

/// A parameter that cannot be used. what() is one line: its name, its value, what is accepted.
class ParameterError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Which numbers a parameter takes.
struct Range {
  double low = 0.0;
  double high = 0.0;
  bool low_excluded = false;
  const char* unit = "";  ///< for the message: "s"
};

/// `low` and `high` themselves are accepted.
Range between(double low, double high, const char* unit = "");

/// `high` itself is accepted, `low` is not.
Range above(double low, double high, const char* unit = "");

/// Reads one node's private parameters, strictly, and remembers every name it was asked for. So the
/// reading itself is the list of known names. Every reader returns `fallback` for a parameter that
/// is not set and throws ParameterError for one that cannot be used.
class PrivateParameters {
 public:
  /// `values` as ros::NodeHandle::getParam() gives the private namespace; anything but a struct
  /// means that no parameter is set.
  explicit PrivateParameters(const XmlRpc::XmlRpcValue& values);

  bool has(const std::string& name);

  bool boolean(const std::string& name, bool fallback);

  /// An integer or a double; neither NaN nor infinite.
  double number(const std::string& name, double fallback, const Range& range);

  /// An integer, or a double that is whole.
  std::int64_t integer(const std::string& name, std::int64_t fallback, std::int64_t low,
                       std::int64_t high);

  /// A string.
  std::string text(const std::string& name, const std::string& fallback, const char* accepted);

  /// A string, or a number as the user wrote it: 0.1 is "0.1".
  std::string textOrNumber(const std::string& name, const std::string& fallback,
                           const char* accepted);

  /// A list of numbers, or a string of numbers with blanks, commas and brackets between them, which
  /// is what a command line can give. Empty if not set. With a `row` the list may also be one of
  /// lists that have so many numbers each; they come out one after the other.
  std::vector<double> numbers(const std::string& name, const char* accepted, int row = 0);

  /// A list of strings, or one string separated by blanks and commas.
  std::vector<std::string> words(const std::string& name, const std::vector<std::string>& fallback,
                                 const char* accepted);

  /// Seconds on the ROS side. Rounded up to the unit, so that what is above 0 stays above 0.
  template <class Duration>
  Duration duration(const std::string& name, Duration fallback, const Range& range) {
    const double fallback_s = std::chrono::duration<double>(fallback).count();
    const std::chrono::duration<double> given(number(name, fallback_s, range));
    return has(name) ? ceilAlmost<Duration>(given) : fallback;
  }

  /// One of the names. A name that YAML takes for a boolean (`true`) is found as well.
  template <class Value>
  Value choice(const std::string& name, Value fallback,
               std::initializer_list<std::pair<const char*, Value>> choices) {
    std::vector<std::string> names;
    for (const auto& choice : choices) names.emplace_back(choice.first);
    if (!has(name)) return fallback;
    return (choices.begin() + indexOf(name, names))->second;
  }

  /// Throws: the parameter's value is not what is accepted.
  [[noreturn]] void refuse(const std::string& name, const std::string& accepted) const;

  /// Names that somebody else reads.
  void alsoKnown(std::initializer_list<const char*> names);

  /// One line for every parameter in `values` whose name was not asked for, with the nearest one
  /// that was. A parameter inside a namespace that nobody reads is named `outer/inner`.
  std::vector<std::string> unknownIn(const XmlRpc::XmlRpcValue& values) const;

 private:
  /// 0.3 s as a double is a little more than 300 ms; it must not become 301.
  template <class Duration>
  static Duration ceilAlmost(std::chrono::duration<double> seconds) {
    const std::chrono::duration<double> nanosecond(1e-9);
    const Duration down = std::chrono::duration_cast<Duration>(seconds);
    return seconds - down > nanosecond ? down + Duration(1) : down;
  }

  const XmlRpc::XmlRpcValue* find(const std::string& name);
  std::ptrdiff_t indexOf(const std::string& name, const std::vector<std::string>& names);

  XmlRpc::XmlRpcValue values_;
  std::set<std::string> known_;
};

/// The value as a user writes it, on one line and not longer than a line bears: strings quoted,
/// doubles with the fewest digits that give the same number.
std::string toText(const XmlRpc::XmlRpcValue& value);

/// The one of `names` that is reached with the fewest insertions, deletions, replacements and swaps
/// of neighbours; the first in order of several. Empty if there are no names.
std::string nearestName(const std::string& name, const std::set<std::string>& names);

}  // namespace frontseat_driver::ros_layer
