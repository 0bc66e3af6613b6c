#pragma once

#include <cstddef>
#include <map>
#include <string>

namespace frontseat_driver::ros_layer::blueye_layer {

/// Which notifications have been told: the drone repeats each with the timestamp that it had.
class Repeats {
 public:
  /// More than the protocol has names; whatever numbers come, no more are kept.
  static constexpr std::size_t kMost = 1000;

  /// True if the last one of this name was raised at the same time. Remembers it.
  bool isRepeated(const std::string& name, const std::string& raised) {
    const auto known = last_.find(name);
    if (known == last_.end() && last_.size() >= kMost) last_.clear();
    std::string& last = last_[name];
    if (last == raised) return true;
    last = raised;
    return false;
  }

  std::size_t size() const { return last_.size(); }

 private:
  std::map<std::string, std::string> last_;
};

}  // namespace frontseat_driver::ros_layer::blueye_layer
