#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "decoded_line.h"

namespace frontseat_driver::decode {

/// What is wrong with a line, for people.
struct FaultNote {
  std::string reason;      ///< "wrong checksum: 5B sent, 4E computed", "value out of range"
  int field = 0;           ///< counts from 1; 0: the whole line
  std::string field_name;  ///< "heading"; empty for the whole line and for fields without a name
  std::size_t column = 1;  ///< of the line, counted from 1 at its `$`
  int more = 0;            ///< fields of the same line that are bad too
};

/// Nothing for a line that is right, or of an unknown type.
std::optional<FaultNote> faultOf(const DecodedLine& line);

}  // namespace frontseat_driver::decode
