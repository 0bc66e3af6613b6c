#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frontseat_driver/sim/blueye/config.h"
#include "frontseat_driver/sim/rov.h"
#include "frontseat_driver/sim/truth.h"

namespace frontseat_driver::sim {

/// A Blueye drone as its clients see it: bytes and time in, bytes out. No socket, thread or clock;
/// time is UTC and may be virtual. Equal calls give equal bytes.
///
/// Messages are named as in the first frame on the wire, with their package:
/// `blueye.protocol.DepthTel`.
class BlueyeDrone {
 public:
  /// Where step() puts what leaves the drone.
  class Sink {
   public:
    virtual ~Sink() = default;
    /// Telemetry for all clients.
    virtual void publish(const std::string& name, std::string data) = 0;
    /// The answer to the request of `peer`.
    virtual void reply(const std::string& peer, const std::string& name, std::string data) = 0;
    virtual void truth(const Truth& truth) = 0;
  };

  /// What has arrived that could not be used.
  struct Counts {
    std::uint64_t unknown = 0;    ///< a name that is no message of this direction
    std::uint64_t malformed = 0;  ///< bytes that are not that message
    std::uint64_t refused = 0;    ///< NaN, infinity, or what the drone does not have
  };

  explicit BlueyeDrone(const BlueyeConfig& config);
  ~BlueyeDrone();
  BlueyeDrone(const BlueyeDrone&) = delete;
  BlueyeDrone& operator=(const BlueyeDrone&) = delete;

  /// Takes a request. Every one is answered at the next step(), an unknown one by
  /// `google.protobuf.Empty`, unless a fault wants otherwise. `peer` is given back as it is.
  void request(const std::string& peer, std::string_view name, std::string_view data);

  /// Takes a control message, whoever sent it: they do not say.
  void control(std::string_view name, std::string_view data);

  /// Lives up to `now` in fixed steps of kTick, then hands on all that was said.
  void step(UtcTime now, Sink& sink);

  static constexpr std::chrono::milliseconds kTick{10};

  UtcTime now() const;
  bool online() const;  ///< false while it reboots: no socket answers
  const Rov& model() const;
  const Counts& counts() const;
  std::uint32_t pictures() const;  ///< taken since power-on

  /// The faults, to be changed at any time.
  BlueyeFaults& faults();
  /// Starts the drone's computer anew: it forgets clients, rates, mission and modes.
  void reboot();
  /// Raises or clears a flag of ErrorFlagsTel; false if there is none of that name.
  bool setErrorFlag(const std::string& name, bool raised);

  /// JSON, as the drone's web server answers `GET /diagnostics/drone_info`.
  static std::string droneInfo(const BlueyeConfig& config);

  /// Names, without package, of all that the drone knows.
  static std::vector<std::string> knownTelemetry();
  static std::vector<std::string> knownRequests();
  static std::vector<std::string> knownControls();
  /// Hz of a telemetry message unless told otherwise; 0: on request or on events only.
  static std::optional<double> defaultRate(const std::string& telemetry);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace frontseat_driver::sim
