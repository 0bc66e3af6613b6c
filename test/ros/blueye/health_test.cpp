// What /diagnostics tell: the level and what to do.

#include "blueye/health.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

namespace frontseat_driver::ros_layer::blueye_layer {
namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr auto kOk = DiagnosticStatus::OK;
constexpr auto kWarn = DiagnosticStatus::WARN;
constexpr auto kError = DiagnosticStatus::ERROR;

struct Row {
  const char* name;
  Report report;
  std::function<void(Health&)> change;  ///< of a connected observer
  std::int8_t level;
  const char* text;
};

const Row kRows[] = {
    {"connected", reportLink, [](Health&) {}, kOk, "connected to drone:5555"},
    {"connecting", reportLink, [](Health& h) { h.connected = false; }, kOk, "connecting to"},
    {"gone", reportLink,
     [](Health& h) {
       h.connected = false;
       h.last_failure = "no answer at drone:5555 within 2.0 s";
     },
     kError, "within 2.0 s; is the drone on"},
    {"odd_host", reportLink,
     [](Health& h) {
       h.connected = false;
       h.last_failure = "cannot open a connection to a:1: Invalid argument";
     },
     kError, "is parameter host right"},
    {"stuck", reportLink, [](Health& h) { h.unreported_s = 6.0; }, kError, "for 6 s; restart it"},
    {"record_that_stands_still", reportLink,
     [](Health& h) {
       h.replay = true;
       h.unreported_s = 60.0;
     },
     kOk, "waiting for a record on drone:5555"},
    {"observer", reportControl, [](Health& h) { h.refusal = "take it"; }, kOk, "take it"},
    {"in_control", reportControl, [](Health&) {}, kOk, "this driver is in control"},
    {"idle", reportCommands, [](Health&) {}, kOk, "nothing is commanded"},
    {"driving", reportCommands, [](Health& h) { h.commanding = true; }, kOk, "commanding"},
    {"refused", reportCommands,
     [](Health& h) {
       h.refused_lately = true;
       h.refusal = "service take_control takes it";
     },
     kWarn, "refused: service take_control takes it"},
    {"refused_for_itself", reportCommands, [](Health& h) { h.refused_lately = true; }, kWarn,
     "the log has the reason"},
    {"no_flags", reportDrone, [](Health&) {}, kOk, "no error flags"},
    {"flag", reportDrone, [](Health& h) { h.error_flags = {"spi_comm"}; }, kWarn,
     "spi_comm: bring the drone up"},
    {"grave_flag", reportDrone,
     [](Health& h) {
       h.error_flags = {"x", "depth_read"};
     },
     kError, "x; depth_read: bring the drone up"},
    {"full_storage", reportDrone,
     [](Health& h) {
       h.values["VideoStorageSpaceTel"] = {{"storage_space.total_space", "100"}};
     },
     kWarn, "0 % of the video storage is free"},
    {"storage", reportDrone,
     [](Health& h) {
       h.values["VideoStorageSpaceTel"] = {{"storage_space.total_space", "100"},
                                           {"storage_space.free_space", "10"}};
     },
     kOk, "no error flags"},
    {"no_battery", reportBattery, [](Health&) {}, kOk, "told no battery yet"},
    {"battery_is_no_number", reportBattery, [](Health& h) { h.battery_level = NAN; }, kOk,
     "told no battery yet"},
    {"battery", reportBattery, [](Health& h) { h.battery_level = 0.2; }, kOk, "20 %"},
    {"low_battery", reportBattery, [](Health& h) { h.battery_level = 0.19; }, kWarn,
     "19 %: bring the drone up and charge it"},
    {"battery_of_a_drone_that_is_gone", reportBattery,
     [](Health& h) {
       h.connected = false;
       h.battery_level = 0.75;
     },
     kOk, "75 % when it was last heard"},
};

class OneReport : public testing::TestWithParam<Row> {};

TEST_P(OneReport, HasTheLevelAndSaysWhatToDo) {
  Health health;
  health.connected = true;
  health.endpoint = "drone:5555";
  GetParam().change(health);
  diagnostic_updater::DiagnosticStatusWrapper status;
  GetParam().report(health, status);
  EXPECT_EQ(status.level, GetParam().level) << status.message;
  EXPECT_NE(status.message.find(GetParam().text), std::string::npos) << status.message;
}

INSTANTIATE_TEST_SUITE_P(Table, OneReport, testing::ValuesIn(kRows),
                         [](const auto& row) { return std::string{row.param.name}; });

}  // namespace
}  // namespace frontseat_driver::ros_layer::blueye_layer
