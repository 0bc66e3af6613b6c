#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frontseat_driver/session/session.h"

namespace frontseat_driver::session {

/// Records a session's output. Texts of events are copied where a test looks at them.
class Recorder : public Output {
 public:
  struct Sent {
    SteadyTime at;
    std::string sentence;
  };

  bool send(const Now& now, std::string_view sentence) override {
    if (!link_takes) return false;
    sent.push_back({now.steady, std::string{sentence}});
    return true;
  }
  bool congested() const override { return link_is_full; }
  void heard(const Now&, std::string_view line) override { lines.emplace_back(line); }
  void event(const Now&, const vehicle::Event& event) override {
    events.push_back(event);
    if (const auto* changed = std::get_if<vehicle::Control>(&event)) {
      control = *changed;
      reason = std::string{changed->reason};
    }
    if (const auto* changed = std::get_if<vehicle::MissionStatus>(&event)) {
      mission_status = std::string{changed->status};
    }
    if (const auto* told = std::get_if<vehicle::Acknowledgement>(&event)) {
      acknowledged_command = std::string{told->command};
    }
    if (const auto* told = std::get_if<vehicle::InterfaceVersion>(&event)) {
      version = std::string{told->version};
    }
  }
  void confirmed() override { ++confirmations; }

  std::vector<std::string> sentences() const {
    std::vector<std::string> texts;
    for (const Sent& one : sent) texts.push_back(one.sentence);
    return texts;
  }

  template <class T>
  std::vector<T> eventsOf() const {
    std::vector<T> found;
    for (const vehicle::Event& event : events) {
      if (const T* one = std::get_if<T>(&event)) found.push_back(*one);
    }
    return found;
  }

  bool link_takes = true;
  bool link_is_full = false;
  std::vector<Sent> sent;
  std::vector<std::string> lines;
  std::vector<vehicle::Event> events;  ///< their texts do not outlive the call
  vehicle::Control control;
  std::string reason;
  std::string mission_status;
  std::string acknowledged_command;
  std::string version;
  int confirmations = 0;
};

}  // namespace frontseat_driver::session
