#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

namespace frontseat_driver::fuzz {

/// What one fuzzer does with any bytes. Throws Broken if a promise is not kept. Each program has
/// one; it runs under libFuzzer (`make fuzz`) and on the kept corpus (`make test`).
void run(std::string_view bytes);

/// A promise that was broken, in words.
class Broken : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

inline void promise(bool kept, const std::string& what) {
  if (!kept) throw Broken{what};
}

/// Takes values from the front of the bytes; zeros when there are no more.
class Dice {
 public:
  explicit Dice(std::string_view bytes) : rest_(bytes) {}

  bool empty() const { return rest_.empty(); }

  std::string_view take(std::size_t size) {
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(taken.size());
    return taken;
  }

  std::string_view rest() { return take(rest_.size()); }

  /// Up to the next line feed, which is taken as well.
  std::string_view line() {
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) return rest();
    const std::string_view taken = take(end);
    rest_.remove_prefix(1);
    return taken;
  }

  template <class T>
  T value() {
    T result{};
    const std::string_view taken = take(sizeof result);
    std::memcpy(&result, taken.data(), taken.size());
    return result;
  }

  unsigned byte() { return value<std::uint8_t>(); }
  bool flag() { return byte() % 2 == 1; }

 private:
  std::string_view rest_;
};

}  // namespace frontseat_driver::fuzz
