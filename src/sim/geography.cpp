#include "frontseat_driver/sim/geography.h"

#include <GeographicLib/LocalCartesian.hpp>
#include <GeographicLib/UTMUPS.hpp>

namespace frontseat_driver::sim {

nmea::LatLon fromPlane(const nmea::LatLon& datum, const PlanePoint& point) {
  const GeographicLib::LocalCartesian plane{datum.latitude_deg, datum.longitude_deg, 0.0};
  nmea::LatLon position;
  double up_m = 0.0;
  // The plane leaves the ellipsoid: go down until the height is zero. Each round gains many digits.
  for (int round = 0; round < 4; ++round) {
    double height_m = 0.0;
    plane.Reverse(point.east_m, point.north_m, up_m, position.latitude_deg, position.longitude_deg,
                  height_m);
    up_m -= height_m;
  }
  return position;
}

PlanePoint toPlane(const nmea::LatLon& datum, const nmea::LatLon& position) {
  const GeographicLib::LocalCartesian plane{datum.latitude_deg, datum.longitude_deg, 0.0};
  PlanePoint point;
  double up_m = 0.0;
  plane.Forward(position.latitude_deg, position.longitude_deg, 0.0, point.east_m, point.north_m,
                up_m);
  return point;
}

double gridConvergenceDeg(const nmea::LatLon& position) {
  int zone = 0;
  bool northern = true;
  double easting = 0.0;
  double northing = 0.0;
  double convergence_deg = 0.0;
  double scale = 1.0;
  GeographicLib::UTMUPS::Forward(position.latitude_deg, position.longitude_deg, zone, northern,
                                 easting, northing, convergence_deg, scale);
  return convergence_deg;
}

}  // namespace frontseat_driver::sim
