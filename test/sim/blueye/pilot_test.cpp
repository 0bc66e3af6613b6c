// The automatic functions: what holds, what the stick then means, and when they end.
#include "pilot.h"

#include <gtest/gtest.h>

#include <cmath>

#include "deck.h"
#include "frontseat_driver/sim/angles.h"

namespace frontseat_driver::sim {
namespace {

template <class Message>
void enable(Deck& deck, bool on = true) {
  Message message;
  message.mutable_state()->set_enabled(on);
  deck.tell(message);
}

bp::ControlMode modes(Deck& deck) {
  deck.run(0.6);
  return deck.latest<bp::ControlModeTel>().state();
}

void diveTo(Deck& deck, double depth_m) {
  deck.push(0, 0, 1, 0);
  ASSERT_TRUE(deck.runUntil([&] { return deck.state().depth_m > depth_m; }, 60.0));
  deck.push(0, 0, 0, 0);
}

TEST(AutoDepth, HoldsAgainstBuoyancyAndHeaveBecomesASpeed) {
  BlueyeConfig config = quietDrone();
  config.buoyancy_n = 1.0;
  Deck deck{config};
  deck.connect();
  diveTo(deck, 3.0);
  enable<bp::AutoDepthCtrl>(deck);
  deck.run(20.0);
  const double held = deck.state().depth_m;
  deck.run(60.0);
  EXPECT_NEAR(deck.state().depth_m, held, 0.05);
  EXPECT_TRUE(modes(deck).auto_depth());
  deck.push(0, 0, 0.5F, 0);
  deck.run(10.0);
  // Half a stick, of a gain of 0.7, of half a metre per second.
  EXPECT_NEAR(deck.state().velocity_down_m_s, 0.5 * 0.7 * 0.5, 0.02);
  deck.push(0, 0, 0, 0);
  deck.run(20.0);
  EXPECT_NEAR(deck.state().velocity_down_m_s, 0.0, 0.005);
  EXPECT_NEAR(deck.latest<bp::ReferenceTel>().reference().depth(), deck.state().depth_m, 0.02);
  EXPECT_NEAR(deck.latest<bp::ControllerHealthTel>().controller_health().depth_error(), 0.0, 0.02);
  enable<bp::AutoDepthCtrl>(deck, false);
  EXPECT_FALSE(modes(deck).auto_depth());
  const double before = deck.state().depth_m;
  deck.run(60.0);
  EXPECT_LT(deck.state().depth_m, before - 0.5);  // nothing holds it now
}

TEST(AutoHeading, HoldsAndYawBecomesARate) {
  BlueyeConfig config = quietDrone();
  config.start.heading_deg = 350.0;
  Deck deck{config};
  deck.connect();
  enable<bp::AutoHeadingCtrl>(deck);
  deck.push(0, 0, 0, 0.5F);
  deck.run(5.0);
  EXPECT_NEAR(deck.drone.model().yawRate(), 0.5 * 0.7 * 0.8, 0.02);
  deck.push(0, 0, 0, 0);
  deck.run(10.0);
  const double held = deck.state().heading_rad;
  EXPECT_NEAR(degrees(wrapPi(held)), -10.0 + degrees(5.0 * 0.28), 4.0);
  deck.run(60.0);
  EXPECT_NEAR(wrapPi(deck.state().heading_rad - held), 0.0, 1e-3);
}

TEST(AutoAltitude, HoldsTheHeightAndTakesTheDepthOff) {
  Deck deck;
  deck.connect();
  diveTo(deck, 5.0);
  enable<bp::AutoDepthCtrl>(deck);
  enable<bp::AutoAltitudeCtrl>(deck);
  EXPECT_TRUE(modes(deck).auto_altitude());
  EXPECT_FALSE(modes(deck).auto_depth());
  deck.push(0, 0, 0.5F, 0);  // down
  deck.run(10.0);
  deck.push(0, 0, 0, 0);
  deck.run(20.0);
  const double height = deck.state().altitude_m;
  EXPECT_LT(height, 14.0);
  EXPECT_NEAR(deck.latest<bp::AltitudeTel>().altitude().value(), height, 0.01);
  deck.run(30.0);
  EXPECT_NEAR(deck.state().altitude_m, height, 0.05);
}

TEST(AutoAltitude, IsIgnoredWithoutAnAltitude) {
  BlueyeConfig config = quietDrone();
  config.devices = {};
  Deck deck{config};
  deck.connect();
  enable<bp::AutoAltitudeCtrl>(deck);
  enable<bp::WeatherVaningCtrl>(deck);
  EXPECT_FALSE(modes(deck).auto_altitude());
  EXPECT_FALSE(modes(deck).weather_vaning());
  EXPECT_EQ(deck.drone.counts().refused, 2U);
}

TEST(AutoAltitude, BecomesAutoDepthWhereTheBottomIsLost) {
  Deck deck;
  deck.connect();
  diveTo(deck, 5.0);
  enable<bp::AutoAltitudeCtrl>(deck);
  deck.run(5.0);
  deck.tell(bp::DeactivateGuestPortsCtrl{});
  EXPECT_FALSE(modes(deck).auto_altitude());
  EXPECT_TRUE(modes(deck).auto_depth());
  const double held = deck.state().depth_m;
  deck.run(30.0);
  EXPECT_NEAR(deck.state().depth_m, held, 0.1);
}

TEST(StationKeeping, HoldsThePlaceInACurrentAndTheStickMovesIt) {
  BlueyeConfig config = quietDrone();
  config.environment.current_drift_m_s = 0.3;
  config.environment.current_set_deg = 90.0;
  Deck deck{config};
  deck.connect();
  enable<bp::StationKeepingCtrl>(deck);
  enable<bp::AutoHeadingCtrl>(deck);
  deck.run(60.0);
  EXPECT_NEAR(deck.state().velocity_east_m_s, 0.0, 0.01);
  EXPECT_NEAR(deck.state().east_m, 0.0, 0.8);
  const double north = deck.state().north_m;
  deck.push(1, 0, 0, 0);
  deck.run(10.0);
  deck.push(0, 0, 0, 0);
  deck.run(30.0);
  EXPECT_NEAR(deck.state().north_m, north + 10.0 * 0.4 * 0.7, 0.3);
}

TEST(WeatherVaning, PutsTheBowIntoTheCurrent) {
  BlueyeConfig config = quietDrone();
  config.environment.current_drift_m_s = 0.3;
  config.environment.current_set_deg = 90.0;  // it comes from the west
  Deck deck{config};
  deck.connect();
  enable<bp::WeatherVaningCtrl>(deck);
  deck.run(60.0);
  EXPECT_NEAR(degrees(deck.state().heading_rad), 270.0, 1.0);
  EXPECT_NEAR(deck.state().velocity_east_m_s, 0.0, 0.01);
}

}  // namespace
}  // namespace frontseat_driver::sim
