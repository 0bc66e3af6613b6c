#pragma once

#include <cstddef>
#include <cstdint>
#include <random>

namespace frontseat_driver::sim {

/// Random numbers that are the same for the same seed with every standard library: the engine is
/// fixed by the standard, the distributions are written out here.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// A stream of its own for one purpose or one client, so that none disturbs another.
  Random(std::uint64_t seed, std::uint64_t stream);

  double uniform();                      ///< [0, 1)
  double normal();                       ///< mean 0, standard deviation 1
  bool chance(double probability);       ///< true that often; draws nothing at 0
  std::size_t below(std::size_t count);  ///< 0 .. count - 1; 0 for a count of 0

 private:
  std::mt19937_64 engine_;
};

/// A slowly wandering error: first-order Gauss-Markov process.
class Wander {
 public:
  /// `sigma` in the unit of the quantity, `correlation_s` > 0.
  Wander(double sigma, double correlation_s) : sigma_(sigma), correlation_s_(correlation_s) {}

  double step(double dt_s, Random& random);

 private:
  double sigma_;
  double correlation_s_;
  double value_ = 0.0;
};

}  // namespace frontseat_driver::sim
