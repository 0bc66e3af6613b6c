#pragma once

#include <string_view>

namespace blueye {

/// The descriptors of all Blueye messages and of what they import: a serialized
/// google.protobuf.FileDescriptorSet. For a descriptor pool of one's own; the generated classes are
/// lite ones and know no descriptors.
std::string_view descriptorSet();

}  // namespace blueye
