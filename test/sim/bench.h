#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "frontseat_driver/sim/kingfisher_frontseat.h"
#include "frontseat_driver/sim/sandshark_frontseat.h"

namespace frontseat_driver::sim {

/// 2026-03-01 12:00:00 UTC, a Sunday; 12:00:18 by GPS.
constexpr UtcTime kNoon = std::chrono::seconds{1772366400};

/// Body and checksum of a sentence to the vehicle, with its line end: `$body*hh`.
std::string sentence(const std::string& body);

/// The fields of a line, the address first, the checksum taken off.
std::vector<std::string> fields(const std::string& line);

/// A frontseat in virtual time, with everything that it says.
class Bench : public Frontseat::Sink {
 public:
  explicit Bench(const SandsharkConfig& config);
  explicit Bench(const KingfisherConfig& config);

  void connect(ClientId client) { frontseat_->clientConnected(client, now_); }
  /// Sends one sentence with its checksum.
  void tell(ClientId client, const std::string& body) { bytes(client, sentence(body)); }
  void bytes(ClientId client, const std::string& text);

  /// Lets `s` seconds pass, 10 ms at a time.
  void run(double s);
  /// Lets time pass until `done`, or `limit_s`; false then.
  template <class Condition>
  bool runUntil(Condition done, double limit_s) {
    for (const UtcTime limit = now_ + seconds(limit_s); !done(); run(0.01)) {
      if (now_ >= limit) return false;
    }
    return true;
  }

  /// All bytes for a client since the last call.
  std::string heardBytes(ClientId client);
  /// The same as lines without line end; of one kind only if `address` is given.
  std::vector<std::string> heard(ClientId client, std::string_view address = {});

  Frontseat& frontseat() { return *frontseat_; }
  SandsharkFrontseat& sandshark() { return dynamic_cast<SandsharkFrontseat&>(*frontseat_); }
  KingfisherFrontseat& kingfisher() { return dynamic_cast<KingfisherFrontseat&>(*frontseat_); }
  const VehicleState& state() const { return frontseat_->model().state(); }
  UtcTime now() const { return now_; }

  std::vector<Truth> truths;
  std::vector<ClientId> disconnected;

  void send(ClientId client, std::string_view text) override { heard_[client].append(text); }
  void disconnect(ClientId client) override { disconnected.push_back(client); }
  void navigation(const Truth& truth) override { truths.push_back(truth); }

 private:
  static UtcTime seconds(double s) { return UtcTime{static_cast<std::int64_t>(s * 1e9)}; }

  std::unique_ptr<Frontseat> frontseat_;
  UtcTime now_ = kNoon;
  std::map<ClientId, std::string> heard_;
};

/// A Sandshark at noon, without noise, that begins its mission at once and has a long way to go.
SandsharkConfig runningSandshark();

/// A Kingfisher at noon, without noise or waves, that stays where it is until told otherwise.
KingfisherConfig restingKingfisher();

/// The way of a Kingfisher that is told nothing.
std::vector<PlanePoint> usualLoop();

}  // namespace frontseat_driver::sim
