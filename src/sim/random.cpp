#include "frontseat_driver/sim/random.h"

#include <cmath>

#include "frontseat_driver/sim/angles.h"

namespace frontseat_driver::sim {

Random::Random(std::uint64_t seed, std::uint64_t stream) {
  std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                         static_cast<std::uint32_t>(stream),
                         static_cast<std::uint32_t>(stream >> 32)};
  engine_.seed(sequence);
}

double Random::uniform() {
  return static_cast<double>(engine_() >> 11) * 0x1.0p-53;  // 53 bits, exact in a double
}

double Random::normal() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));  // Box-Muller
  return radius * std::cos(2.0 * kPi * uniform());
}

bool Random::chance(double probability) { return probability > 0.0 && uniform() < probability; }

std::size_t Random::below(std::size_t count) {
  return static_cast<std::size_t>(uniform() * static_cast<double>(count));
}

double Wander::step(double dt_s, Random& random) {
  const double kept = std::exp(-dt_s / correlation_s_);
  value_ = kept * value_ + sigma_ * std::sqrt(1.0 - kept * kept) * random.normal();
  return value_;
}

}  // namespace frontseat_driver::sim
