#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "frontseat_driver/vehicle/clock.h"

namespace frontseat_driver::vehicle {

/// Learns how far the host's clock is ahead of a vehicle's from when its sentences arrive, and so
/// carries a time of the vehicle onto the host's clock.
///
/// A sentence arrives after it was made: the least delay seen is nearest to the truth, so the
/// estimate follows the minimum over kWindow, with the drift between the clocks taken out. The
/// constant part of the delay cannot be seen and stays in the stamps. Which day the vehicle's time
/// of day belongs to, and what zone or scale its clock is in, does not matter: any constant is
/// learned. A step of either clock shows as samples that all are early, believed at once, or that
/// all are late for kStepPatience, longer than a network holds back everything, and as close
/// together as the link's jitter lets them. A step below kStep is told from a run of long delays by
/// at least 20 samples in 2 s, later than the earliest of any second was lately.
class ClockOffset {
 public:
  using TimeOfDay = std::chrono::microseconds;

  static constexpr std::chrono::seconds kWindow{60};
  static constexpr std::chrono::seconds kStepPatience{1};
  static constexpr std::chrono::milliseconds kStep{250};  ///< more is no usual delay of any link
  static constexpr double kMostDrift_ppm = 500.0;         ///< no clock with a crystal is worse

  /// A sentence that the vehicle made at `sent_at` of its clock has arrived.
  void take(TimeOfDay sent_at, UtcTime arrival);

  /// When it was `time` on the vehicle's clock, on the host's; `arrival` tells the day. Nothing
  /// before the first sample.
  std::optional<UtcTime> toHost(TimeOfDay time, UtcTime arrival) const;

  /// Forgets everything.
  void reset();

  struct State {
    std::uint64_t samples = 0;          ///< since the last step
    std::uint64_t steps = 0;            ///< clock steps noticed
    std::chrono::nanoseconds offset{};  ///< host minus vehicle, the vehicle's date as the host's
    std::chrono::nanoseconds jitter{};  ///< mean delay beyond the least
    double drift_ppm = 0.0;             ///< how much faster the host's clock runs
  };
  State state() const;

 private:
  /// The earliest sample of a second of arrivals.
  struct Bucket {
    UtcTime begin{};
    UtcTime at{};
    std::chrono::nanoseconds offset{};
  };

  static constexpr std::size_t kBuckets = static_cast<std::size_t>(kWindow.count());

  UtcTime unwrapped(TimeOfDay time, UtcTime arrival) const;
  std::chrono::nanoseconds offsetAt(UtcTime arrival) const;
  bool lateForLong(std::chrono::nanoseconds late, std::chrono::nanoseconds offset, UtcTime arrival);
  void startAgain(std::chrono::nanoseconds offset, UtcTime arrival);
  void put(std::chrono::nanoseconds offset, UtcTime arrival);
  void fitDrift();
  void findLeast(UtcTime arrival);
  void findLeastStep(UtcTime arrival);
  static double slope(const Bucket& from, const Bucket& to);

  std::array<Bucket, kBuckets> buckets_;
  std::size_t used_ = 0;
  std::size_t newest_ = 0;
  Bucket least_;                                         ///< the earliest sample of all
  std::optional<std::chrono::nanoseconds> last_offset_;  ///< of the newest sample; tells the day
  double drift_ = 0.0;
  std::chrono::nanoseconds jitter_{};
  std::chrono::nanoseconds least_step_ = kStep;  ///< of what the link's delays do not explain
  std::uint64_t samples_ = 0;
  std::uint64_t steps_ = 0;

  // Samples that have all been late since, most of them near the first and none much before it.
  std::optional<UtcTime> late_since_;
  std::chrono::nanoseconds together_near_{};  ///< the first one's offset
  std::chrono::nanoseconds least_late_offset_{};
  std::uint64_t late_samples_ = 0;
  std::uint64_t together_ = 0;  ///< those near the first, the first included
};

}  // namespace frontseat_driver::vehicle
