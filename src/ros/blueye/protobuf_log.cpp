#include "blueye/protobuf_log.h"

#include <google/protobuf/stubs/logging.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>

namespace frontseat_driver::ros_layer::blueye_layer {

namespace {

using google::protobuf::LogHandler;
using google::protobuf::LogLevel;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kPause{10};

LogHandler* before = nullptr;
std::atomic<Clock::rep> next{0};

/// True for one caller in ten seconds, whatever thread it is on.
bool isTime() {
  const Clock::rep now = Clock::now().time_since_epoch().count();
  Clock::rep due = next;
  const Clock::rep then = now + Clock::duration{kPause}.count();
  return now >= due && next.compare_exchange_strong(due, then);
}

void log(LogLevel level, const char* file, int line, const std::string& text) {
  const bool drones = text.find("invalid UTF-8") != std::string::npos;
  if (before != nullptr && (!drones || isTime())) before(level, file, line, text);
}

}  // namespace

void throttleProtobufLog() {
  static std::once_flag once;
  std::call_once(once, [] { before = google::protobuf::SetLogHandler(log); });
}

}  // namespace frontseat_driver::ros_layer::blueye_layer
