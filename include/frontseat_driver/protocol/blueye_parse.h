#pragma once

#include <string_view>

namespace frontseat_driver::protocol {

/// Whether the bytes are a message of this type of protobuf's.
template <class Message>
bool parse(std::string_view bytes, Message& message) {
  return message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()));
}

}  // namespace frontseat_driver::protocol
