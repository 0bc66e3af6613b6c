#pragma once

#include <string_view>

namespace frontseat_driver::sim {

/// Whether fields hold nothing but digits, points, minus signs and blanks: field vehicles refuse
/// `+` signs, exponents and words.
inline bool arePlainNumbers(std::string_view fields) {
  return fields.find_first_not_of("0123456789.-, ") == std::string_view::npos;
}

}  // namespace frontseat_driver::sim
