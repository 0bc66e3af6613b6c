#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "plan.h"

namespace frontseat_driver::simulation {

/// What a vehicle says as its driver gets it: some acknowledgements lost, sent twice, kept pending,
/// with another result or with another command's time; sentences of the other dialect and garbage
/// in between.
class Mischief {
 public:
  explicit Mischief(std::uint64_t seed, protocol::Dialect dialect)
      : random_(seed), dialect_(dialect) {}

  void set(Kind kind, bool on) { on_[static_cast<std::size_t>(kind)] = on; }

  /// What arrives instead.
  std::string spoil(std::string_view said);

  /// How often each kind did something.
  const std::array<std::uint64_t, kKinds>& done() const { return done_; }

 private:
  bool does(Kind kind, double chance);
  void spoilAck(std::string_view line, std::string& out);
  std::string otherDialect();
  std::string garbage();

  sim::Random random_;
  const protocol::Dialect dialect_;
  std::array<bool, kKinds> on_{};
  std::array<std::uint64_t, kKinds> done_{};
  std::string earlier_time_;  ///< of a command that was acknowledged
};

}  // namespace frontseat_driver::simulation
