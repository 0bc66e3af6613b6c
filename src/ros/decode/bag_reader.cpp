#include "bag_reader.h"

#include <frontseat_driver/Sentence.h>
#include <ros/message_traits.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <optional>
#include <set>
#include <stdexcept>
#include <vector>

#include "../topics.h"

namespace frontseat_driver::decode {
namespace {

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// "/alpha/" of "/alpha/nmea/rx"; nothing for another topic.
std::optional<std::string> namespaceOf(const std::string& topic) {
  for (const std::string name : {ros_layer::topics::kNmeaReceived, ros_layer::topics::kNmeaSent}) {
    const bool whole = endsWith(topic, "/" + name) || topic == name;
    if (whole) return topic.substr(0, topic.size() - name.size());
  }
  return std::nullopt;
}

std::string trimmed(std::string name) {
  while (!name.empty() && name.back() == '/') name.pop_back();
  return name.substr(std::min(name.find_first_not_of('/'), name.size()));
}

vehicle::UtcTime toUtc(const ros::Time& time) {
  return std::chrono::seconds{time.sec} + std::chrono::nanoseconds{time.nsec};
}

class BagReader : public capture::Reader {
 public:
  BagReader(const std::string& path, const std::string& vehicle) {
    bag_.open(path, rosbag::bagmode::Read);
    view_.addQuery(bag_, rosbag::TopicQuery(topicsOf(vehicle)));
    at_ = view_.begin();
  }

  std::optional<capture::Entry> next() override {
    while (at_ != view_.end()) {
      const rosbag::MessageInstance& message = *at_;
      counters_.bytes += message.size();
      sentence_ = message.instantiate<Sentence>();
      const bool sent = endsWith(message.getTopic(), ros_layer::topics::kNmeaSent);
      const bool stamped = sentence_ && !sentence_->header.stamp.isZero();
      const ros::Time stamp = stamped ? sentence_->header.stamp : message.getTime();
      ++at_;
      // What a driver recorded begins with `$`; but anybody may have written the bag.
      const bool whole = sentence_ && !sentence_->sentence.empty() && sentence_->sentence[0] == '$';
      if (whole) {
        return capture::Entry{
            toUtc(stamp), sent ? capture::Direction::ToVehicle : capture::Direction::FromVehicle,
            sentence_->sentence};
      }
      ++counters_.other_lines;
    }
    return std::nullopt;
  }

  capture::ReadCounters counters() const override { return counters_; }

 private:
  std::vector<std::string> topicsOf(const std::string& vehicle) {
    rosbag::View all{bag_};
    std::set<std::string> vehicles;
    std::vector<std::string> topics;
    for (const rosbag::ConnectionInfo* const connection : all.getConnections()) {
      const auto name = namespaceOf(connection->topic);
      if (!name || connection->datatype != ros::message_traits::datatype<Sentence>()) continue;
      vehicles.insert("/" + trimmed(*name));
      const bool wanted = vehicle.empty() || trimmed(vehicle) == trimmed(*name);
      if (wanted) topics.push_back(connection->topic);
    }
    check(vehicles, topics, vehicle);
    return topics;
  }

  static void check(const std::set<std::string>& vehicles, const std::vector<std::string>& topics,
                    const std::string& vehicle) {
    std::string names;
    for (const std::string& name : vehicles) names += (names.empty() ? "" : ", ") + name;
    if (vehicles.empty()) {
      throw std::runtime_error("the bag has no topic nmea/rx or nmea/tx of frontseat_driver");
    }
    if (topics.empty()) {
      throw std::runtime_error("the bag has no vehicle " + vehicle + "; it has " + names);
    }
    if (vehicle.empty() && vehicles.size() > 1) {
      throw std::runtime_error("the bag has several vehicles; choose one with --vehicle: " + names);
    }
  }

  rosbag::Bag bag_;
  rosbag::View view_;
  rosbag::View::iterator at_;
  Sentence::ConstPtr sentence_;  ///< which the last entry is a view of
  capture::ReadCounters counters_;
};

/// Turns what rosbag throws into lines that help.
class GuardedBagReader : public capture::Reader {
 public:
  GuardedBagReader(const std::string& path, const std::string& vehicle)
      : path_(path), reader_(guarded([&] { return std::make_unique<BagReader>(path, vehicle); })) {}

  std::optional<capture::Entry> next() override {
    return guarded([this] { return reader_->next(); });
  }
  capture::ReadCounters counters() const override { return reader_->counters(); }

 private:
  template <class Action>
  auto guarded(Action&& action) const -> decltype(action()) {
    try {
      return action();
    } catch (const rosbag::BagUnindexedException&) {
      throw std::runtime_error(path_ + ": the bag has no index; make one with: rosbag reindex");
    } catch (const std::exception& error) {
      throw std::runtime_error(path_ + ": " + error.what());
    }
  }

  std::string path_;
  std::unique_ptr<BagReader> reader_;
};

}  // namespace

std::unique_ptr<capture::Reader> openBag(const std::string& path, const std::string& vehicle) {
  return std::make_unique<GuardedBagReader>(path, vehicle);
}

}  // namespace frontseat_driver::decode
