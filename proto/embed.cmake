# Writes the file INPUT as a C++ array into OUTPUT.
file(READ ${INPUT} bytes HEX)
string(REGEX REPLACE "(................)" "\\1\n" bytes "${bytes}")
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
file(WRITE ${OUTPUT}
"#include <blueye/descriptors.h>

namespace blueye {
namespace {

constexpr unsigned char kBytes[] = {
${bytes}};

}  // namespace

std::string_view descriptorSet() {
  return {reinterpret_cast<const char*>(kBytes), sizeof(kBytes)};
}

}  // namespace blueye
")
