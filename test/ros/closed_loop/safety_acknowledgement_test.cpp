#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "safety.h"

// Acknowledgements that are withheld, late, doubled or pending for ever.

namespace frontseat_driver::closed_loop {
namespace {

using namespace std::chrono_literals;
using session::AbortRequest;
using session::LogSwitch;
using testing::HasSubstr;

TEST_F(Safety, WithheldAcksHoldUpNothing) {
  sim::SandsharkConfig vehicle = quietSandshark();
  vehicle.faults.withhold_acks = true;
  startSandshark(vehicle);
  const Duration begin = loop_->elapsed();
  const std::size_t log = loop_->request(LogSwitch{"CTD", true});
  const std::size_t modified = loop_->request(vehicle::BehaviorCommand{});
  loop_->publishFor(heading(0.0), 100ms, 1s);
  EXPECT_GE(behaviorsSince(begin).size(), 9u);
  const Duration asked = loop_->elapsed();
  const std::size_t abort = loop_->request(AbortRequest{"leak", true});
  loop_->pass(4s);
  EXPECT_LE(loop_->sent("BPABT", asked).front().at - asked, kSandsharkSpacing);
  EXPECT_TRUE(ascends());
  for (const std::size_t request : {log, modified, abort}) {
    EXPECT_LE(waitedFor(request), kAckTimeout);
    EXPECT_THAT(answerTo(request).answer.message, HasSubstr("did not acknowledge it within 3.0 s"));
  }
}

TEST_F(Safety, DelayedAcksAreTheAnswerWhileSomebodyWaits) {
  sim::SandsharkConfig vehicle = quietSandshark();
  vehicle.faults.delay_acks_s = 2.5;
  startSandshark(vehicle);
  loop_->pass(5s);
  const std::size_t modified = loop_->request(vehicle::BehaviorCommand{});
  const std::size_t abort = loop_->request(AbortRequest{"leak", true});
  loop_->pass(10s);
  for (const std::size_t request : {modified, abort}) {
    EXPECT_TRUE(answerTo(request).answer.success) << answerTo(request).answer.message;
    EXPECT_LE(waitedFor(request), kAckTimeout);
  }
}

TEST_F(Safety, AcksThatComeTooLateAreNobodysAnswer) {
  sim::SandsharkConfig vehicle = quietSandshark();
  vehicle.faults.delay_acks_s = 4.0;
  startSandshark(vehicle);
  loop_->pass(5s);
  const std::size_t first = loop_->request(vehicle::BehaviorCommand{});
  loop_->pass(3500ms);
  const std::size_t second = loop_->request(vehicle::BehaviorCommand{});
  loop_->pass(1min);
  for (const std::size_t request : {first, second}) {
    EXPECT_FALSE(answerTo(request).answer.success);
    EXPECT_EQ(waitedFor(request), kAckTimeout);
  }
}

TEST_F(Safety, DuplicatedAcksAnswerOnce) {
  startSandshark();
  loop_->link.edit = [](std::string_view bytes) { return std::string{bytes} + std::string{bytes}; };
  std::vector<std::size_t> requests;
  for (const char* name : {"CTD", "DVL", "RVL", "XYZ"}) {
    requests.push_back(loop_->request(LogSwitch{name, true}));
    requests.push_back(loop_->request(vehicle::BehaviorCommand{}));
    loop_->publishFor(heading(0.0), 50ms, 500ms);
  }
  requests.push_back(loop_->request(AbortRequest{"leak", true}));
  loop_->pass(10s);
  for (const std::size_t request : requests) EXPECT_LE(waitedFor(request), kAckTimeout);
  EXPECT_FALSE(answerTo(requests[6]).answer.success) << "there is no XYZ";
  EXPECT_TRUE(answerTo(requests.back()).answer.success);
}

TEST_F(Safety, PendingForEverIsAnsweredInTimeAndHoldsUpNoAbort) {
  sim::SandsharkConfig vehicle = quietSandshark();
  vehicle.pending_s = 1e6;
  startSandshark(vehicle);
  const std::size_t modified = loop_->request(vehicle::BehaviorCommand{});
  loop_->pass(1s);
  const Duration asked = loop_->elapsed();
  const std::size_t abort = loop_->request(AbortRequest{"leak", true});
  loop_->pass(5s);
  EXPECT_EQ(answerTo(modified).answer.message, "the vehicle is still working on it after 3.0 s");
  EXPECT_EQ(waitedFor(modified), kAckTimeout);
  EXPECT_TRUE(answerTo(abort).answer.success);
  EXPECT_LE(waitedFor(abort), 100ms);
  EXPECT_LE(loop_->sent("BPABT", asked).front().at - asked, kSandsharkSpacing);
}

}  // namespace
}  // namespace frontseat_driver::closed_loop
