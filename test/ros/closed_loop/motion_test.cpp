#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>

#include "closed_loop.h"

// What is commanded ends as that motion in `odom`, with the right sign, besides yaw.

namespace frontseat_driver::closed_loop {
namespace {

using namespace std::chrono_literals;
using protocol::Dialect;

constexpr double kDegree = M_PI / 180.0;

Behavior behavior(std::uint8_t vertical_mode, double vertical, std::uint8_t speed_mode,
                  double speed) {
  Behavior message = heading(0.0);
  message.vertical_mode = vertical_mode;
  message.vertical = vertical;
  message.speed_mode = speed_mode;
  message.speed = speed;
  return message;
}

Behavior vertical(std::uint8_t mode, double value) {
  return behavior(mode, value, Behavior::SPEED_NONE, 0.0);
}

Behavior speed(std::uint8_t mode, double value) {
  return behavior(Behavior::VERTICAL_NONE, 0.0, mode, value);
}

Behavior rudder(double angle) {
  Behavior message;
  message.horizontal_mode = Behavior::HORIZONTAL_RUDDER;
  message.horizontal = angle;
  return message;
}

geometry_msgs::Twist twist(double forward, double turn) {
  geometry_msgs::Twist message;
  message.linear.x = forward;
  message.angular.z = turn;
  return message;
}

/// Positive with the bow down, as a rotation about the port axis is.
double pitchOf(const nav_msgs::Odometry& odometry) {
  const auto& q = odometry.pose.pose.orientation;
  return std::asin(std::clamp(2.0 * (q.w * q.y - q.z * q.x), -1.0, 1.0));
}

class Motion : public testing::Test {
 protected:
  void start(const ros_layer::Parameters& parameters, const sim::SandsharkConfig& vehicle) {
    loop_ = std::make_unique<ClosedLoop>(parameters, vehicle);
    begin();
  }
  void start(const ros_layer::Parameters& parameters, const sim::KingfisherConfig& vehicle) {
    loop_ = std::make_unique<ClosedLoop>(parameters, vehicle);
    begin();
  }
  void startSandshark() { start(parametersFor(Dialect::Sandshark), quietSandshark()); }
  void startKingfisher() { start(parametersFor(Dialect::Kingfisher), quietKingfisher()); }

  void command(const Wanted& wanted, Duration duration) {
    loop_->publishFor(wanted, 200ms, duration);
  }

  /// How far yaw grows in `duration`, less than half a turn, rad.
  double turn(const Wanted& wanted, Duration duration) {
    const double before = loop_->yaw();
    command(wanted, duration);
    return std::remainder(loop_->yaw() - before, 2.0 * M_PI);
  }

  double z() const { return loop_->odometry().pose.pose.position.z; }
  double forward() const { return loop_->odometry().twist.twist.linear.x; }
  double turnRate() const { return loop_->odometry().twist.twist.angular.z; }

  std::unique_ptr<ClosedLoop> loop_;

 private:
  void begin() {
    loop_->connect();
    ASSERT_TRUE(loop_->passUntil([&] { return loop_->reason().empty(); }, 5s)) << loop_->reason();
    loop_->pass(1s);
  }
};

// --- Sandshark ---

TEST_F(Motion, DepthEndsAsThatDepthBelowZero) {
  startSandshark();
  command(vertical(Behavior::VERTICAL_DEPTH, 5.0), 90s);
  EXPECT_NEAR(z(), -5.0, 0.1);
  command(vertical(Behavior::VERTICAL_DEPTH, 0.0), 60s);
  EXPECT_NEAR(z(), 0.0, 0.1);
}

TEST_F(Motion, AltitudeEndsAsThatHeightAboveTheBottom) {
  sim::SandsharkConfig vehicle = quietSandshark();
  vehicle.environment.bottom_depth_m = 30.0;
  start(parametersFor(Dialect::Sandshark), vehicle);
  command(vertical(Behavior::VERTICAL_ALTITUDE, 22.0), 90s);
  EXPECT_NEAR(z(), -8.0, 0.1);
}

TEST_F(Motion, PitchIsBowUp) {
  startSandshark();
  command(vertical(Behavior::VERTICAL_DEPTH, 10.0), 60s);
  command(vertical(Behavior::VERTICAL_PITCH, 10 * kDegree), 8s);
  EXPECT_NEAR(pitchOf(loop_->odometry()), -10 * kDegree, kDegree);
  EXPECT_GT(loop_->odometry().twist.twist.linear.x, 0.0);
  command(vertical(Behavior::VERTICAL_PITCH, -10 * kDegree), 8s);
  EXPECT_NEAR(pitchOf(loop_->odometry()), 10 * kDegree, kDegree);
}

TEST_F(Motion, ElevatorIsBowUp) {
  startSandshark();
  command(vertical(Behavior::VERTICAL_DEPTH, 10.0), 60s);
  command(vertical(Behavior::VERTICAL_ELEVATOR, 5 * kDegree), 4s);
  EXPECT_LT(pitchOf(loop_->odometry()), -3 * kDegree);
  command(vertical(Behavior::VERTICAL_ELEVATOR, -5 * kDegree), 4s);
  EXPECT_GT(pitchOf(loop_->odometry()), 3 * kDegree);
}

TEST_F(Motion, RudderIsToStarboard) {
  startSandshark();
  command(heading(0.0), 20s);
  EXPECT_LT(turn(rudder(10 * kDegree), 5s), -20 * kDegree);
  command(heading(0.0), 20s);
  EXPECT_GT(turn(rudder(-10 * kDegree), 5s), 20 * kDegree);
}

TEST_F(Motion, SpeedAndRpmEndAsThatSpeed) {
  startSandshark();
  command(speed(Behavior::SPEED_SPEED, 1.2), 30s);
  EXPECT_NEAR(forward(), 1.2, 0.02);
  command(speed(Behavior::SPEED_RPM, 400.0), 30s);
  EXPECT_NEAR(forward(), 400.0 * sim::Torpedo::kSpeedPerRpm, 0.02);
}

TEST_F(Motion, SpeedByTheTableEndsAsThatSpeed) {
  ros_layer::Parameters parameters = parametersFor(Dialect::Sandshark);
  parameters.session.format.speed_table = {{0.5, 0.5 / sim::Torpedo::kSpeedPerRpm},
                                           {2.0, 2.0 / sim::Torpedo::kSpeedPerRpm}};
  start(parameters, quietSandshark());
  for (const double wanted : {0.4, 1.2, 1.9}) {
    command(speed(Behavior::SPEED_SPEED, wanted), 30s);
    EXPECT_NEAR(forward(), wanted, 0.02);
    const auto sentence = fields(loop_->sent("BPRMB").back().sentence);
    EXPECT_NEAR(std::stod(sentence[5]), wanted / sim::Torpedo::kSpeedPerRpm, 0.001);
    EXPECT_EQ(sentence[6], "0") << "the mode of rpm";
  }
}

TEST_F(Motion, WhatIsLeftAloneIsTheMissions) {
  startSandshark();
  Behavior deeper;
  deeper.vertical_mode = Behavior::VERTICAL_DEPTH;
  deeper.vertical = 4.0;
  command(deeper, 60s);
  EXPECT_NEAR(z(), -4.0, 0.1);
  EXPECT_LT(apart(loop_->yaw(), M_PI_2), kDegree) << "the mission goes north";
  EXPECT_NEAR(forward(), 1.5, 0.02) << "at 1.5 m/s";
}

// --- Kingfisher ---

TEST_F(Motion, HelmTurnsCounterClockwise) {
  startKingfisher();
  EXPECT_NEAR(turn(helm(0.3, 0.3), 8s), 8 * 0.3, 0.4);
  EXPECT_NEAR(turnRate(), 0.3, 0.03);
  EXPECT_GT(forward(), 0.1);
  command(helm(0.3, 0.0), 5s);
  EXPECT_NEAR(turn(helm(0.3, -0.3), 8s), -8 * 0.3, 0.4);
  EXPECT_NEAR(turnRate(), -0.3, 0.03);
}

TEST_F(Motion, HelmInDegreesTurnsAsFast) {
  ros_layer::Parameters parameters = parametersFor(Dialect::Kingfisher);
  parameters.session.format.yaw_rate_in_degrees = true;
  sim::KingfisherConfig vehicle = quietKingfisher();
  vehicle.yaw_rate_in_degrees = true;
  start(parameters, vehicle);
  command(helm(0.3, 0.4), 8s);
  EXPECT_NEAR(turnRate(), 0.4, 0.04);
}

TEST_F(Motion, VelocityTurnsCounterClockwise) {
  startKingfisher();
  EXPECT_NEAR(turn(twist(0.6, 0.25), 8s), 8 * 0.25, 0.4);
  EXPECT_NEAR(turnRate(), 0.25, 0.03);
  command(twist(0.6, -0.25), 8s);
  EXPECT_NEAR(turnRate(), -0.25, 0.03);
}

TEST_F(Motion, ThrustIsForward) {
  startKingfisher();
  command(helm(0.5, 0.0), 10s);
  EXPECT_NEAR(forward(), 0.5 * sim::Catamaran::kMaxSpeed, 0.02);
  command(twist(-1.0, 0.0), 15s);  // half of max_speed astern
  EXPECT_NEAR(forward(), -0.5 * sim::Catamaran::kAstern * sim::Catamaran::kMaxSpeed, 0.02);
}

TEST_F(Motion, DriveTurnsAwayFromTheStrongerMotor) {
  startKingfisher();
  EXPECT_GT(turn(drive(0.1, 0.3), 5s), 20 * kDegree) << "the right motor pushes to port";
  command(drive(0.2, 0.2), 5s);
  EXPECT_LT(turn(drive(0.3, 0.1), 5s), -20 * kDegree);
  command(drive(0.4, 0.4), 15s);
  EXPECT_NEAR(turnRate(), 0.0, 0.005);
  EXPECT_NEAR(forward(), 0.4 * sim::Catamaran::kMaxSpeed, 0.02);
  command(drive(-0.5, -0.5), 15s);
  EXPECT_LT(forward(), -0.3);
}

TEST_F(Motion, CourseEndsAtThatSpeed) {
  startKingfisher();
  command(course(M_PI_2, 1.1), 20s);
  EXPECT_NEAR(forward(), 1.1, 0.02);
}

}  // namespace
}  // namespace frontseat_driver::closed_loop
