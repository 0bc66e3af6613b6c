#include "sentence_rates.h"

#include <algorithm>

namespace frontseat_driver::ros_layer {

void SentenceRates::count(std::string_view line, vehicle::SteadyTime arrival) {
  const std::string_view address = line.substr(std::min<std::size_t>(1, line.size()), kAddress);
  Entry& entry = entryOf(address.size() == kAddress ? address : "other");
  ++entry.count;
  entry.last = arrival;
}

SentenceRates::Entry& SentenceRates::entryOf(std::string_view address) {
  for (std::size_t i = 0; i < used_; ++i) {
    if (std::equal(address.begin(), address.end(), entries_[i].address.begin())) return entries_[i];
  }
  if (used_ == kMost) return entries_.back();
  Entry& added = entries_[used_++];
  const std::string_view name = used_ == kMost ? "other" : address;
  std::copy(name.begin(), name.end(), added.address.begin());
  return added;
}

std::vector<SentenceRates::Rate> SentenceRates::take(vehicle::SteadyTime now) {
  const double elapsed_s = std::chrono::duration<double>(now - taken_).count();
  taken_ = now;
  std::vector<Rate> rates;
  for (std::size_t i = 0; i < used_; ++i) {
    Entry& entry = entries_[i];
    const auto since_last = static_cast<double>(entry.count - entry.counted_before);
    entry.counted_before = entry.count;
    rates.push_back({std::string(entry.address.data(), kAddress),
                     elapsed_s > 0.0 ? since_last / elapsed_s : 0.0, entry.count, entry.last});
  }
  return rates;
}

}  // namespace frontseat_driver::ros_layer
