#include "frontseat_driver/sim/blueye/drone.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <utility>

#include "controls.h"
#include "core.h"
#include "reflection.h"
#include "requests.h"
#include "telemetry.h"

namespace frontseat_driver::sim {
namespace {

constexpr std::chrono::milliseconds kTruthPeriod{50};
// A rate below once in a week is once in a week.
constexpr double kSeldom_s = 604800.0;

/// What follows the package; empty if there is no such package in front.
std::string withoutPackage(std::string_view name) {
  const std::string_view package{kBlueyePackage};
  if (name.substr(0, package.size()) != package) return {};
  return std::string{name.substr(package.size())};
}

std::string jsonText(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20) continue;
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return '"' + out + '"';
}

}  // namespace

const std::vector<std::pair<std::string, BlueyeDevice>>& blueyeDeviceNames() {
  static const std::vector<std::pair<std::string, BlueyeDevice>> kNames{
      {"dvl", BlueyeDevice::Dvl},
      {"gnss", BlueyeDevice::Gnss},
      {"light", BlueyeDevice::Light},
      {"camera", BlueyeDevice::Camera},
      {"gripper", BlueyeDevice::Gripper},
      {"laser", BlueyeDevice::Laser},
      {"servo", BlueyeDevice::Servo},
      {"multibeam", BlueyeDevice::Multibeam},
      {"multibeam_servo", BlueyeDevice::MultibeamServo},
      {"pinger", BlueyeDevice::Pinger},
      {"thickness_gauge", BlueyeDevice::ThicknessGauge},
      {"cp_probe", BlueyeDevice::CpProbe},
      {"aqua_troll", BlueyeDevice::AquaTroll},
      {"medusa", BlueyeDevice::Medusa}};
  return kNames;
}

std::vector<BlueyeDevice> allBlueyeDevices() {
  std::vector<BlueyeDevice> all;
  for (const auto& [name, device] : blueyeDeviceNames()) all.push_back(device);
  return all;
}

struct BlueyeDrone::Impl {
  explicit Impl(const BlueyeConfig& config)
      : core(config), faults(config.faults), chance(config.seed, 3), next_tick(core.now) {
    useConfiguredRates();
  }

  void useConfiguredRates() {
    for (const auto& [name, hz] : core.config.rates) core.computer.rates[name] = hz;
  }

  void request(const std::string& peer, std::string_view name, std::string_view data) {
    if (!online()) return;
    nothing_due_before = UtcTime{0};
    Reply reply{peer, "google.protobuf.Empty", {}, core.now + seconds(faults.reply_delay_s)};
    if (const BlueyeRequest* known = findBlueyeRequest(withoutPackage(name))) {
      reply.name = kBlueyePackage + known->reply;
      if (auto answer = known->answer(core, data)) {
        reply.data = std::move(*answer);
      } else {
        ++core.counts.malformed;
      }
    } else {
      ++core.counts.unknown;
    }
    if (chance.chance(faults.lose_replies)) return;
    replies.push_back(std::move(reply));
  }

  void control(std::string_view name, std::string_view data) {
    if (!online()) return;
    nothing_due_before = UtcTime{0};
    const BlueyeControl* known = findBlueyeControl(withoutPackage(name));
    if (known == nullptr) {
      ++core.counts.unknown;
      return;
    }
    switch (known->obey(core, data)) {
      case BlueyeTaken::Obeyed:
        break;
      case BlueyeTaken::Malformed:
        ++core.counts.malformed;
        break;
      case BlueyeTaken::Refused:
        ++core.counts.refused;
        break;
    }
  }

  void step(UtcTime until, Sink& sink) {
    flush(sink);
    while (next_tick + kTick <= until) {
      next_tick += kTick;
      core.now = next_tick;
      tick(sink);
    }
    core.now = std::max(core.now, until);
    flush(sink);
  }

  void tick(Sink& sink) {
    suffer();
    finishBooting();
    core.step(std::chrono::duration<double>(kTick).count());
    if (online()) publish(sink);
    if (core.now < next_truth) return;
    next_truth = std::max(next_truth + kTruthPeriod, core.now);
    sink.truth({core.clock(), core.rov.position(), core.rov.state()});
  }

  /// The faults that come with time.
  void suffer() {
    if (again(faults.reboot_every_s, next_reboot)) reboot();
    if (again(faults.silence_every_s, next_silence)) {
      silence_ends = core.now + seconds(faults.silence_s);
    }
  }

  /// Whether what happens every so often happens now.
  bool again(double every_s, std::optional<UtcTime>& next) const {
    if (every_s <= 0.0) {
      next.reset();
      return false;
    }
    if (!next) next = core.now + seconds(every_s);
    if (core.now < *next) return false;
    next = core.now + seconds(every_s);
    return true;
  }

  void reboot() {
    nothing_due_before = UtcTime{0};
    core.reboot();
    useConfiguredRates();
    replies.clear();
    back = core.now + seconds(faults.reboot_s);
    booting = true;
  }

  /// What happened while the computer was off, it does not know.
  void finishBooting() {
    if (!booting || !online()) return;
    booting = false;
    nothing_due_before = UtcTime{0};
    core.reboot();
    useConfiguredRates();
  }

  bool online() const { return core.now >= back; }
  bool silent() const { return core.now < silence_ends; }

  // Most ticks publish nothing, and looking through all rates costs more than all the rest.
  void publish(Sink& sink) {
    const BlueyeComputer& computer = core.computer;
    const bool news = !computer.notifications.empty() || !computer.events.empty();
    const bool pings = computer.multibeam.rateHz() > 0.0;
    if (!news && !pings && core.now < nothing_due_before) return;
    publishDue(sink);
    nothing_due_before = core.now + std::chrono::seconds{1};
    for (const auto& [name, due] : computer.due) {
      nothing_due_before = std::min(nothing_due_before, due);
    }
  }

  void publishDue(Sink& sink) {
    while (!core.computer.notifications.empty()) {
      bp::NotificationTel message;
      *message.mutable_notification() = core.computer.notifications.front();
      core.computer.notifications.pop_front();
      send(nameOf<bp::NotificationTel>(), message.SerializeAsString(), sink);
    }
    for (const BlueyeTelemetry& row : blueyeTelemetry()) {
      const bool event = core.computer.events.erase(row.name) > 0;
      if (!due(row) && !event) continue;
      if (auto data = row.build(core)) send(row.name, std::move(*data), sink);
    }
  }

  double rate(const BlueyeTelemetry& row) const {
    const auto set = core.computer.rates.find(row.name);
    if (set != core.computer.rates.end()) return set->second;
    return row.name == "MultibeamPingTel" ? core.computer.multibeam.rateHz() : row.hz;
  }

  bool due(const BlueyeTelemetry& row) {
    const double hz = rate(row);
    if (hz <= 0.0) return false;
    const UtcTime period = seconds(std::min(1.0 / hz, kSeldom_s));
    UtcTime& next = core.computer.due.emplace(row.name, core.now).first->second;
    if (core.now < next) return false;
    next += period;
    if (next <= core.now - period) next = core.now + period;
    return true;
  }

  void send(const std::string& name, std::string data, Sink& sink) {
    if (silent() || chance.chance(faults.lose_telemetry)) return;
    spoil(data);
    sink.publish(kBlueyePackage + name, std::move(data));
  }

  void spoil(std::string& data) {
    if (data.empty() || !chance.chance(faults.corrupt)) return;
    char& byte = data[chance.below(data.size())];
    byte = static_cast<char>(static_cast<unsigned char>(byte) ^ (1U << chance.below(8)));
  }

  void flush(Sink& sink) {
    while (!replies.empty() && replies.front().due <= core.now) {
      Reply reply = std::move(replies.front());
      replies.pop_front();
      if (silent() || !online()) continue;
      spoil(reply.data);
      sink.reply(reply.peer, reply.name, std::move(reply.data));
    }
  }

  struct Reply {
    std::string peer;
    std::string name;
    std::string data;
    UtcTime due;
  };

  BlueyeCore core;
  BlueyeFaults faults;
  Random chance;
  UtcTime next_tick;
  UtcTime next_truth{0};
  UtcTime nothing_due_before{0};  ///< unless a client asks for something
  std::optional<UtcTime> next_reboot;
  std::optional<UtcTime> next_silence;
  UtcTime silence_ends{0};
  UtcTime back{0};  ///< online from then on
  bool booting = false;
  std::deque<Reply> replies;
};

BlueyeDrone::BlueyeDrone(const BlueyeConfig& config) : impl_(std::make_unique<Impl>(config)) {}
BlueyeDrone::~BlueyeDrone() = default;

void BlueyeDrone::request(const std::string& peer, std::string_view name, std::string_view data) {
  impl_->request(peer, name, data);
}

void BlueyeDrone::control(std::string_view name, std::string_view data) {
  impl_->control(name, data);
}

void BlueyeDrone::step(UtcTime now, Sink& sink) { impl_->step(now, sink); }

UtcTime BlueyeDrone::now() const { return impl_->core.now; }
bool BlueyeDrone::online() const { return impl_->online(); }
const Rov& BlueyeDrone::model() const { return impl_->core.rov; }
const BlueyeDrone::Counts& BlueyeDrone::counts() const { return impl_->core.counts; }
std::uint32_t BlueyeDrone::pictures() const { return impl_->core.computer.payload.pictures; }
BlueyeFaults& BlueyeDrone::faults() { return impl_->faults; }
void BlueyeDrone::reboot() { impl_->reboot(); }

bool BlueyeDrone::setErrorFlag(const std::string& name, bool raised) {
  impl_->core.announce("ErrorFlagsTel");
  return setFlag(impl_->core.error_flags, name, raised);
}

std::string BlueyeDrone::droneInfo(const BlueyeConfig& config) {
  const auto& devices = config.devices;
  const bool lasers =
      std::find(devices.begin(), devices.end(), BlueyeDevice::Laser) != devices.end();
  const std::string features = std::string{"tilt,gpdrone"} + (lasers ? ",lasers" : "");
  return "{\"commit_id_csys\": \"simulated\", \"features\": " + jsonText(features) +
         ", \"hardware_id\": " + jsonText("sim-" + config.serial_number) +
         ", \"manufacturer\": \"Blueye Robotics\", \"model\": \"X3\", \"operating_system\": "
         "\"blunux\", \"serial_number\": " +
         jsonText(config.serial_number) + ", \"sw_version\": " + jsonText(config.software_version) +
         "}\n";
}

namespace {

template <class Row>
std::vector<std::string> names(const std::vector<Row>& rows) {
  std::vector<std::string> all;
  all.reserve(rows.size());
  for (const Row& row : rows) all.push_back(row.name);
  return all;
}

}  // namespace

std::vector<std::string> BlueyeDrone::knownTelemetry() { return names(blueyeTelemetry()); }
std::vector<std::string> BlueyeDrone::knownRequests() { return names(blueyeRequests()); }
std::vector<std::string> BlueyeDrone::knownControls() { return names(blueyeControls()); }

std::optional<double> BlueyeDrone::defaultRate(const std::string& telemetry) {
  const BlueyeTelemetry* known = findBlueyeTelemetry(telemetry);
  if (known == nullptr) return std::nullopt;
  return known->hz;
}

}  // namespace frontseat_driver::sim
