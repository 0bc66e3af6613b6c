#include "frontseat_driver/session/request_queue.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

namespace frontseat_driver::session {
namespace {

using namespace std::chrono_literals;
using vehicle::Acknowledgement;

constexpr vehicle::SteadyTime kStart{100s};

class Requests : public testing::Test {
 protected:
  RequestQueue::Id add(Request request) {
    queue_.add(
        std::move(request), "", [this](const Answer& answer) { answers_.push_back(answer); },
        kStart);
    const auto* open = queue_.dueAbort(kStart);
    if (open == nullptr) open = queue_.dueOther(kStart);
    return open == nullptr ? 0 : open->id;
  }

  static Acknowledgement acknowledged(Acknowledgement::Status status) {
    Acknowledgement ack;
    ack.status = status;
    return ack;
  }

  RequestQueue queue_{6s};
  std::vector<Answer> answers_;
};

TEST_F(Requests, AreSentAgainAfterAThirdOfTheirTime) {
  queue_.sent(add(AbortRequest{"test"}), kStart, true);
  EXPECT_EQ(queue_.dueAbort(kStart + 1999ms), nullptr);
  EXPECT_NE(queue_.dueAbort(kStart + 2s), nullptr);
  EXPECT_EQ(queue_.nextDue(), kStart + 2s);
}

TEST_F(Requests, ThatArePendingAreNotSentAgain) {
  const auto id = add(AbortRequest{"test"});
  queue_.sent(id, kStart, true);
  queue_.take(id, acknowledged(Acknowledgement::Status::Pending));
  EXPECT_EQ(queue_.dueAbort(kStart + 5999ms), nullptr);
  EXPECT_EQ(queue_.nextDue(), vehicle::SteadyTime::max());
  EXPECT_TRUE(answers_.empty());
  queue_.take(id, acknowledged(Acknowledgement::Status::Done));
  ASSERT_EQ(answers_.size(), 1U);
  EXPECT_TRUE(answers_[0].success);
}

TEST_F(Requests, AreAnsweredAtTheirDeadlineAndNotBefore) {
  queue_.sent(add(LogSwitch{"NVG", true}), kStart, true);
  EXPECT_EQ(queue_.nextDeadline(), kStart + 6s);
  EXPECT_TRUE(queue_.expire(kStart + 5999ms).empty());
  EXPECT_TRUE(answers_.empty());
  EXPECT_EQ(queue_.expire(kStart + 6s).size(), 1U);
  ASSERT_EQ(answers_.size(), 1U);
  EXPECT_FALSE(answers_[0].success);
}

}  // namespace
}  // namespace frontseat_driver::session
