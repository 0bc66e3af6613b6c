#include "frontseat_driver/sim/vehicle_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "frontseat_driver/sim/angles.h"
#include "frontseat_driver/sim/autopilot.h"
#include "frontseat_driver/sim/catamaran.h"
#include "frontseat_driver/sim/torpedo.h"

namespace frontseat_driver::sim {
namespace {

constexpr double kStep_s = 0.01;

void run(VehicleModel& model, double s) {
  for (int i = 0; i < std::lround(s / kStep_s); ++i) model.step(kStep_s);
}

Torpedo torpedo(const Environment& water = {}) { return {water, Start{}, BatteryType{}}; }
Catamaran catamaran(double waves_deg = 0.0) {
  return {Environment{}, Start{}, BatteryType{}, waves_deg};
}

TEST(TorpedoModel, GathersWayWithTheLagsOfThrusterAndHull) {
  Torpedo vehicle = torpedo();
  vehicle.command({0.0, 0.0, 1000.0});
  run(vehicle, 2.0);
  // Two lags in a row, 2.0 and 0.3 s: 1 - (2 exp(-1) - 0.3 exp(-2 / 0.3)) / 1.7 of 2 m/s.
  EXPECT_NEAR(vehicle.state().surge_m_s, 1.135, 0.01);
  run(vehicle, 30.0);
  EXPECT_NEAR(vehicle.state().surge_m_s, 2.0, 1e-3);
}

TEST(TorpedoModel, CoastsWhenTheThrusterStops) {
  Torpedo vehicle = torpedo();
  vehicle.command({0.0, 0.0, 1000.0});
  run(vehicle, 30.0);
  vehicle.command({});
  run(vehicle, 1.0);
  EXPECT_GT(vehicle.state().surge_m_s, 1.2);
  run(vehicle, 30.0);
  EXPECT_NEAR(vehicle.state().surge_m_s, 0.0, 1e-3);
}

struct Speed {
  const char* name;
  double rpm;
};
class TurningCircle : public testing::TestWithParam<Speed> {};

TEST_P(TurningCircle, IsEightMetresWideToStarboard) {
  Torpedo vehicle = torpedo();
  vehicle.command({Torpedo::kMaxFin_rad, 0.0, GetParam().rpm});
  run(vehicle, 30.0);
  double low = vehicle.state().east_m;
  double high = low;
  EXPECT_GT(vehicle.state().yaw_rate_rad_s, 0.0);
  for (int i = 0; i < 6000; ++i) {
    vehicle.step(kStep_s);
    low = std::min(low, vehicle.state().east_m);
    high = std::max(high, vehicle.state().east_m);
  }
  EXPECT_NEAR(high - low, 8.0, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Table, TurningCircle,
                         testing::Values(Speed{"slow", 500.0}, Speed{"fast", 1000.0}),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(TorpedoModel, DivesAMetreWithinAMinuteAndStaysThere) {
  Torpedo vehicle = torpedo();
  Setpoint setpoint;
  setpoint.vertical_mode = Setpoint::VerticalMode::Depth;
  setpoint.vertical = 1.0;
  setpoint.speed_mode = Setpoint::SpeedMode::Speed;
  setpoint.speed = 1.5;
  for (double t = 0.0; t < 60.0; t += kStep_s) {
    vehicle.command(steer(setpoint, vehicle.state(), SafeLimits{}));
    vehicle.step(kStep_s);
  }
  for (double t = 0.0; t < 60.0; t += kStep_s) {
    vehicle.command(steer(setpoint, vehicle.state(), SafeLimits{}));
    vehicle.step(kStep_s);
    ASSERT_NEAR(vehicle.state().depth_m, 1.0, 0.05);
  }
  EXPECT_NEAR(vehicle.state().altitude_m, 19.0, 0.05);
}

TEST(TorpedoModel, NeverGoesOverWhateverItsElevator) {
  for (const double elevator : {Torpedo::kMaxFin_rad, -Torpedo::kMaxFin_rad}) {
    Torpedo vehicle = torpedo();
    vehicle.command({0.0, elevator, Torpedo::kMaxRpm});
    for (double t = 0.0; t < 120.0; t += kStep_s) {
      vehicle.step(kStep_s);
      ASSERT_LT(std::abs(vehicle.state().pitch_rad), 1.5);
    }
    EXPECT_GT(std::abs(vehicle.state().pitch_rad), 0.5);
  }
}

TEST(TorpedoModel, RisesByItselfAndStopsAtTheSurface) {
  Torpedo vehicle = torpedo();
  vehicle.command({0.0, -Torpedo::kMaxFin_rad, 1000.0});
  run(vehicle, 20.0);
  const double depth_m = vehicle.state().depth_m;
  ASSERT_GT(depth_m, 5.0);
  vehicle.command({});
  run(vehicle, 30.0);
  const double later_m = vehicle.state().depth_m;
  run(vehicle, 10.0);
  EXPECT_NEAR(later_m - vehicle.state().depth_m, 10.0 * Torpedo::kRise, 0.01);
  run(vehicle, 600.0);
  EXPECT_NEAR(vehicle.state().depth_m, 0.0, 1e-6);
  EXPECT_NEAR(vehicle.state().velocity_down_m_s, 0.0, 1e-6);
}

TEST(TorpedoModel, NeverGoesThroughTheBottom) {
  Environment water;
  water.bottom_depth_m = 3.0;
  Torpedo vehicle = torpedo(water);
  vehicle.command({0.0, -Torpedo::kMaxFin_rad, 1000.0});
  run(vehicle, 60.0);
  EXPECT_LE(vehicle.state().depth_m, 3.0);
  EXPECT_GE(vehicle.state().altitude_m, 0.0);
}

TEST(TorpedoModel, ABowUpPitchLiftsIt) {
  Torpedo vehicle = torpedo();
  vehicle.command({0.0, -0.2, 1000.0});
  run(vehicle, 20.0);
  EXPECT_LT(vehicle.state().pitch_rad, -0.1);
  EXPECT_GT(vehicle.state().velocity_down_m_s, 0.2);
}

TEST(CatamaranModel, ReachesItsSpeedAndGoesAsternSlower) {
  Catamaran vehicle = catamaran();
  vehicle.command({1.0, 1.0});
  run(vehicle, 30.0);
  EXPECT_NEAR(vehicle.state().surge_m_s, 1.7, 1e-3);
  vehicle.command({-1.0, -1.0});
  run(vehicle, 30.0);
  EXPECT_NEAR(vehicle.state().surge_m_s, -1.7 * 0.6, 1e-3);
}

TEST(CatamaranModel, MorePortThrustTurnsClockwise) {
  Catamaran vehicle = catamaran();
  vehicle.command({0.5, 0.1});
  run(vehicle, 10.0);
  EXPECT_NEAR(vehicle.state().yaw_rate_rad_s, 1.2 * 0.4 / 2.0, 1e-3);
}

TEST(CatamaranModel, StaysAtTheSurfaceWhenItPitches) {
  Catamaran vehicle = catamaran(5.0);
  vehicle.command({1.0, 1.0});
  for (int i = 0; i < 3000; ++i) {
    vehicle.step(kStep_s);
    ASSERT_EQ(vehicle.state().depth_m, 0.0);
    ASSERT_EQ(vehicle.state().velocity_down_m_s, 0.0);
  }
}

TEST(CatamaranModel, TurnsOnTheSpot) {
  Catamaran vehicle = catamaran();
  vehicle.command({0.6, -1.0});  // equal effects
  run(vehicle, 60.0);
  EXPECT_GT(vehicle.state().yaw_rate_rad_s, 0.5);
  EXPECT_LT(std::hypot(vehicle.state().east_m, vehicle.state().north_m), 0.2);
}

TEST(Water, CarriesAVehicleThatDoesNothing) {
  Environment water;
  water.current_set_deg = 90.0;
  water.current_drift_m_s = 0.3;
  Torpedo vehicle = torpedo(water);
  run(vehicle, 100.0);
  EXPECT_NEAR(vehicle.state().east_m, 30.0, 1e-6);
  EXPECT_NEAR(vehicle.state().north_m, 0.0, 1e-6);
  EXPECT_NEAR(vehicle.state().velocity_east_m_s, 0.3, 1e-9);
}

TEST(BatteryModel, LosesWhatIsDrawn) {
  Torpedo vehicle = torpedo();
  const double full_wh = vehicle.state().energy_wh;
  const double full_v = vehicle.state().stack_v;
  run(vehicle, 360.0);
  EXPECT_NEAR(full_wh - vehicle.state().energy_wh, 1.5, 1e-6);  // 15 W for a tenth of an hour
  vehicle.command({0.0, 0.0, 1000.0});
  run(vehicle, 10.0);
  const double before_wh = vehicle.state().energy_wh;
  run(vehicle, 360.0);
  EXPECT_NEAR(before_wh - vehicle.state().energy_wh, 16.5, 1e-3);  // 15 W + 150 W
  EXPECT_LT(vehicle.state().stack_v, full_v - 0.1);
}

TEST(BatteryModel, AnEmptyOneDrivesNothing) {
  BatteryType small;
  small.capacity_wh = 0.1;
  Catamaran vehicle{Environment{}, Start{}, small, 0.0};
  vehicle.command({1.0, 1.0});
  run(vehicle, 60.0);
  EXPECT_DOUBLE_EQ(vehicle.state().energy_wh, 0.0);
  EXPECT_NEAR(vehicle.state().surge_m_s, 0.0, 1e-6);
  vehicle.replaceBattery();
  run(vehicle, 0.5);
  EXPECT_GT(vehicle.state().surge_m_s, 0.1);
}

TEST(Rest, FeelsOnlyGravity) {
  Catamaran vehicle = catamaran();
  vehicle.step(kStep_s);
  EXPECT_NEAR(vehicle.state().force_x_m_s2, 0.0, 1e-12);
  EXPECT_NEAR(vehicle.state().force_y_m_s2, 0.0, 1e-12);
  EXPECT_NEAR(vehicle.state().force_z_m_s2, -9.80665, 1e-12);
}

// The next tests take the state apart by rotation matrices, which the model itself does not use.
using Matrix = std::array<std::array<double, 3>, 3>;

Matrix times(const Matrix& a, const Matrix& b) {
  Matrix product{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) product[i][j] += a[i][k] * b[k][j];
    }
  }
  return product;
}

Matrix transposed(const Matrix& m) {
  return {{{m[0][0], m[1][0], m[2][0]}, {m[0][1], m[1][1], m[2][1]}, {m[0][2], m[1][2], m[2][2]}}};
}

/// Body to NED: heading about z, then pitch about y, then roll about x.
Matrix attitude(const VehicleState& s) {
  const double cz = std::cos(s.heading_rad), sz = std::sin(s.heading_rad);
  const double cy = std::cos(s.pitch_rad), sy = std::sin(s.pitch_rad);
  const double cx = std::cos(s.roll_rad), sx = std::sin(s.roll_rad);
  const Matrix z{{{cz, -sz, 0.0}, {sz, cz, 0.0}, {0.0, 0.0, 1.0}}};
  const Matrix y{{{cy, 0.0, sy}, {0.0, 1.0, 0.0}, {-sy, 0.0, cy}}};
  const Matrix x{{{1.0, 0.0, 0.0}, {0.0, cx, -sx}, {0.0, sx, cx}}};
  return times(times(z, y), x);
}

struct Course {
  const char* name;
  std::function<std::unique_ptr<VehicleModel>()> make;
  std::function<void(VehicleModel&, double)> drive;  ///< at a time
};

void driveTorpedo(VehicleModel& model, double t) {
  dynamic_cast<Torpedo&>(model).command(
      {0.3 * std::sin(0.4 * t), 0.25 * std::sin(0.23 * t) - 0.1, 900.0 + 200.0 * std::sin(t)});
}

void driveCatamaran(VehicleModel& model, double t) {
  dynamic_cast<Catamaran&>(model).command({0.7 + 0.3 * std::sin(t), 0.6 * std::cos(0.7 * t)});
}

class Consistent : public testing::TestWithParam<Course> {
 protected:
  void SetUp() override {
    model_ = GetParam().make();
    for (int i = 0; i < 4000; ++i) advance();
  }

  VehicleState advance() {
    GetParam().drive(*model_, time_s_ += kStep_s);
    model_->step(kStep_s);
    return model_->state();
  }

  std::unique_ptr<VehicleModel> model_;
  double time_s_ = 0.0;
};

TEST_P(Consistent, VelocityIsTheDerivativeOfThePosition) {
  for (int i = 0; i < 300; ++i) {
    const VehicleState before = advance();
    const VehicleState at = advance();
    const VehicleState after = advance();
    ASSERT_NEAR(at.velocity_east_m_s, (after.east_m - before.east_m) / (2 * kStep_s), 2e-3);
    ASSERT_NEAR(at.velocity_north_m_s, (after.north_m - before.north_m) / (2 * kStep_s), 2e-3);
    ASSERT_NEAR(at.velocity_down_m_s, (after.depth_m - before.depth_m) / (2 * kStep_s), 2e-3);
  }
}

TEST_P(Consistent, RatesAreBodyRatesOfTheAttitude) {
  for (int i = 0; i < 300; ++i) {
    const Matrix before = attitude(advance());
    const VehicleState at = advance();
    const Matrix after = attitude(advance());
    const Matrix here = transposed(attitude(at));
    // R' dR/dt is the cross product matrix of the body rates.
    const Matrix from = times(here, before);
    const Matrix to = times(here, after);
    const auto rate = [&](std::size_t row, std::size_t column) {
      return (to[row][column] - from[row][column]) / (2 * kStep_s);
    };
    ASSERT_NEAR(at.roll_rate_rad_s, rate(2, 1), 5e-3);
    ASSERT_NEAR(at.pitch_rate_rad_s, rate(0, 2), 5e-3);
    ASSERT_NEAR(at.yaw_rate_rad_s, rate(1, 0), 5e-3);
  }
}

TEST_P(Consistent, SpecificForceIsAccelerationLessGravityInBodyAxes) {
  for (int i = 0; i < 300; ++i) {
    const VehicleState before = advance();
    const VehicleState at = advance();
    const std::array<double, 3> ned{
        (at.velocity_north_m_s - before.velocity_north_m_s) / kStep_s,
        (at.velocity_east_m_s - before.velocity_east_m_s) / kStep_s,
        (at.velocity_down_m_s - before.velocity_down_m_s) / kStep_s - 9.80665};
    const Matrix to_body = transposed(attitude(at));
    const std::array<double, 3> force{at.force_x_m_s2, at.force_y_m_s2, at.force_z_m_s2};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& row = to_body[axis];
      ASSERT_NEAR(force[axis], row[0] * ned[0] + row[1] * ned[1] + row[2] * ned[2], 1e-9);
    }
  }
}

TEST_P(Consistent, TheSameCommandsGiveTheSameMotion) {
  const auto other = GetParam().make();
  double time_s = 0.0;
  for (int i = 0; i < 4000; ++i) {
    GetParam().drive(*other, time_s += kStep_s);
    other->step(kStep_s);
  }
  EXPECT_EQ(other->state().east_m, model_->state().east_m);
  EXPECT_EQ(other->state().roll_rad, model_->state().roll_rad);
}

TEST_P(Consistent, TheWholeStateMoves) {
  const VehicleState& state = model_->state();
  EXPECT_GT(std::abs(state.roll_rad), 1e-4);
  EXPECT_GT(std::abs(state.pitch_rad), 1e-4);
  EXPECT_GT(std::abs(state.yaw_rate_rad_s), 1e-4);
}

INSTANTIATE_TEST_SUITE_P(
    Table, Consistent,
    testing::Values(
        Course{"torpedo", [] { return std::make_unique<Torpedo>(torpedo()); }, driveTorpedo},
        Course{"catamaran_in_waves", [] { return std::make_unique<Catamaran>(catamaran(3.0)); },
               driveCatamaran}),
    [](const auto& row) { return std::string{row.param.name}; });

struct Wanted {
  const char* name;
  double heading_deg;
};
class Autopilot : public testing::TestWithParam<Wanted> {};

TEST_P(Autopilot, BringsATorpedoToAHeading) {
  Torpedo vehicle = torpedo();
  Setpoint setpoint;
  setpoint.horizontal_mode = Setpoint::HorizontalMode::Heading;
  setpoint.horizontal_deg = GetParam().heading_deg;
  setpoint.speed = 700.0;
  for (double t = 0.0; t < 60.0; t += kStep_s) {
    vehicle.command(steer(setpoint, vehicle.state(), SafeLimits{}));
    vehicle.step(kStep_s);
  }
  EXPECT_NEAR(wrapPi(vehicle.state().heading_rad - radians(GetParam().heading_deg)), 0.0, 1e-3);
}

TEST_P(Autopilot, BringsACatamaranToAHeadingAndASpeed) {
  Catamaran vehicle = catamaran();
  for (double t = 0.0; t < 60.0; t += kStep_s) {
    vehicle.command(hold(GetParam().heading_deg, 1.0, vehicle.state()));
    vehicle.step(kStep_s);
  }
  EXPECT_NEAR(wrapPi(vehicle.state().heading_rad - radians(GetParam().heading_deg)), 0.0, 1e-3);
  EXPECT_NEAR(vehicle.state().surge_m_s, 1.0, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Table, Autopilot,
                         testing::Values(Wanted{"north_east", 45.0}, Wanted{"south_east", 135.0},
                                         Wanted{"south_west", 225.0}, Wanted{"north_west", 315.0},
                                         Wanted{"back", 180.0}),
                         [](const auto& row) { return std::string{row.param.name}; });

}  // namespace
}  // namespace frontseat_driver::sim
