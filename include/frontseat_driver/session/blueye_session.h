#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frontseat_driver/session/blueye_controls.h"
#include "frontseat_driver/session/blueye_requests.h"
#include "frontseat_driver/vehicle/clock.h"
#include "frontseat_driver/vehicle/command.h"
#include "frontseat_driver/vehicle/event.h"

namespace frontseat_driver::session {

/// How the echo sounder is mounted.
enum class PingerMounting { Unset, Forwards, Downwards };

/// What the user chose for the conversation; names and defaults as in the parameter table.
struct BlueyeOptions {
  std::string client_name = "frontseat_driver";
  /// True: control is taken on request only. False: control is taken whenever nobody has it.
  bool observer = true;
  bool commands_enabled = true;
  bool sync_time = true;                   ///< set the drone's clock when control is gained
  bool clockwise_yaw = true;               ///< what the drone takes a positive yaw for
  std::map<std::string, double> rates_hz;  ///< by name without package: AttitudeTel
  std::optional<double> water_density_kg_m3;
  PingerMounting pinger_mounting = PingerMounting::Unset;
  bool allow_format = false;
  bool allow_flash = false;
  bool listen_only = false;  ///< a record is played: nothing is ever sent

  std::chrono::nanoseconds command_timeout{std::chrono::seconds{1}};
  double command_rate_hz = 10.0;
  std::chrono::milliseconds request_timeout{2000};
  std::chrono::milliseconds control_timeout{1000};  ///< for take_control
};

/// Somebody connected to the drone, this client or another.
struct BlueyeClient {
  std::uint32_t id = 0;
  std::string name;
  std::string type;
  bool observer = false;
};

/// What came in since the session began.
struct BlueyeCounters {
  std::uint64_t bytes_received = 0;
  std::uint64_t telemetry_received = 0;
  std::uint64_t replies_received = 0;
  std::uint64_t malformed = 0;  ///< not two frames, or the bytes are not of the type
  std::uint64_t refused_commands = 0;
};

/// What the drone sends, and what changed.
class BlueyeListener {
 public:
  virtual ~BlueyeListener() = default;
  /// A telemetry message, known or not, in order; those asked for at the start as well.
  virtual void telemetry(const vehicle::Now& now, std::string_view type,
                         std::string_view payload) = 0;
  virtual void event(const vehicle::Now& now, const vehicle::Event& event) = 0;
  /// Who is connected has changed.
  virtual void clients(const vehicle::Now& now) = 0;
  /// Something for people, of no consequence to the conversation.
  virtual void note(const std::string& text) = 0;
};

/// The conversation with a Blueye drone (protocol version 3). No socket, clock or thread: messages
/// and time in, messages and events out.
///
/// After every connect: ping, registration as an observer, rates, and the newest of what matters.
/// An observer is never given control; takeControl() registers anew and asks whoever has it to go.
/// The drone obeys every control message it hears, whoever sends it, so this session keeps silent
/// by itself unless the drone says that this client is in control. Then, and only then, it sends
/// the watchdog twice a second, and motion from the newest fresh command.
///
/// A lost link, a rebooted drone and another client that takes over all end commanding and forget
/// every command; what was registered is registered again, as an observer.
class BlueyeSession {
 public:
  using SteadyTime = vehicle::SteadyTime;
  struct Answer {
    bool success = false;
    std::string message;
  };
  using Respond = std::function<void(const Answer&)>;
  using RespondReply = std::function<void(const BlueyeReply&)>;

  BlueyeSession(BlueyeOptions options, BlueyeListener& listener);

  // What the link tells.
  void connected(const vehicle::Now& now, BlueyeOutput& out);
  void disconnected(const vehicle::Now& now, BlueyeOutput& out);
  void telemetry(const vehicle::Now& now, std::string_view type, std::string_view payload,
                 BlueyeOutput& out);
  void malformed() { ++counters_.malformed; }
  void reply(const vehicle::Now& now, std::string_view type, std::string_view payload,
             BlueyeOutput& out);
  void noReply(const vehicle::Now& now, const std::string& reason, BlueyeOutput& out);

  /// Does what is due at `now`. Call after every other call and at nextStep().
  void step(const vehicle::Now& now, BlueyeOutput& out);
  SteadyTime nextStep() const;

  /// This process did not run for a while: what it reads now may have lain in the kernel for as
  /// long. Ends commanding, and for a fifth of a second nothing is taken but what ends it.
  void stoodStill(const vehicle::Now& now);

  /// Plans zero motion and goodbye, and nothing after them.
  void leave(const vehicle::Now& now, BlueyeOutput& out);
  bool hasLeft() const { return leaving_ && goodbye_said_ && !held_.zerosDue(); }

  /// Takes the place of the command before. `received` is when it reached this computer. Returns
  /// why it was refused, or nothing; a refused command changes nothing.
  std::string command(const vehicle::Now& now, const vehicle::DroneCommand& command,
                      SteadyTime received);

  /// Ends commanding: zero motion, tilt and gripper, and a mission is paused, again until the drone
  /// shows that none runs. Not in control, nothing is sent, since it would stop somebody else.
  /// No success when nothing was sent.
  Answer stop(const vehicle::Now& now, BlueyeOutput& out);

  /// As stop(), and the mission is unloaded. No success when nothing was sent.
  Answer abort(const vehicle::Now& now, BlueyeOutput& out);

  /// Opens or closes the gate. Closing sends zero motion; opening revives nothing.
  void setCommandsEnabled(const vehicle::Now& now, bool enabled);

  void takeControl(const vehicle::Now& now, Respond respond, BlueyeOutput& out);
  void releaseControl(const vehicle::Now& now, Respond respond, BlueyeOutput& out);

  /// One control message with gate and control as for a command. Motion, tilt, gripper and watchdog
  /// have owners and are refused. `received` as of a command, where it may have waited.
  void control(const vehicle::Now& now, ConfirmedControls::Control control, BlueyeOutput& out,
               std::optional<SteadyTime> received = std::nullopt);

  /// Any request, answered with the reply or the reason why there is none. One that has waited for
  /// `timeout` for those before it is not sent any more: whoever asked may have given up on it.
  void request(const vehicle::Now& now, std::string type, std::string payload,
               std::chrono::milliseconds timeout, RespondReply respond, BlueyeOutput& out);

  /// Asked for now and after every connect.
  void setRate(const vehicle::Now& now, const std::string& message, double rate_hz, Respond respond,
               BlueyeOutput& out);

  /// Sent whenever control is gained from now on.
  void setWaterDensity(double density_kg_m3) { water_density_kg_m3_ = density_kg_m3; }

  /// Waits for telemetry that shows something, asking for it meanwhile.
  void await(const vehicle::Now& now, const std::string& telemetry_type,
             std::function<bool(std::string_view payload)> shows,
             ConfirmedControls::Respond respond, BlueyeOutput& out);

  void countRefusedCommands(std::uint64_t count) { counters_.refused_commands += count; }

  /// Registered with the drone.
  bool registered() const { return id_ != 0; }
  std::uint32_t id() const { return id_; }
  std::uint32_t idInControl() const { return id_in_control_; }
  bool inControl() const { return registered() && id_in_control_ == id_; }
  const std::vector<BlueyeClient>& clients() const { return clients_; }
  const BlueyeCounters& counters() const { return counters_; }
  vehicle::Grant grant() const;
  /// Why a command would be refused now; empty if it would not.
  std::string refusal() const;
  /// Also when it reached this computer at `received`: too old, or from before a stop.
  std::string refusal(const vehicle::Now& now, SteadyTime received) const;
  bool commandsEnabled() const { return commands_enabled_; }
  bool commanding() const { return held_.commanding(); }
  const std::optional<vehicle::DroneCommand>& commanded() const { return held_.motion(); }
  vehicle::MissionStatus::State mission() const { return mission_; }

 private:
  /// How control is being asked for; empty when it is not.
  struct Taking {
    SteadyTime deadline;
    SteadyTime again;  ///< max: a request is under way
    Respond respond;   ///< empty: the caller has been told that it is too late
  };
  /// How many ConnectedClientsTel had been heard when a question was asked.
  using Asked = std::uint64_t;
  using Then = std::function<void(const vehicle::Now&, BlueyeOutput&)>;
  using Heard = std::function<void(const vehicle::Now&, bool received, BlueyeOutput&)>;

  void ping(const vehicle::Now& now, BlueyeOutput& out);
  void registerClient(const vehicle::Now& now, bool observer, Then then, BlueyeOutput& out);
  void unregister(const vehicle::Now& now, std::uint32_t id, Then then, BlueyeOutput& out);
  void setUp(const vehicle::Now& now, BlueyeOutput& out);
  void askForRate(const vehicle::Now& now, const std::string& message, double rate_hz,
                  Respond respond, BlueyeOutput& out);
  void askForTelemetry(const vehicle::Now& now, const std::string& message, BlueyeOutput& out,
                       Heard heard = {});
  void askForClients(const vehicle::Now& now, BlueyeOutput& out);
  void askForConfirmations(const vehicle::Now& now, BlueyeOutput& out);
  void continueTaking(const vehicle::Now& now, BlueyeOutput& out);
  void watchTaking(const vehicle::Now& now, BlueyeOutput& out);
  SteadyTime nextTaking() const;
  void finishTaking(const vehicle::Now& now, const Answer& answer, BlueyeOutput& out);
  void giveBack(const vehicle::Now& now, Respond respond, BlueyeOutput& out);
  void finishReleasing(const vehicle::Now& now, const Answer& answer);

  /// `asked` is empty on the telemetry connection.
  void hear(const vehicle::Now& now, std::string_view type, std::string_view payload,
            std::optional<Asked> asked, BlueyeOutput& out);
  void hearClients(const vehicle::Now& now, std::string_view payload, std::optional<Asked> asked,
                   BlueyeOutput& out);
  void hearMission(const vehicle::Now& now, std::string_view payload);
  void hearClock(const vehicle::Now& now, std::string_view payload, BlueyeOutput& out);
  template <class Message>
  void learnClients(const vehicle::Now& now, const Message& message, Asked asked,
                    BlueyeOutput& out);
  void setIdInControl(const vehicle::Now& now, std::uint32_t id, BlueyeOutput& out);
  void gainControl(const vehicle::Now& now, BlueyeOutput& out);
  void loseRegistration(const vehicle::Now& now);
  void sendWatchdog(const vehicle::Now& now, BlueyeOutput& out);
  void endCommanding(const vehicle::Now& now, bool all);
  void reportControl(const vehicle::Now& now);
  std::string refusalOf(std::string_view control_type) const;
  bool silent() const { return leaving_ || options_.listen_only; }

  const BlueyeOptions options_;
  BlueyeListener& listener_;
  std::map<std::string, double> rates_hz_;
  BlueyeCounters counters_;
  std::optional<double> water_density_kg_m3_;
  bool commands_enabled_;
  bool leaving_ = false;
  bool goodbye_said_ = false;

  BlueyeRequests requests_;
  HeldControls held_;
  ConfirmedControls confirmed_;
  StreamedControls streamed_;

  // Of this connection.
  bool connected_ = false;
  SteadyTime register_due_ = SteadyTime::max();
  bool registering_ = false;  ///< what the drone tells of us is about to change
  std::uint32_t id_ = 0;
  bool as_observer_ = true;
  std::uint32_t id_in_control_ = 0;
  std::vector<BlueyeClient> clients_;
  bool lists_clients_ = false;  ///< it has listed some
  SteadyTime ask_clients_due_ = SteadyTime::max();
  bool asking_clients_ = false;
  bool ask_clients_again_ = false;     ///< something was told since the question
  Asked told_ = 0;                     ///< ConnectedClientsTel heard
  std::uint32_t told_in_control_ = 0;  ///< by the last of them
  SteadyTime registered_since_{};
  SteadyTime permitted_since_{};  ///< or stopped: a command must not be older
  SteadyTime awake_since_{};      ///< what was read before may be of any age
  bool permitted_ = false;
  SteadyTime watchdog_due_ = SteadyTime::max();
  std::optional<Taking> taking_;
  std::optional<Respond> releasing_;  ///< while control is being given back
  SteadyTime ask_confirmations_{};
  vehicle::MissionStatus::State mission_ = vehicle::MissionStatus::State::Unknown;
  std::optional<std::chrono::nanoseconds> drone_uptime_;

  /// What was reported last.
  struct Reported {
    vehicle::Grant grant;
    bool commands_enabled;
    bool commanding;
    std::string reason;
    bool operator==(const Reported& other) const {
      return grant == other.grant && commands_enabled == other.commands_enabled &&
             commanding == other.commanding && reason == other.reason;
    }
  };
  std::optional<Reported> reported_;
};

}  // namespace frontseat_driver::session
