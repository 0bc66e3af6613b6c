#include "frontseat_driver/vehicle/clock_offset.h"

#include <algorithm>
#include <cmath>

#include "frontseat_driver/vehicle/date_resolution.h"

namespace frontseat_driver::vehicle {

namespace {

using std::chrono::nanoseconds;
using namespace std::chrono_literals;

constexpr nanoseconds kBucket = 1s;
// Enough seconds for a slope that is better than none.
constexpr std::size_t kDriftBuckets = 10;
constexpr std::uint64_t kJitterWeight = 64;
constexpr double kMostDrift = ClockOffset::kMostDrift_ppm * 1e-6;
// Delays of a good link differ by less.
constexpr nanoseconds kTogether = 50ms;
// Drift, rounding and a good link's delays stay below.
constexpr nanoseconds kSmallestStep = 20ms;
// Seconds that show how late the earliest sample of one can be.
constexpr std::size_t kSettledBuckets = 10;
// A small step is told from a run of long delays by more of them.
constexpr std::uint64_t kSmallStepSamples = 20;
constexpr nanoseconds kSmallStepPatience = 2s;

double seconds(nanoseconds duration) { return std::chrono::duration<double>(duration).count(); }

nanoseconds scaled(nanoseconds duration, double factor) {
  return nanoseconds{std::llround(static_cast<double>(duration.count()) * factor)};
}

}  // namespace

void ClockOffset::take(TimeOfDay sent_at, UtcTime arrival) {
  const nanoseconds offset = arrival - unwrapped(sent_at, arrival);
  last_offset_ = offset;
  if (used_ == 0) return startAgain(offset, arrival);
  const Bucket& newest = buckets_[newest_];
  const bool nothing_recent = arrival < newest.at || arrival > newest.at + kWindow;
  const nanoseconds late = offset - offsetAt(arrival);
  if (nothing_recent || late < -least_step_) {
    steps_ += late < -least_step_ || late > kStep ? 1 : 0;
    return startAgain(offset, arrival);
  }
  if (lateForLong(late, offset, arrival)) {
    ++steps_;
    return startAgain(least_late_offset_, arrival);
  }
  ++samples_;
  if (late <= kStep) {
    const auto weight = static_cast<nanoseconds::rep>(std::min(samples_, kJitterWeight));
    jitter_ += (std::max(late, nanoseconds::zero()) - jitter_) / weight;
  }
  put(offset, arrival);
}

// The day that makes the offset most like the last sample's: the vehicle's date need not be known,
// only that neither clock jumped by half a day.
UtcTime ClockOffset::unwrapped(TimeOfDay time, UtcTime arrival) const {
  return resolveDate(time, arrival - last_offset_.value_or(nanoseconds::zero()));
}

// After a step the samples lie close to each other at their new place, one after another, as close
// as the delays of the link let them. What a network has held back comes in a rush, each less late
// than the one before, and a rush may follow on another without an early one in between.
bool ClockOffset::lateForLong(nanoseconds late, nanoseconds offset, UtcTime arrival) {
  if (late <= least_step_) {
    late_since_.reset();
    return false;
  }
  const nanoseconds together = std::max(kTogether, 2 * jitter_);
  const bool near = late_since_ && offset <= together_near_ + together;
  const bool outvoted = late_since_ && !near && 2 * together_ <= late_samples_ + 1;
  if (!late_since_ || outvoted || offset < together_near_ - together) {
    late_since_ = arrival;
    together_near_ = least_late_offset_ = offset;
    late_samples_ = together_ = 1;
    return false;
  }
  ++late_samples_;
  if (!near) return false;
  ++together_;
  least_late_offset_ = std::min(least_late_offset_, offset);
  const bool small = least_late_offset_ - offsetAt(arrival) <= kStep;
  if (small && together_ < kSmallStepSamples) return false;
  const nanoseconds patience = small ? kSmallStepPatience : kStepPatience;
  return arrival - *late_since_ >= patience;
}

void ClockOffset::startAgain(nanoseconds offset, UtcTime arrival) {
  used_ = 0;
  newest_ = 0;
  drift_ = 0.0;
  samples_ = 1;
  least_step_ = kStep;
  late_since_.reset();
  put(offset, arrival);
}

void ClockOffset::put(nanoseconds offset, UtcTime arrival) {
  Bucket& newest = buckets_[newest_];
  if (used_ > 0 && arrival < newest.begin + kBucket) {
    if (offset < newest.offset) newest = {newest.begin, arrival, offset};
    if (offset < offsetAt(arrival)) least_ = newest;
    return;
  }
  if (used_ > 0) newest_ = (newest_ + 1) % kBuckets;
  used_ = std::min(used_ + 1, kBuckets);
  buckets_[newest_] = {arrival, arrival, offset};
  fitDrift();
  findLeast(arrival);
  if (!late_since_) findLeastStep(arrival);
}

// The line under all samples that is closest to them: the edge of their lower convex hull above the
// mean of their times (S. B. Moon, P. Skelly, D. Towsley: Estimation and removal of clock skew from
// network delay measurements, INFOCOM 1999). Late samples, however late, do not move it.
void ClockOffset::fitDrift() {
  if (used_ < kDriftBuckets) return;
  std::array<Bucket, kBuckets> hull;
  std::size_t size = 0;
  nanoseconds mean_age{};
  const Bucket& newest = buckets_[newest_];
  const std::size_t complete = used_ - 1;  // the newest has only begun
  for (std::size_t i = 0; i < complete; ++i) {
    const Bucket& bucket = buckets_[(newest_ + kBuckets - complete + i) % kBuckets];
    mean_age += (newest.at - bucket.at) / static_cast<nanoseconds::rep>(complete);
    while (size > 1 && slope(hull[size - 2], hull[size - 1]) >= slope(hull[size - 1], bucket)) {
      --size;
    }
    hull[size++] = bucket;
  }
  for (std::size_t i = 1; i < size; ++i) {
    if (newest.at - hull[i].at > mean_age) continue;
    drift_ = std::clamp(slope(hull[i - 1], hull[i]), -kMostDrift, kMostDrift);
    return;
  }
}

double ClockOffset::slope(const Bucket& from, const Bucket& to) {
  return seconds(to.offset - from.offset) / seconds(to.at - from.at);
}

nanoseconds ClockOffset::offsetAt(UtcTime arrival) const {
  return least_.offset + scaled(std::min<nanoseconds>(arrival - least_.at, kWindow), drift_);
}

// The drift is the same for all, so the earliest sample stays the earliest while time goes on.
void ClockOffset::findLeast(UtcTime arrival) {
  least_ = buckets_[newest_];
  for (std::size_t i = 0; i < used_; ++i) {
    const Bucket& bucket = buckets_[i];
    const bool earlier = bucket.offset + scaled(arrival - bucket.at, drift_) < offsetAt(arrival);
    if (earlier && arrival - bucket.at <= kWindow) least_ = bucket;
  }
}

// Only what is beyond all that the link has shown can be a step: for a second after another nothing
// came as early as usual.
void ClockOffset::findLeastStep(UtcTime arrival) {
  if (used_ <= kSettledBuckets) return;
  least_step_ = kSmallestStep;
  for (std::size_t i = 0; i < used_; ++i) {
    const Bucket& bucket = buckets_[i];
    if (i == newest_ || arrival - bucket.at > kWindow) continue;  // the newest has only begun
    const nanoseconds late = bucket.offset - offsetAt(bucket.at);
    least_step_ = std::max(least_step_, std::min<nanoseconds>(late + late / 2, kStep));
  }
}

std::optional<UtcTime> ClockOffset::toHost(TimeOfDay time, UtcTime arrival) const {
  if (used_ == 0) return std::nullopt;
  return unwrapped(time, arrival) + offsetAt(arrival);
}

void ClockOffset::reset() { *this = ClockOffset{}; }

ClockOffset::State ClockOffset::state() const {
  State state;
  if (used_ == 0) return state;
  state.samples = samples_;
  state.steps = steps_;
  state.offset = offsetAt(buckets_[newest_].at);
  state.jitter = jitter_;
  state.drift_ppm = drift_ * 1e6;
  return state;
}

}  // namespace frontseat_driver::vehicle
