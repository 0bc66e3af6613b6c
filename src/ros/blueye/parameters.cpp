#include "blueye/parameters.h"

#include <arpa/inet.h>

#include <algorithm>
#include <cctype>

namespace frontseat_driver::ros_layer::blueye_layer {

namespace {

constexpr double kHour_s = 3600.0;
constexpr double kStddevMax = 1000.0;

bool isGraphic(const std::string& text) {
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return std::isgraph(static_cast<unsigned char>(c)) != 0; });
}

/// ZeroMQ reads more into a host than others: a transport, a source address, a wildcard.
bool isHostName(const std::string& text) {
  return !text.empty() && text.size() <= 255 && std::all_of(text.begin(), text.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '_';
  });
}

/// With or without brackets and an interface.
bool isIpv6(std::string text) {
  if (text.size() > 2 && text.front() == '[' && text.back() == ']') {
    text = text.substr(1, text.size() - 2);
  }
  const std::size_t zone = text.find('%');
  if (zone != std::string::npos && !isHostName(text.substr(zone + 1))) return false;
  in6_addr address{};
  return inet_pton(AF_INET6, text.substr(0, zone).c_str(), &address) == 1;
}

link::ZmqClient::Options readLink(PrivateParameters& in) {
  constexpr const char* kAccepted = "a host name or an address, without tcp:// and port,";
  link::ZmqClient::Options out;
  out.host = in.text("host", out.host, kAccepted);
  if (!isHostName(out.host) && !isIpv6(out.host)) in.refuse("host", kAccepted);
  const auto port = [&in](const char* name, std::uint16_t fallback) {
    return static_cast<std::uint16_t>(in.integer(name, fallback, 1, 65535));
  };
  out.telemetry_port = port("telemetry_port", out.telemetry_port);
  out.request_port = port("request_port", out.request_port);
  out.control_port = port("control_port", out.control_port);
  out.connect_timeout = in.duration("connect_timeout", out.connect_timeout, above(0, kHour_s, "s"));
  out.reconnect_min = in.duration("reconnect_min", out.reconnect_min, above(0, kHour_s, "s"));
  out.reconnect_max = in.duration("reconnect_max", out.reconnect_max, above(0, kHour_s, "s"));
  out.silence_timeout = in.duration("silence_timeout", out.silence_timeout, above(0, kHour_s, "s"));
  if (out.reconnect_min > out.reconnect_max) {
    in.refuse(in.has("reconnect_max") ? "reconnect_max" : "reconnect_min",
              "reconnect_min up to reconnect_max");
  }
  return out;
}

std::map<std::string, double> readRates(PrivateParameters& in, const XmlRpc::XmlRpcValue& values) {
  constexpr const char* kAccepted =
      "a map from names of telemetry messages to 0..100 Hz, {DepthTel: 40},";
  std::map<std::string, double> out;
  if (!in.has("rates")) return out;
  XmlRpc::XmlRpcValue all = values;
  XmlRpc::XmlRpcValue& given = all["rates"];
  if (given.getType() != XmlRpc::XmlRpcValue::TypeStruct) in.refuse("rates", kAccepted);
  for (auto& [name, rate] : given) {
    double rate_hz = -1.0;
    if (rate.getType() == XmlRpc::XmlRpcValue::TypeInt) rate_hz = static_cast<int>(rate);
    if (rate.getType() == XmlRpc::XmlRpcValue::TypeDouble) rate_hz = static_cast<double>(rate);
    const bool is_telemetry = name.size() > 3 && name.substr(name.size() - 3) == "Tel";
    if (!is_telemetry || !(rate_hz >= 0.0 && rate_hz <= 100.0)) in.refuse("rates", kAccepted);
    out[name] = rate_hz;
  }
  return out;
}

session::BlueyeOptions readSession(PrivateParameters& in, const XmlRpc::XmlRpcValue& values) {
  session::BlueyeOptions out;
  out.client_name = in.text("client_name", out.client_name, "a text");
  out.observer = in.boolean("observer", out.observer);
  out.sync_time = in.boolean("sync_time", out.sync_time);
  out.request_timeout = in.duration("request_timeout", out.request_timeout, above(0, 60, "s"));
  out.control_timeout = in.duration("control_timeout", out.control_timeout, above(0, 60, "s"));
  out.rates_hz = readRates(in, values);
  if (in.has("water_density")) {
    out.water_density_kg_m3 = in.number(
        "water_density", 1025.0, between(kLightestWater_kg_m3, kHeaviestWater_kg_m3, "kg/m^3"));
  }
  using Mounting = session::PingerMounting;
  out.pinger_mounting = in.choice("pinger_mounting", out.pinger_mounting,
                                  {{"unset", Mounting::Unset},
                                   {"forwards", Mounting::Forwards},
                                   {"downwards", Mounting::Downwards}});
  out.allow_format = in.boolean("allow_format", out.allow_format);
  out.allow_flash = in.boolean("allow_flash", out.allow_flash);
  out.commands_enabled = in.boolean("commands_enabled", out.commands_enabled);
  out.command_timeout = in.duration("command_timeout", out.command_timeout, above(0, 5, "s"));
  out.command_rate_hz = in.number("command_rate", out.command_rate_hz, between(1, 30, "Hz"));
  out.clockwise_yaw =
      in.choice("yaw_positive", out.clockwise_yaw, {{"right", true}, {"left", false}});
  return out;
}

Conventions readConventions(PrivateParameters& in) {
  Conventions out;
  out.dvl_y_right = in.choice("dvl_y_axis", out.dvl_y_right, {{"right", true}, {"left", false}});
  out.accelerometer_sign = in.choice("accelerometer_sign", out.accelerometer_sign,
                                     {{"auto", AccelerometerSign::Auto},
                                      {"specific_force", AccelerometerSign::SpecificForce},
                                      {"gravity", AccelerometerSign::Gravity}});
  out.battery_discharge_negative = in.choice("battery_discharge", out.battery_discharge_negative,
                                             {{"negative", true}, {"positive", false}});
  out.heave_velocity_down = in.choice("heave_velocity_positive", out.heave_velocity_down,
                                      {{"down", true}, {"up", false}});
  out.bearings_clockwise =
      in.choice("bearings_positive", out.bearings_clockwise, {{"right", true}, {"left", false}});
  out.multibeam_tilt_up =
      in.choice("multibeam_tilt_positive", out.multibeam_tilt_up, {{"up", true}, {"down", false}});
  out.add_declination_rad =
      in.number("add_declination", out.add_declination_rad, between(-M_PI, M_PI, "rad"));
  out.servo_min_rad = in.number("servo_min", out.servo_min_rad, between(-M_PI, M_PI, "rad"));
  out.servo_max_rad = in.number("servo_max", out.servo_max_rad, between(-M_PI, M_PI, "rad"));
  if (out.servo_min_rad >= out.servo_max_rad) in.refuse("servo_max", "an angle above servo_min");
  return out;
}

Deviations readDeviations(PrivateParameters& in) {
  Deviations out;
  const auto read = [&in](const char* name, double& value, const char* unit) {
    value = in.number(name, value, above(0, kStddevMax, unit));
  };
  read("depth_stddev", out.depth_m, "m");
  read("orientation_stddev", out.orientation_rad, "rad");
  read("velocity_stddev", out.velocity_m_s, "m/s");
  read("angular_rate_stddev", out.angular_rate_rad_s, "rad/s");
  read("acceleration_stddev", out.acceleration_m_s2, "m/s2");
  return out;
}

std::string readFrame(PrivateParameters& in, const char* name, const std::string& fallback) {
  constexpr const char* kAccepted = "a frame name, without blanks,";
  std::string frame = in.text(name, fallback, kAccepted);
  frame.erase(0, frame.find_first_not_of('/'));
  if (frame.empty() || !isGraphic(frame)) in.refuse(name, kAccepted);
  return frame;
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

Publisher::Options readPublisher(PrivateParameters& in) {
  Publisher::Options out;
  NavigationOptions& navigation = out.navigation;
  navigation.conventions = readConventions(in);
  navigation.deviations = readDeviations(in);
  navigation.map_frame = readFrame(in, "map_frame", navigation.map_frame);
  navigation.odom_frame = readFrame(in, "odom_frame", navigation.odom_frame);
  navigation.base_frame = readFrame(in, "base_frame", navigation.base_frame);
  if (navigation.base_frame == navigation.odom_frame) {
    in.refuse("base_frame", "a frame name other than odom_frame");
  }
  if (navigation.map_frame == navigation.odom_frame) {
    in.refuse("map_frame", "a frame name other than odom_frame");
  }
  navigation.datum = readDatum(in);
  navigation.max_speed_m_s = in.number("max_jump", navigation.max_speed_m_s, above(0, 1e6, "m/s"));
  navigation.max_data_age =
      in.duration("max_data_age", navigation.max_data_age, above(0, kHour_s, "s"));
  out.publish_tf = in.boolean("publish_tf", out.publish_tf);
  out.publish_map_tf = in.boolean("publish_map_tf", out.publish_map_tf);
  out.publish_frd_frames = in.boolean("publish_frd_frames", out.publish_frd_frames);
  return out;
}

FullSpeed readFullSpeed(PrivateParameters& in) {
  FullSpeed out;
  out.surge_m_s = in.number("max_surge", out.surge_m_s, above(0, 10, "m/s"));
  out.sway_m_s = in.number("max_sway", out.sway_m_s, above(0, 10, "m/s"));
  out.heave_m_s = in.number("max_heave", out.heave_m_s, above(0, 10, "m/s"));
  out.yaw_rate_rad_s = in.number("max_yaw_rate", out.yaw_rate_rad_s, above(0, 10, "rad/s"));
  return out;
}

Parameters readAll(PrivateParameters& in, const XmlRpc::XmlRpcValue& values) {
  Parameters out;
  out.link = readLink(in);
  out.session = readSession(in, values);
  out.publisher = readPublisher(in);
  out.full_speed = readFullSpeed(in);
  out.source = in.choice("source", out.source, {{"zmq", Source::Zmq}, {"topic", Source::Topic}});
  out.session.listen_only = out.source == Source::Topic;
  out.publisher.navigation.conventions.yaw_clockwise = out.session.clockwise_yaw;
  if (out.session.water_density_kg_m3) {
    out.publisher.navigation.conventions.water_density_kg_m3 = *out.session.water_density_kg_m3;
  }
  return out;
}

}  // namespace

Parameters readParameters(const XmlRpc::XmlRpcValue& private_params) {
  PrivateParameters in(private_params);
  return readAll(in, private_params);
}

std::vector<std::string> unknownParameterWarnings(const XmlRpc::XmlRpcValue& private_params) {
  // Reading defaults asks for every name and refuses none.
  PrivateParameters nothing_set{XmlRpc::XmlRpcValue()};
  readAll(nothing_set, XmlRpc::XmlRpcValue());
  nothing_set.alsoKnown({"diagnostic_period", "num_worker_threads"});
  return nothing_set.unknownIn(private_params);
}

}  // namespace frontseat_driver::ros_layer::blueye_layer
