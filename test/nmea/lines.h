#pragma once

#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

namespace frontseat_driver::test {

/// `$` + body + `*` + checksum, the sum taken byte by byte.
inline std::string framed(std::string_view body) {
  unsigned sum = 0;
  for (const char c : body) sum ^= static_cast<unsigned char>(c);
  char tail[4];
  std::snprintf(tail, sizeof tail, "*%02X", sum & 0xFF);
  return "$" + std::string{body} + tail;
}

/// A file of test/captures, byte for byte.
inline std::string capture(const std::string& name) {
  std::ifstream file{std::string{CAPTURES} + "/" + name, std::ios::binary};
  return {std::istreambuf_iterator<char>{file}, {}};
}

}  // namespace frontseat_driver::test
