#include <cstddef>
#include <memory>
#include <ostream>
#include <string>

#include "safety.h"

// The driver ends, whatever it was doing.

namespace frontseat_driver::closed_loop {
namespace {

using namespace std::chrono_literals;
using protocol::Dialect;
using session::AbortRequest;
using session::LogSwitch;
using testing::IsEmpty;
using testing::SizeIs;

struct Leaving {
  const char* name;
  Dialect dialect;
  void (*reach)(ClosedLoop&);
  std::size_t zeros;  ///< that the vehicle hears after it
};

void PrintTo(const Leaving& row, std::ostream* out) { *out << row.name; }

void connected(ClosedLoop& loop) {
  loop.connect();
  loop.pass(3s);
}

void commanded(ClosedLoop& loop) {
  connected(loop);
  loop.publishFor(drive(0.5, 0.5), 100ms, 1s);
}

void behaving(ClosedLoop& loop) {
  connected(loop);
  loop.publishFor(heading(0.0), 100ms, 1s);
}

const Leaving kLeavings[] = {
    {"never_connected", Dialect::Kingfisher, [](ClosedLoop&) {}, 0},
    {"kingfisher_idle", Dialect::Kingfisher, connected, 0},
    {"kingfisher_commanded", Dialect::Kingfisher, commanded, 1},
    {"kingfisher_sentence_just_out", Dialect::Kingfisher,
     [](ClosedLoop& loop) {
       commanded(loop);
       loop.publish(drive(0.7, 0.7));
     },
     1},
    {"kingfisher_stale", Dialect::Kingfisher,
     [](ClosedLoop& loop) {
       commanded(loop);
       loop.pass(5s);
     },
     0},
    {"kingfisher_stopped_zero_not_out", Dialect::Kingfisher,
     [](ClosedLoop& loop) {
       commanded(loop);
       loop.publish(drive(0.7, 0.7));
       loop.stop();
     },
     1},
    {"kingfisher_gate_closed_zero_not_out", Dialect::Kingfisher,
     [](ClosedLoop& loop) {
       commanded(loop);
       loop.publish(drive(0.7, 0.7));
       loop.gate(false);
     },
     1},
    {"kingfisher_stopped", Dialect::Kingfisher,
     [](ClosedLoop& loop) {
       commanded(loop);
       loop.stop();
       loop.pass(1s);
     },
     0},
    {"kingfisher_link_lost", Dialect::Kingfisher,
     [](ClosedLoop& loop) {
       commanded(loop);
       loop.disconnect();
     },
     0},
    {"kingfisher_connected_again", Dialect::Kingfisher,
     [](ClosedLoop& loop) {
       commanded(loop);
       loop.disconnect();
       connected(loop);
     },
     0},
    {"sandshark_in_handshake", Dialect::Sandshark,
     [](ClosedLoop& loop) {
       loop.connect();
       loop.pass(100ms);
     },
     0},
    {"sandshark_idle", Dialect::Sandshark, connected, 0},
    {"sandshark_commanded", Dialect::Sandshark, behaving, 0},
    {"sandshark_without_control", Dialect::Sandshark,
     [](ClosedLoop& loop) {
       behaving(loop);
       loop.sandshark().setBackseatControl(false);
       loop.pass(100ms);
     },
     0},
    {"sandshark_requests_waiting", Dialect::Sandshark,
     [](ClosedLoop& loop) {
       behaving(loop);
       for (int i = 0; i < 10; ++i) loop.request(LogSwitch{"CTD", true});
       loop.request(vehicle::BehaviorCommand{});
       loop.request(AbortRequest{"leak", true});
     },
     0},
};

class SafetyLeaving : public Safety, public testing::WithParamInterface<Leaving> {
 protected:
  void reach() {
    const ros_layer::Parameters parameters = parametersFor(GetParam().dialect);
    if (GetParam().dialect == Dialect::Sandshark) {
      loop_ = std::make_unique<ClosedLoop>(parameters, quietSandshark());
    } else {
      loop_ = std::make_unique<ClosedLoop>(parameters, quietKingfisher());
    }
    GetParam().reach(*loop_);
  }
};

TEST_P(SafetyLeaving, SaysWhatIsDueWithinTheLastWordsAndNothingAfter) {
  reach();
  const std::size_t before = loop_->sent().size();
  loop_->leave();
  loop_->pass(40ms);  // what driver::Driver gives it
  EXPECT_TRUE(loop_->session().hasLeft());
  loop_->publish(drive(0.5, 0.5));
  loop_->publish(heading(0.0));
  loop_->stop();
  loop_->gate(true);
  loop_->request(AbortRequest{"too late", true});
  loop_->pass(30s);
  ASSERT_EQ(loop_->sent().size() - before, GetParam().zeros);
  if (GetParam().zeros > 0) {
    EXPECT_EQ(loop_->sent().back().sentence, kZero);
  }
  for (const Asked& asked : loop_->asked()) EXPECT_THAT(asked.answers, SizeIs(1));
}

INSTANTIATE_TEST_SUITE_P(States, SafetyLeaving, testing::ValuesIn(kLeavings),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST_F(Safety, LeavingBeforeTheDialectIsKnownSaysNothing) {
  ros_layer::Parameters parameters = quiet(Dialect::Sandshark);
  parameters.session.dialect.reset();
  loop_ = std::make_unique<ClosedLoop>(parameters, quietSandshark());
  loop_->link.delivers = false;
  loop_->connect();
  loop_->pass(1s);
  loop_->leave();
  EXPECT_TRUE(loop_->session().hasLeft());
  loop_->link.delivers = true;
  loop_->pass(10s);
  EXPECT_THAT(loop_->sent(), IsEmpty());
}

TEST_F(Safety, LeavingAFullLinkTriesUntilTheDriverGivesUp) {
  startKingfisher();
  loop_->publishFor(drive(0.5, 0.5), 100ms, 1s);
  loop_->link.takes = false;
  loop_->leave();
  loop_->pass(100ms);
  EXPECT_FALSE(loop_->session().hasLeft());
  loop_->link.takes = true;
  const Duration taken = loop_->elapsed();
  loop_->pass(kKingfisherSpacing);
  EXPECT_TRUE(loop_->session().hasLeft());
  ASSERT_THAT(sentSince(taken), SizeIs(1));
  EXPECT_EQ(loop_->sent().back().sentence, kZero);
}

}  // namespace
}  // namespace frontseat_driver::closed_loop
