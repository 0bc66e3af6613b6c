#pragma once

#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "aqua_troll.h"
#include "clients.h"
#include "frontseat_driver/sim/blueye/config.h"
#include "frontseat_driver/sim/blueye/drone.h"
#include "frontseat_driver/sim/random.h"
#include "messages.h"
#include "mission.h"
#include "multibeam.h"
#include "navigation.h"
#include "payload.h"
#include "pilot.h"

namespace frontseat_driver::sim {

/// What clients set and read back, nothing more.
struct BlueyeSettings {
  std::map<int, bp::CameraParameters> cameras;
  bp::OverlayParameters overlay;
  bp::PersistentStorageSettings storage;
  bp::PingerConfiguration pinger;
  bp::MagneticDeclination declination;
  bp::FilterMessage turbidity;
  bp::FilterMessage color;
  bp::CameraPanTiltZoom pan_tilt_zoom;
  bp::SotState tracking;
  std::optional<bp::LatLongPosition> pilot_position;
  std::uint32_t sound_velocity_m_s = 5920;
  double water_density_g_l = 1025.0;
  bool iperf = false;
  bool log_streaming = false;

  BlueyeSettings();
};

/// The drone's computer: all that a reboot forgets.
struct BlueyeComputer {
  explicit BlueyeComputer(const BlueyeConfig& config, const Rov& rov, Random random, UtcTime now);

  UtcTime booted;
  UtcTime clock_offset;  ///< the drone's clock less UTC
  BlueyeClients clients;
  BlueyePilot pilot;
  BlueyeNavigation navigation;
  BlueyeMission mission;
  BlueyePayload payload;
  BlueyeSettings settings;
  BlueyeMultibeam multibeam;
  BlueyeAquaTroll aqua_troll;
  double dive_s = 0.0;
  UtcTime guest_ports_on_again{0};  ///< off before
  bool guest_ports_off = false;     ///< by command
  bool gnss_seen = false;
  std::map<std::string, double> rates;         ///< Hz by telemetry name
  std::map<std::string, UtcTime> due;          ///< and when it is sent next
  std::set<std::string> events;                ///< telemetry to be sent at once
  std::deque<bp::Notification> notifications;  ///< to be sent
  std::optional<bp::Notification> last_notification;
  std::optional<bp::Annotation> last_annotation;
};

/// A drone: what is in the water, and the computer in it.
class BlueyeCore {
 public:
  explicit BlueyeCore(const BlueyeConfig& config);

  const BlueyeConfig config;
  UtcTime now;
  Rov rov;
  Random random;
  BlueyeComputer computer;
  bp::ErrorFlags error_flags;
  BlueyeDrone::Counts counts;

  bool has(BlueyeDevice device) const;  ///< fitted, and its port is on
  bool armed() const;
  UtcTime clock() const { return now + computer.clock_offset; }
  bool altitudeValid() const;
  double depth() const;  ///< m, as the pressure sensor and the set density have it
  std::optional<nmea::LatLon> gnss() const;
  /// True, or magnetic while the drone does not know where it is.
  double compassHeading() const;

  void setModes(const BlueyeModes& modes);
  void zeroMotion();
  void notify(bp::NotificationType type, bp::NotificationLevel level = bp::NOTIFICATION_LEVEL_INFO,
              std::optional<std::int32_t> value = std::nullopt);
  /// Has a telemetry message sent at the end of this step, whatever its rate.
  void announce(const std::string& telemetry) { computer.events.insert(telemetry); }
  void clientsChanged() { announce("ConnectedClientsTel"); }
  void resetPosition(const BlueyeReset& how);

  void step(double dt_s);
  void reboot();

 private:
  void watch();
  void steer(double dt_s);
  void lookUp();

  UtcTime watchdogTimeout() const;
};

/// Noise of one sigma, or none; never the same twice.
double noise(BlueyeCore& core, double sigma);

UtcTime seconds(double value);
google::protobuf::Timestamp toTimestamp(UtcTime time);

/// Empty for what no clock shows: before 1970, after 2200, or without nanoseconds of a second.
std::optional<UtcTime> toUtc(const google::protobuf::Timestamp& stamp);

}  // namespace frontseat_driver::sim
