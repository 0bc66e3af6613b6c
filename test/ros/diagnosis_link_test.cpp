// What /diagnostics says of links that do not come about, over real sockets of this computer.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "diagnosis/diagnosis.h"
#include "diagnosis/health_monitor.h"
#include "test/link/interposed.h"
#include "test/link/loopback.h"

namespace frontseat_driver::ros_layer {
namespace {

using namespace std::chrono_literals;
using link::testing::ClientLog;
using link::testing::FullVehicle;
using link::testing::RawVehicle;
using link::testing::ReservedPort;
using link::testing::runUntil;
using testing::AllOf;
using testing::HasSubstr;
using Level = Diagnosis::Level;

/// A driver's link and its diagnosis, without a driver.
class Connecting {
 public:
  Connecting(const std::string& host, std::uint16_t port) {
    parameters_.link = link::testing::quickOptions(host, port);
    parameters_.link.connect_timeout = 300ms;
    parameters_.link.silence_timeout = 100ms;
    client_ = std::make_unique<link::TcpClient>(io_, parameters_.link, log);
  }

  Diagnoses diagnosed() {
    return diagnose(monitor_->take({}, builder_, std::chrono::nanoseconds::zero()));
  }

  Diagnoses begun() {
    monitor_ = std::make_unique<HealthMonitor>(parameters_, session_);
    client_->start();
    return diagnosed();
  }

  Diagnoses failed() {
    EXPECT_TRUE(runUntil(io_, [this] { return !log.failures.empty(); }));
    monitor_->connectFailed(log.failures.at(0));
    return diagnosed();
  }

  Diagnoses lost() {
    EXPECT_TRUE(runUntil(io_, [this] { return !log.losses.empty(); }));
    monitor_->connected({}, log.endpoints.at(0));
    monitor_->disconnected({}, log.losses.at(0));
    return diagnosed();
  }

  Diagnoses connectedAgain() {
    EXPECT_TRUE(runUntil(io_, [this] { return log.endpoints.size() == 2; }));
    monitor_->connected({}, log.endpoints.at(1));
    return diagnosed();
  }

  ClientLog log;

 private:
  boost::asio::io_context io_;
  Parameters parameters_;
  session::NmeaSession session_{parameters_.session};
  MessageBuilder builder_{parameters_};
  std::unique_ptr<HealthMonitor> monitor_;
  std::unique_ptr<link::TcpClient> client_;
};

/// Only the link complains, and says this.
template <class Matcher>
void expectRedLink(const Diagnoses& diagnoses, const Matcher& message) {
  EXPECT_EQ(Level::Error, diagnoses[0].level);
  EXPECT_THAT(diagnoses[0].message, message);
  for (std::size_t i = 1; i < diagnoses.size(); ++i) {
    EXPECT_EQ(Level::Ok, diagnoses[i].level) << kLayers[i].name << diagnoses[i].message;
    EXPECT_FALSE(diagnoses[i].known);
  }
}

void expectGreen(const Diagnoses& diagnoses) {
  for (const Diagnosis& diagnosis : diagnoses) EXPECT_EQ(Level::Ok, diagnosis.level);
  EXPECT_THAT(diagnoses[0].message, HasSubstr("connecting to "));
}

TEST(BrokenLink, WrongHost) {
  Connecting connecting{"absent.test", 29500};
  expectGreen(connecting.begun());
  expectRedLink(connecting.failed(), AllOf(HasSubstr("host name 'absent.test' not found"),
                                           HasSubstr("is parameter host spelt right?")));
}

TEST(BrokenLink, WrongPort) {
  const ReservedPort nobody;
  Connecting connecting{"127.0.0.1", nobody.port()};
  expectGreen(connecting.begun());
  expectRedLink(connecting.failed(),
                AllOf(HasSubstr("127.0.0.1:" + std::to_string(nobody.port())),
                      HasSubstr("connection refused"), HasSubstr("payload interface on"),
                      HasSubstr("parameter port right (29500")));
}

// A port whose queue is full drops what is sent to it, as such a firewall does.
TEST(BrokenLink, FirewallThatDrops) {
  const FullVehicle full;
  Connecting connecting{"127.0.0.1", full.port()};
  expectGreen(connecting.begun());
  expectRedLink(connecting.failed(),
                AllOf(HasSubstr("no answer from host 127.0.0.1 within 0.3 s"),
                      HasSubstr("a firewall drops"), HasSubstr("nc -v HOST PORT")));
}

TEST(BrokenLink, VehicleThatSaysNothing) {
  const RawVehicle silent;
  Connecting connecting{"127.0.0.1", silent.port()};
  connecting.begun();
  expectRedLink(connecting.lost(),
                AllOf(HasSubstr("no byte for 0.1 s"), HasSubstr("is another one connected?")));
  const Diagnosis again = connecting.connectedAgain()[0];
  EXPECT_EQ(Level::Error, again.level);
  EXPECT_THAT(again.message,
              AllOf(HasSubstr("again, nothing heard yet; before: no byte for 0.1 s; the vehicle"),
                    HasSubstr("is another one connected?")));
}

}  // namespace
}  // namespace frontseat_driver::ros_layer
