// Who is in control, and what becomes of the drone when they leave.
#include <gtest/gtest.h>

#include "deck.h"

namespace frontseat_driver::sim {
namespace {

std::uint32_t inControl(const Deck& deck) {
  return deck.latest<bp::ConnectedClientsTel>().client_id_in_control();
}

bp::DisconnectClientRep disconnect(Deck& deck, std::uint32_t client) {
  bp::DisconnectClientReq request;
  request.set_client_id(client);
  return deck.ask<bp::DisconnectClientRep>(request).value_or(bp::DisconnectClientRep{});
}

TEST(Clients, TheFirstThatIsNoObserverGetsControl) {
  Deck deck;
  const auto observer = deck.connect(true);
  EXPECT_EQ(observer, 1U);
  deck.run(0.1);
  EXPECT_EQ(inControl(deck), 0U);
  const auto first = deck.connect();
  deck.run(0.1);
  EXPECT_EQ(inControl(deck), first);
  bp::ConnectClientReq request;
  request.mutable_client_info()->set_name("late");
  const auto late = deck.ask<bp::ConnectClientRep>(request);
  ASSERT_TRUE(late);
  EXPECT_EQ(late->client_id(), 3U);
  EXPECT_EQ(late->client_id_in_control(), first);
  ASSERT_EQ(late->connected_clients_size(), 3);
  EXPECT_TRUE(late->connected_clients(0).client_info().is_observer());
  EXPECT_EQ(late->connected_clients(2).client_info().name(), "late");
}

TEST(Clients, ControlGoesToTheNextThatIsNoObserver) {
  Deck deck;
  const auto first = deck.connect();
  deck.connect(true);
  bp::ConnectClientReq request;
  const auto next = deck.ask<bp::ConnectClientRep>(request)->client_id();
  const auto reply = disconnect(deck, first);
  EXPECT_EQ(reply.client_id_in_control(), next);
  EXPECT_EQ(reply.connected_clients_size(), 2);
  deck.run(0.05);
  EXPECT_EQ(inControl(deck), next);  // told at once, not at the next second
  EXPECT_EQ(disconnect(deck, next).client_id_in_control(), 0U);
  EXPECT_EQ(disconnect(deck, 77).client_id_in_control(), 0U);
}

TEST(Clients, NobodyMovesItWithoutAWatchdog) {
  Deck deck;
  deck.connect();
  deck.pets = 0;
  deck.push(1, 0, 0, 0);
  deck.run(2.0);
  EXPECT_EQ(deck.state().surge_m_s, 0.0);
}

TEST(Clients, AWatchdogOfAnObserverOrOfNobodyKnownDoesNotArm) {
  Deck deck;
  deck.connect();
  deck.pets = deck.connect(true);
  deck.push(1, 0, 0, 0);
  deck.run(2.0);
  EXPECT_EQ(deck.state().surge_m_s, 0.0);
  deck.pets = 99;
  deck.run(0.5);
  EXPECT_EQ(deck.state().surge_m_s, 0.0);
}

TEST(Clients, AWatchdogWithoutNumberArmsAsOldClientsWantIt) {
  Deck deck;
  bp::WatchdogCtrl watchdog;
  watchdog.mutable_connection_duration()->set_value(1);
  deck.tell(watchdog);
  deck.push(1, 0, 0, 0);
  deck.run(2.0);
  EXPECT_GT(deck.state().surge_m_s, 0.3);
  deck.run(30.0);
  EXPECT_NEAR(deck.state().surge_m_s, 0.0, 0.01);
}

TEST(Watchdog, LossEndsThrustLightsAndAutomaticFunctionsInTime) {
  Deck deck;
  deck.connect();
  deck.push(1, 0, 0, 0);
  bp::LightsCtrl lights;
  lights.mutable_lights()->set_value(0.8F);
  deck.tell(lights);
  bp::AutoDepthCtrl auto_depth;
  auto_depth.mutable_state()->set_enabled(true);
  deck.tell(auto_depth);
  bp::TiltVelocityCtrl tilt;
  tilt.mutable_velocity()->set_value(1.0F);
  deck.tell(tilt);
  deck.run(5.0);
  ASSERT_NEAR(deck.latest<bp::LightsTel>().lights().value(), 0.8, 1e-6);
  deck.pets = 0;
  deck.run(2.0);
  EXPECT_GT(deck.drone.model().commanded().surge, 0.5);  // not lost yet: the stick stays
  deck.run(1.6);
  EXPECT_EQ(deck.drone.model().commanded().surge, 0.0);
  EXPECT_EQ(inControl(deck), 0U);
  EXPECT_EQ(deck.latest<bp::LightsTel>().lights().value(), 0.0F);
  EXPECT_FALSE(deck.latest<bp::ControlModeTel>().state().auto_depth());
  EXPECT_EQ(deck.latest<bp::ReferenceTel>().reference().surge(), 0.0F);
}

TEST(Watchdog, LossHandsOverAndNothingOldMovesAgain) {
  Deck deck;
  const auto lost = deck.connect();
  bp::ConnectClientReq request;
  const auto next = deck.ask<bp::ConnectClientRep>(request)->client_id();
  deck.push(1, 0, 0, 0);
  deck.run(2.0);
  ASSERT_EQ(inControl(deck), lost);
  deck.pets = next;  // the other one dies
  deck.run(4.0);
  EXPECT_EQ(inControl(deck), next);
  EXPECT_EQ(deck.drone.model().commanded().surge, 0.0);
  deck.run(10.0);
  EXPECT_NEAR(deck.state().surge_m_s, 0.0, 0.05);
  deck.push(0, 1, 0, 0);
  deck.run(2.0);
  EXPECT_GT(deck.state().sway_m_s, 0.1);
}

TEST(Watchdog, ThoseThatWaitAreWatchedFromTheirPromotionOn) {
  Deck deck;
  const auto first = deck.connect();
  bp::ConnectClientReq request;
  const auto dead = deck.ask<bp::ConnectClientRep>(request)->client_id();
  deck.run(30.0);
  disconnect(deck, first);
  deck.pets = 0;
  deck.run(2.5);
  EXPECT_EQ(inControl(deck), dead);
  deck.run(1.0);
  EXPECT_EQ(inControl(deck), 0U);
}

TEST(Clients, TakingControlDisconnectsWhoeverHasIt) {
  Deck deck;
  deck.connect();
  bp::ConnectClientReq request;
  deck.ask<bp::ConnectClientRep>(request);
  const auto own = deck.ask<bp::ConnectClientRep>(request)->client_id();
  std::uint32_t control = 0;
  int rounds = 0;
  for (control = 1; control != own && rounds < 5; ++rounds) {
    control = disconnect(deck, control).client_id_in_control();
  }
  EXPECT_EQ(control, own);
  EXPECT_EQ(rounds, 2);
}

TEST(Clients, AreBoundedInNumber) {
  Deck deck;
  const auto first = deck.connect();
  for (int i = 0; i < 1000; ++i) {
    deck.connect(true);
    deck.run(0.01);
  }
  deck.run(1.0);
  const auto clients = deck.latest<bp::ConnectedClientsTel>();
  EXPECT_LE(clients.connected_clients_size(), 64);
  EXPECT_EQ(clients.client_id_in_control(), first);
}

}  // namespace
}  // namespace frontseat_driver::sim
