#pragma once

#include <utility>
#include <variant>

namespace frontseat_driver::nmea {

/// Why a received line or one of its fields was refused. Diagnostics count each one.
enum class Fault {
  BadFrame,         ///< no `$`, no `*`, an address that is none, or a byte outside 0x20..0x7F
  MissingChecksum,  ///< nothing after the `*`, where a checksum is required
  BadChecksum,      ///< two hex digits that are not the XOR of the bytes between `$` and `*`
  UnknownType,      ///< a well-formed sentence that this project has no layout for
  MissingField,     ///< the sentence ends before this field
  BadValue,         ///< the field's text is not of the field's type
  OutOfRange        ///< the field's value is outside what its type allows
};

/// Words for a fault, such as "wrong checksum"; fit for a log line.
const char* toString(Fault fault);

/// Where a line failed: `field` counts from 1 after the address, as the documents do; 0 is the
/// whole line.
struct Failure {
  Fault fault;
  int field = 0;
};

/// A decoded value, or the reason there is none.
template <class T>
class [[nodiscard]] Decoded {
 public:
  Decoded(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  explicit Decoded(std::in_place_t) : state_(std::in_place_index<0>) {}  ///< to be filled in place
  Decoded(Failure failure) : state_(std::in_place_index<1>, failure) {}
  Decoded(Fault fault) : state_(std::in_place_index<1>, Failure{fault}) {}

  explicit operator bool() const { return state_.index() == 0; }
  const T& operator*() const { return *std::get_if<0>(&state_); }
  T& operator*() { return *std::get_if<0>(&state_); }
  const T* operator->() const { return std::get_if<0>(&state_); }
  T* operator->() { return std::get_if<0>(&state_); }
  Failure failure() const { return *std::get_if<1>(&state_); }

 private:
  std::variant<T, Failure> state_;
};

}  // namespace frontseat_driver::nmea
