#include "sentence_rates.h"

#include <algorithm>

namespace frontseat_driver::ros_layer {

namespace {

double seconds(vehicle::SteadyTime::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

double perSecond(std::uint64_t count, double elapsed_s) {
  return elapsed_s > 0.0 ? static_cast<double>(count) / elapsed_s : 0.0;
}

}  // namespace

void SentenceRates::reset(vehicle::SteadyTime now) {
  used_ = 0;
  slice_ = 0;
  slices_used_ = 1;
  slice_begins_[slice_] = now;
}

void SentenceRates::count(std::string_view line, vehicle::SteadyTime arrival) {
  const std::string_view address = line.substr(std::min<std::size_t>(1, line.size()), kAddress);
  Entry& entry = entryOf(address.size() == kAddress ? address : "other");
  Slice& slice = entry.slices[slice_];
  if (entry.count == 0) {
    entry.first = arrival;
  } else {
    slice.shortest = std::min(slice.shortest, arrival - entry.last);
    slice.longest = std::max(slice.longest, arrival - entry.last);
  }
  ++entry.count;
  ++slice.count;
  entry.last = arrival;
}

SentenceRates::Entry& SentenceRates::entryOf(std::string_view address) {
  for (std::size_t i = 0; i < used_; ++i) {
    if (std::equal(address.begin(), address.end(), entries_[i].address.begin())) return entries_[i];
  }
  if (used_ == kMost) return entries_.back();
  Entry& added = entries_[used_++];
  added = {};
  const std::string_view name = used_ == kMost ? "other" : address;
  std::copy(name.begin(), name.end(), added.address.begin());
  return added;
}

std::vector<SentenceRates::Rate> SentenceRates::take(vehicle::SteadyTime now) {
  std::vector<Rate> rates;
  for (std::size_t i = 0; i < used_; ++i) rates.push_back(rateOf(entries_[i], now));
  beginSlice(now);
  return rates;
}

SentenceRates::Rate SentenceRates::rateOf(const Entry& entry, vehicle::SteadyTime now) const {
  Rate rate;
  rate.address = std::string(entry.address.data(), kAddress);
  rate.count = entry.count;
  rate.age_s = seconds(now - entry.last);
  Slice window;
  for (const Slice& slice : entry.slices) {
    window.count += slice.count;
    window.shortest = std::min(window.shortest, slice.shortest);
    window.longest = std::max(window.longest, slice.longest);
  }
  const std::size_t oldest = (slice_ + kWindow + 1 - slices_used_) % kWindow;
  rate.hz = perSecond(window.count, seconds(now - std::max(entry.first, slice_begins_[oldest])));
  if (window.shortest <= window.longest) {
    rate.shortest_s = seconds(window.shortest);
    rate.longest_s = seconds(window.longest);
  }
  const auto observed = entry.last - entry.first;
  if (entry.count >= kLeastCount && observed >= kLeastTime) {
    rate.usual_hz = perSecond(entry.count - 1, seconds(observed));
  }
  return rate;
}

void SentenceRates::beginSlice(vehicle::SteadyTime now) {
  slice_ = (slice_ + 1) % kWindow;
  slices_used_ = std::min(slices_used_ + 1, kWindow);
  slice_begins_[slice_] = now;
  for (std::size_t i = 0; i < used_; ++i) entries_[i].slices[slice_] = {};
}

}  // namespace frontseat_driver::ros_layer
