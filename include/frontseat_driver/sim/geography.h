#pragma once

#include "frontseat_driver/nmea/values.h"

namespace frontseat_driver::sim {

/// East and north of the datum in its tangent plane, metres.
struct PlanePoint {
  double east_m = 0.0;
  double north_m = 0.0;
};

/// The point of the WGS-84 ellipsoid (height 0) whose tangent-plane coordinates at `datum` are
/// `point`. The way back of toPlane().
nmea::LatLon fromPlane(const nmea::LatLon& datum, const PlanePoint& point);

/// x and y, in the ENU tangent plane at `datum`, of a point at ellipsoid height 0.
PlanePoint toPlane(const nmea::LatLon& datum, const nmea::LatLon& position);

/// Meridian convergence of the UTM (beyond 84 N and 80 S: UPS) grid, degrees: the bearing of grid
/// north, clockwise from true north. True heading = grid heading + convergence.
double gridConvergenceDeg(const nmea::LatLon& position);

}  // namespace frontseat_driver::sim
