#include "frontseat_driver/session/permission.h"

#include <gtest/gtest.h>

#include <string>

namespace frontseat_driver::session {
namespace {

using protocol::Dialect;
using vehicle::Grant;
using Mission = vehicle::MissionStatus::State;

void say(Permission& permission, bool granted) {
  protocol::bluefin::BackseatControl control;
  control.backseat_in_control = granted;
  permission.take(control);
}

struct Row {
  const char* name;
  ControlHook hook;
  void (*told)(Permission& permission);
  Grant grant;
  const char* reason;  ///< how it begins; empty if commands may go
};

const Row kRows[] = {
    {"nothing", ControlHook::None, [](Permission&) {}, Grant::Unknown, "there is no connection"},
    {"no_dialect", ControlHook::None, [](Permission& p) { p.connected(); }, Grant::Unknown,
     "the vehicle has not shown its dialect"},
    {"no_connection", ControlHook::None, [](Permission& p) { p.setDialect(Dialect::Sandshark); },
     Grant::Unknown, "there is no connection"},
    {"sandshark_asks_nobody", ControlHook::None,
     [](Permission& p) {
       p.connected();
       p.setDialect(Dialect::Sandshark);
     },
     Grant::Granted, ""},
    {"kingfisher_asks_nobody", ControlHook::Ctl,
     [](Permission& p) {
       p.connected();
       p.setDialect(Dialect::Kingfisher);
     },
     Grant::Granted, ""},
    {"no_word_of_ctl", ControlHook::Ctl,
     [](Permission& p) {
       p.connected();
       p.setDialect(Dialect::Sandshark);
       p.take(Mission::Running);  // of the other hook
     },
     Grant::Unknown, "the vehicle has sent no BFCTL"},
    {"ctl_without_a_value", ControlHook::Ctl,
     [](Permission& p) {
       p.connected();
       p.setDialect(Dialect::Sandshark);
       say(p, true);
       p.take(protocol::bluefin::BackseatControl{});
     },
     Grant::Granted, ""},
    {"ctl_taken_back", ControlHook::Ctl,
     [](Permission& p) {
       p.connected();
       p.setDialect(Dialect::Sandshark);
       say(p, true);
       say(p, false);
     },
     Grant::Denied, "the vehicle keeps control"},
    {"no_word_of_mis", ControlHook::Mis,
     [](Permission& p) {
       p.connected();
       p.setDialect(Dialect::Sandshark);
       say(p, true);  // of the other hook
     },
     Grant::Unknown, "the vehicle has sent no BFMIS"},
    {"mission_runs", ControlHook::Mis,
     [](Permission& p) {
       p.connected();
       p.setDialect(Dialect::Sandshark);
       p.take(Mission::Running);
     },
     Grant::Granted, ""},
    {"mission_ended", ControlHook::Mis,
     [](Permission& p) {
       p.connected();
       p.setDialect(Dialect::Sandshark);
       p.take(Mission::Running);
       p.take(Mission::Completed);
     },
     Grant::Denied, "the vehicle's mission is not running"},
    {"word_of_an_earlier_connection", ControlHook::Ctl,
     [](Permission& p) {
       p.connected();
       p.setDialect(Dialect::Sandshark);
       say(p, true);
       p.disconnected();
       p.connected();
       p.setDialect(Dialect::Sandshark);
     },
     Grant::Unknown, "the vehicle has sent no BFCTL"},
    {"gate_closed", ControlHook::None,
     [](Permission& p) {
       p.connected();
       p.setDialect(Dialect::Sandshark);
       p.setCommandsEnabled(false);
     },
     Grant::Granted, "the command gate is closed"},
};

class Permissions : public testing::TestWithParam<Row> {};

TEST_P(Permissions, NeedConnectionDialectWordAndGate) {
  Permission permission{GetParam().hook, true};
  GetParam().told(permission);
  const ControlState state = permission.state();
  EXPECT_EQ(state.grant, GetParam().grant);
  const std::string reason{GetParam().reason};
  EXPECT_EQ(state.reason.substr(0, reason.size()), reason) << state.reason;
  EXPECT_EQ(state.reason.empty(), reason.empty());
  EXPECT_EQ(permission.granted(), reason.empty());
}

INSTANTIATE_TEST_SUITE_P(Table, Permissions, testing::ValuesIn(kRows),
                         [](const auto& row) { return std::string{row.param.name}; });

}  // namespace
}  // namespace frontseat_driver::session
