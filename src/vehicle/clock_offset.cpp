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
constexpr std::int64_t kJitterWeight = 64;
constexpr double kMostDrift = ClockOffset::kMostDrift_ppm * 1e-6;
// Usual delays differ by less.
constexpr nanoseconds kTogether = 50ms;

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
  if (nothing_recent || late < -kStep) {
    steps_ += late < -kStep || late > kStep ? 1 : 0;
    return startAgain(offset, arrival);
  }
  if (lateForLong(late, offset, arrival)) {
    ++steps_;
    return startAgain(least_late_offset_, arrival);
  }
  ++samples_;
  jitter_ += (std::max(late, nanoseconds::zero()) - jitter_) / kJitterWeight;
  put(offset, arrival);
}

// The day that makes the offset most like the last sample's: the vehicle's date need not be known,
// only that neither clock jumped by half a day.
UtcTime ClockOffset::unwrapped(TimeOfDay time, UtcTime arrival) const {
  return resolveDate(time, arrival - last_offset_.value_or(nanoseconds::zero()));
}

// After a step the samples lie close to each other at their new place, one after another. What a
// network has held back comes in a rush, each less late than the one before, and a rush may follow
// on another without an early one in between.
bool ClockOffset::lateForLong(nanoseconds late, nanoseconds offset, UtcTime arrival) {
  if (late <= kStep) {
    late_since_.reset();
    return false;
  }
  if (!late_since_) {
    late_since_ = arrival;
    late_samples_ = 0;
    least_late_offset_ = nanoseconds::max();
  }
  if (offset < least_late_offset_ - kTogether) {
    together_ = 0;
    together_since_ = arrival;
  }
  least_late_offset_ = std::min(least_late_offset_, offset);
  ++late_samples_;
  if (offset >= least_late_offset_ + kTogether) return false;
  ++together_;
  return arrival - together_since_ >= kStepPatience && 2 * together_ > late_samples_;
}

void ClockOffset::startAgain(nanoseconds offset, UtcTime arrival) {
  used_ = 0;
  newest_ = 0;
  drift_ = 0.0;
  samples_ = 1;
  jitter_ = nanoseconds::zero();
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
