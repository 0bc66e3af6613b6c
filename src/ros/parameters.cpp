#include "parameters.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>

#include "frontseat_driver/session/sentence_text.h"

namespace frontseat_driver::ros_layer {

namespace {

using protocol::Dialect;
using session::ControlHook;
using std::chrono::milliseconds;

constexpr double kHour_s = 3600.0;
constexpr double kPi = 3.14159265358979323846;
constexpr double kMetresPerSecondMax = 10.0;
constexpr double kRpmMax = 10000.0;
constexpr double kStddevMax = 1000.0;

std::string readHost(PrivateParameters& in, const std::string& fallback) {
  constexpr const char* kAccepted = "a host name or an address, without blanks,";
  const std::string host = in.text("host", fallback, kAccepted);
  const bool printable = std::all_of(host.begin(), host.end(), [](char c) {
    return std::isgraph(static_cast<unsigned char>(c)) != 0;
  });
  if (host.empty() || host.size() > 255 || !printable) in.refuse("host", kAccepted);
  return host;
}

link::TcpClient::Options readLink(PrivateParameters& in) {
  link::TcpClient::Options link;
  link.host = readHost(in, link.host);
  link.port = static_cast<std::uint16_t>(in.integer("port", link.port, 1, 65535));
  link.connect_timeout =
      in.duration("connect_timeout", link.connect_timeout, above(0, kHour_s, "s"));
  link.reconnect_min = in.duration("reconnect_min", link.reconnect_min, above(0, kHour_s, "s"));
  link.reconnect_max = in.duration("reconnect_max", link.reconnect_max, above(0, kHour_s, "s"));
  link.silence_timeout =
      in.duration("silence_timeout", link.silence_timeout, above(0, kHour_s, "s"));
  if (link.reconnect_min <= link.reconnect_max) return link;
  if (in.has("reconnect_max")) {
    const std::chrono::duration<double> least_s = link.reconnect_min;
    const std::string least = toText(XmlRpc::XmlRpcValue(least_s.count()));
    in.refuse("reconnect_max", "a number from reconnect_min, " + least + ", to 3600 s");
  }
  in.refuse("reconnect_min", "a number above 0 and up to reconnect_max, 10 s,");
}

std::string readInterfaceVersion(PrivateParameters& in, const std::string& fallback) {
  constexpr const char* kAccepted =
      "a number or a text of 1 to 20 printable ASCII characters without comma, asterisk and $";
  const std::string version = in.textOrNumber("interface_version", fallback, kAccepted);
  const auto text = session::toSentenceText(version);
  if (!text || version.empty() || version.size() > 20) in.refuse("interface_version", kAccepted);
  if (text->lowered) {
    in.refuse("interface_version",
              "a text without RMB, LOG, ABT, STS and VER, which a vehicle takes for commands,");
  }
  return version;
}

bool isSentenceName(const std::string& name) {
  return name.size() == 3 &&
         std::all_of(name.begin(), name.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
}

std::vector<std::string> readLogSentences(PrivateParameters& in,
                                          const std::vector<std::string>& fallback) {
  constexpr const char* kAccepted = "a list of sentence names of three capitals, [NVG, NVR],";
  std::vector<std::string> once;
  for (const std::string& name : in.words("log_sentences", fallback, kAccepted)) {
    if (!isSentenceName(name)) in.refuse("log_sentences", kAccepted);
    if (session::holdsCommand(name)) {
      in.refuse("log_sentences", "a list without the commands RMB, LOG, ABT, STS and VER");
    }
    if (std::find(once.begin(), once.end(), name) == once.end()) once.push_back(name);
  }
  return once;
}

session::NmeaOptions readSession(PrivateParameters& in) {
  session::NmeaOptions session;
  session.dialect = in.choice<std::optional<Dialect>>("dialect", session.dialect,
                                                      {{"sandshark", Dialect::Sandshark},
                                                       {"kingfisher", Dialect::Kingfisher},
                                                       {"auto", std::nullopt}});
  session.interface_version = readInterfaceVersion(in, session.interface_version);
  session.log_sentences = readLogSentences(in, session.log_sentences);
  session.use_acks = in.boolean("use_acks", session.use_acks);
  const bool is_boat = session.dialect == Dialect::Kingfisher;
  if (session.log_sentences.empty() && !session.use_acks && !is_boat) {
    in.refuse("log_sentences", "at least one sentence name where use_acks is false");
  }
  session.commands_enabled = in.boolean("commands_enabled", session.commands_enabled);
  session.control_hook = in.choice(
      "control_hook", session.control_hook,
      {{"ctl", ControlHook::Ctl}, {"mis", ControlHook::Mis}, {"none", ControlHook::None}});
  if (in.has("send_spacing")) {
    session.send_spacing = in.duration("send_spacing", milliseconds(0), between(0, 1, "s"));
  }
  return session;
}

std::string readFrame(PrivateParameters& in, const std::string& name, const std::string& fallback) {
  constexpr const char* kAccepted = "a frame name, without blanks,";
  std::string frame = in.text(name, fallback, kAccepted);
  frame.erase(0, frame.find_first_not_of('/'));
  const bool graphic = std::all_of(frame.begin(), frame.end(), [](char c) {
    return static_cast<unsigned char>(c) > 0x20 && c != 0x7F;
  });
  if (frame.empty() || !graphic) in.refuse(name, kAccepted);
  return frame;
}

void readFrames(PrivateParameters& in, Parameters& out) {
  out.odom_frame = readFrame(in, "odom_frame", out.odom_frame);
  out.base_frame = readFrame(in, "base_frame", out.base_frame);
  out.publish_tf = in.boolean("publish_tf", out.publish_tf);
  out.publish_frd_frames = in.boolean("publish_frd_frames", out.publish_frd_frames);
  if (out.odom_frame != out.base_frame) return;
  if (in.has("base_frame")) in.refuse("base_frame", "a frame name other than odom_frame");
  in.refuse("odom_frame", "a frame name other than base_frame");
}

std::optional<vehicle::Position> readDatum(PrivateParameters& in) {
  constexpr const char* kAccepted = "a list [latitude -90..90, longitude -180..180] in degrees";
  const std::vector<double> numbers = in.numbers("datum", kAccepted);
  if (!in.has("datum")) return std::nullopt;
  const bool in_range =
      numbers.size() == 2 && std::abs(numbers[0]) <= 90.0 && std::abs(numbers[1]) <= 180.0;
  if (!in_range) in.refuse("datum", kAccepted);
  return vehicle::Position{numbers[0], numbers[1]};
}

void readReferences(PrivateParameters& in, Parameters& out) {
  out.datum = readDatum(in);
  out.heading_reference = in.choice<std::optional<HeadingReference>>(
      "heading_reference", out.heading_reference,
      {{"grid", HeadingReference::Grid}, {"true", HeadingReference::True}});
  out.stamp = in.choice("stamp", out.stamp,
                        {{"synced", StampMode::Synced},
                         {"vehicle", StampMode::Vehicle},
                         {"receive", StampMode::Receive}});
  if (in.has("leap_seconds")) {
    out.leap_seconds = std::chrono::seconds(in.integer("leap_seconds", 0, -60, 60));
  }
}

std::vector<SpeedPoint> readSpeedTable(PrivateParameters& in) {
  constexpr const char* kAccepted =
      "a list of pairs [[m/s, rpm], ...] that increases in both, 0..10 m/s and -10000..10000 rpm,";
  const std::vector<double> numbers = in.numbers("speed_table", kAccepted, 2);
  if (numbers.size() % 2 != 0) in.refuse("speed_table", kAccepted);
  std::vector<SpeedPoint> table;
  for (std::size_t i = 0; i < numbers.size(); i += 2) {
    const SpeedPoint point{numbers[i], numbers[i + 1]};
    const bool in_range = point.speed_m_s >= 0.0 && point.speed_m_s <= kMetresPerSecondMax &&
                          std::abs(point.rpm) <= kRpmMax;
    const bool increases =
        table.empty() || (point.speed_m_s > table.back().speed_m_s && point.rpm > table.back().rpm);
    if (!in_range || !increases) in.refuse("speed_table", kAccepted);
    table.push_back(point);
  }
  return table;
}

void readCommands(PrivateParameters& in, Parameters& out) {
  out.command_timeout = in.duration("command_timeout", out.command_timeout, above(0, 5, "s"));
  out.max_command_age = in.duration("max_command_age", out.max_command_age, above(0, kHour_s, "s"));
  // A Sandshark takes over again after 5 s without a command.
  out.command_rate_hz = in.number("command_rate", out.command_rate_hz, between(0.25, 100, "Hz"));
  out.thrust_decimals = static_cast<int>(in.integer("thrust_decimals", out.thrust_decimals, 0, 6));
  out.yaw_rate_unit = in.choice("yaw_rate_unit", out.yaw_rate_unit,
                                {{"rad", YawRateUnit::Rad}, {"deg", YawRateUnit::Deg}});
  out.speed_table = readSpeedTable(in);
  out.max_speed_m_s =
      in.number("max_speed", out.max_speed_m_s, above(0, kMetresPerSecondMax, "m/s"));
  out.max_yaw_rate_rad_s = in.number("max_yaw_rate", out.max_yaw_rate_rad_s, above(0, 10, "rad/s"));
  out.fill_behavior_fields = in.boolean("fill_behavior_fields", out.fill_behavior_fields);
  out.ack_timeout = in.duration("ack_timeout", out.ack_timeout, above(0, 60, "s"));
  out.effect_timeout = in.duration("effect_timeout", out.effect_timeout, above(0, kHour_s, "s"));
  out.status_rate_hz = in.number("status_rate", out.status_rate_hz, between(0, 10, "Hz"));
  out.allow_raw_sentences = in.boolean("allow_raw_sentences", out.allow_raw_sentences);
}

void readSensors(PrivateParameters& in, Parameters& out) {
  out.max_jump_m_s = in.number("max_jump", out.max_jump_m_s, above(0, 1e6, "m/s"));
  out.max_data_age = in.duration("max_data_age", out.max_data_age, above(0, kHour_s, "s"));
  out.battery_low_v = in.number("battery_low_voltage", out.battery_low_v, between(0, 1000, "V"));
  out.magnetic_declination_rad =
      in.number("magnetic_declination", out.magnetic_declination_rad, between(-kPi, kPi, "rad"));
  out.compass_convention =
      in.choice("compass_convention", out.compass_convention,
                {{"spec", CompassConvention::Spec}, {"heron", CompassConvention::Heron}});
  out.acceleration_unit = in.choice("acceleration_unit", out.acceleration_unit,
                                    {{"m/s2", AccelerationUnit::MetersPerSecondSquared},
                                     {"g", AccelerationUnit::StandardGravity}});
}

void readStddevs(PrivateParameters& in, Parameters& out) {
  const auto read = [&in](const char* name, double& value, const char* unit) {
    value = in.number(name, value, above(0, kStddevMax, unit));
  };
  read("position_stddev_gps", out.position_stddev_gps_m, "m");
  read("position_stddev_dead_reckoning", out.position_stddev_dead_reckoning_m, "m");
  read("depth_stddev", out.depth_stddev_m, "m");
  read("orientation_stddev", out.orientation_stddev_rad, "rad");
  read("velocity_stddev", out.velocity_stddev_m_s, "m/s");
  read("angular_rate_stddev", out.angular_rate_stddev_rad_s, "rad/s");
  read("acceleration_stddev", out.acceleration_stddev_m_s2, "m/s2");
}

Parameters readAll(PrivateParameters& in) {
  Parameters out;
  out.link = readLink(in);
  out.session = readSession(in);
  out.source = in.choice("source", out.source, {{"tcp", Source::Tcp}, {"topic", Source::Topic}});
  readFrames(in, out);
  readReferences(in, out);
  readCommands(in, out);
  readSensors(in, out);
  readStddevs(in, out);
  return out;
}

}  // namespace

Parameters readParameters(const XmlRpc::XmlRpcValue& private_params) {
  PrivateParameters in(private_params);
  return readAll(in);
}

std::vector<std::string> unknownParameterWarnings(const XmlRpc::XmlRpcValue& private_params) {
  // Reading defaults asks for every name and refuses none.
  PrivateParameters nothing_set{XmlRpc::XmlRpcValue()};
  readAll(nothing_set);
  // Read by diagnostic_updater, and by the nodelet manager that a node brings with it.
  nothing_set.alsoKnown({"diagnostic_period", "num_worker_threads"});
  return nothing_set.unknownIn(private_params);
}

}  // namespace frontseat_driver::ros_layer
