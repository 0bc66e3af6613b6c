#include <chrono>
#include <cstddef>
#include <ostream>
#include <string>

#include "safety.h"

// A Sandshark follows for five seconds: it must hear the next command before.

namespace frontseat_driver::closed_loop {
namespace {

using namespace std::chrono_literals;
using protocol::Dialect;

struct Keeping {
  const char* name;
  Duration publish_period;
  double command_rate_hz;
  Duration command_timeout;
  std::chrono::milliseconds spacing;
};

void PrintTo(const Keeping& row, std::ostream* out) { *out << row.name; }

// 0.25 Hz and 5 s are the least and the most that the parameters take.
const Keeping kKeepings[] = {
    {"slowest_of_all", 4900ms, 0.25, 5s, 60ms}, {"slow_repetition", 200ms, 0.25, 5s, 60ms},
    {"slow_program", 4900ms, 5.0, 5s, 60ms},    {"in_step", 4s, 0.25, 5s, 60ms},
    {"wide_spacing", 4900ms, 0.25, 5s, 500ms},  {"widest_spacing", 4900ms, 0.25, 5s, 1000ms},
    {"default", 200ms, 5.0, 1s, 60ms},
};

class SafetyKeeping : public Safety, public testing::WithParamInterface<Keeping> {};

TEST_P(SafetyKeeping, SandsharkHearsABehaviorWithinFiveSecondsWhileTheCommandIsFresh) {
  ros_layer::Parameters parameters = parametersFor(Dialect::Sandshark);
  parameters.session.command_rate_hz = GetParam().command_rate_hz;
  parameters.session.command_timeout = GetParam().command_timeout;
  parameters.session.send_spacing = GetParam().spacing;
  sim::SandsharkConfig vehicle = quietSandshark();
  vehicle.mission.ready_s = 9.0;  // wide spacing takes its time for the handshake
  start(parameters, vehicle);
  const Duration begin = loop_->elapsed();
  std::size_t lost = 0;
  loop_->publish(heading(0.0));
  loop_->pass(2 * GetParam().spacing);
  loop_->watch.step = [&] { lost += loop_->sandshark().backseatSteers() ? 0 : 1; };
  loop_->publishFor(heading(0.0), GetParam().publish_period, 5min);
  loop_->watch.step = nullptr;
  const auto behaviors = behaviorsSince(begin);
  for (std::size_t i = 1; i < behaviors.size(); ++i) {
    EXPECT_LT(behaviors[i].at - behaviors[i - 1].at, 5s);
  }
  EXPECT_EQ(lost, 0u) << "steps in which the vehicle went its own way";
}

INSTANTIATE_TEST_SUITE_P(Table, SafetyKeeping, testing::ValuesIn(kKeepings),
                         [](const auto& row) { return std::string{row.param.name}; });

}  // namespace
}  // namespace frontseat_driver::closed_loop
