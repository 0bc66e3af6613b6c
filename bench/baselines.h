#pragma once

#include <cstddef>
#include <string_view>

/// What the decoder is compared with, in the same program and the same run. Each goes over a run of
/// sentences and returns something that depends on all of them.
namespace frontseat_driver::bench {

/// Finds the line ends, and nothing else: no decoder can be faster.
std::size_t lineEnds(std::string_view bytes);

/// Finds the line ends and checks each checksum byte by byte.
std::size_t byteWiseChecksum(std::string_view bytes);

/// The decoder that is written first: checksum, fields cut at the commas, strtod for each number.
/// Fills the structs of this project, with optional values.
std::size_t strtodDecoder(std::string_view bytes);

/// The same with std::istringstream and std::getline, as many drivers have it.
std::size_t streamDecoder(std::string_view bytes);

}  // namespace frontseat_driver::bench
