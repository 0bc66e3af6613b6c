// From structs to bytes: each command and the vehicles' longest sentence, beside a bare snprintf of
// the same fields, which leaves the checksum out.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <random>
#include <vector>

#include "allocations.h"
#include "frontseat_driver/protocol/message.h"

namespace frontseat_driver::bench {
namespace {

constexpr std::size_t kValues = 1024;

/// Values that no branch predictor learns by heart.
std::vector<double> values(double low, double high) {
  std::mt19937_64 random{2016};
  std::vector<double> out(kValues);
  for (double& value : out) value = std::uniform_real_distribution<double>{low, high}(random);
  return out;
}

struct Clock {
  explicit Clock(double time_s) {
    const auto ms = static_cast<unsigned>(time_s * 1e3);
    hour = ms / 3'600'000;
    minute = ms / 60'000 % 60;
    second = ms / 1000 % 60;
    part = ms % 1000;
  }
  unsigned hour, minute, second, part;
};

nmea::TimeOfDay timeOfDay(double time_s) {
  return nmea::TimeOfDay{static_cast<std::int64_t>(time_s * 1e6)};
}

struct Behavior {
  static constexpr const char* kName = "BPRMB";
  static std::size_t encode(double time_s, double value) {
    protocol::bluefin::BehaviorChange out;
    out.sent_at = timeOfDay(time_s);
    out.horizontal = value;
    out.vertical = value / 10.0;
    out.vertical_mode = protocol::bluefin::BehaviorChange::VerticalMode::Depth;
    out.speed = value / 200.0;
    out.speed_mode = protocol::bluefin::BehaviorChange::SpeedMode::Speed;
    out.horizontal_mode = protocol::bluefin::BehaviorChange::HorizontalMode::Heading;
    return protocol::write(out).finish()->size();
  }
  static int print(char* text, std::size_t size, double time_s, double value) {
    const Clock c{time_s};
    return std::snprintf(text, size, "$BPRMB,%02u%02u%02u.%03u,%.4f,%.3f,%d,%.4f,%d,%d", c.hour,
                         c.minute, c.second, c.part, value, value / 10.0, 0, value / 200.0, 1, 0);
  }
};

struct Helm {
  static constexpr const char* kName = "PYDEP";
  static std::size_t encode(double, double value) {
    protocol::kingfisher::ThrustAndYawRate out;
    out.yaw_rate = value / 360.0;
    out.thrust_pct = value / 3.6;
    return protocol::write(out).finish()->size();
  }
  static int print(char* text, std::size_t size, double, double value) {
    return std::snprintf(text, size, "$PYDEP,%.4f,%.0f", value / 360.0, value / 3.6);
  }
};

struct Course {
  static constexpr const char* kName = "PYDEV";
  static std::size_t encode(double, double value) {
    protocol::kingfisher::HeadingAndSpeed out;
    out.heading_deg = value;
    out.speed_m_s = value / 200.0;
    return protocol::write(out).finish()->size();
  }
  static int print(char* text, std::size_t size, double, double value) {
    return std::snprintf(text, size, "$PYDEV,%.0f,%.4f", value, value / 200.0);
  }
};

struct Drive {
  static constexpr const char* kName = "PYDIR";
  static std::size_t encode(double, double value) {
    protocol::kingfisher::MotorThrust out;
    out.port_pct = value / 3.6;
    out.starboard_pct = -value / 3.6;
    return protocol::write(out).finish()->size();
  }
  static int print(char* text, std::size_t size, double, double value) {
    return std::snprintf(text, size, "$PYDIR,%.0f,%.0f", value / 3.6, -value / 3.6);
  }
};

struct Status {
  static constexpr const char* kName = "BPSTS";
  static std::size_t encode(double time_s, double) {
    protocol::bluefin::PayloadStatus out;
    out.sent_at = timeOfDay(time_s);
    out.ok = true;
    out.message = "OK";
    return protocol::write(out).finish()->size();
  }
  static int print(char* text, std::size_t size, double time_s, double) {
    const Clock c{time_s};
    return std::snprintf(text, size, "$BPSTS,%02u%02u%02u.%03u,%d,%s", c.hour, c.minute, c.second,
                         c.part, 1, "OK");
  }
};

struct Navigation {
  static constexpr const char* kName = "BFNVG";
  static std::size_t encode(double time_s, double value) {
    protocol::NavigationUpdate out;
    out.sent_at = timeOfDay(time_s);
    out.position = nmea::LatLon{value / 4.0, -value / 2.0};
    out.from_gps = true;
    out.altitude_m = value / 10.0;
    out.depth_m = value / 20.0;
    out.heading_deg = value;
    out.roll_deg = -value / 36.0;
    out.pitch_deg = value / 36.0;
    out.computed_at = timeOfDay(time_s);
    return protocol::write("BF", out).finish()->size();
  }
  static int print(char* text, std::size_t size, double time_s, double value) {
    const Clock c{time_s};
    const double lat = value / 4.0;
    const double lon = value / 2.0;
    const int lat_deg = static_cast<int>(lat);
    const int lon_deg = static_cast<int>(lon);
    return std::snprintf(
        text, size,
        "$BFNVG,%02u%02u%02u.%03u,%02d%09.6f,%c,%03d%09.6f,%c,%d,%.3f,%.3f,%.4f,%.4f,%.4f,"
        "%02u%02u%02u.%03u",
        c.hour, c.minute, c.second, c.part, lat_deg, (lat - lat_deg) * 60.0, 'N', lon_deg,
        (lon - lon_deg) * 60.0, 'W', 1, value / 10.0, value / 20.0, value, -value / 36.0,
        value / 36.0, c.hour, c.minute, c.second, c.part);
  }
};

template <class Run>
void measure(benchmark::State& state, Run run) {
  static const std::vector<double> kTimes_s = values(0.0, 86399.0);
  static const std::vector<double> kNumbers = values(0.0, 359.0);
  const std::size_t before = allocations();
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(run(kTimes_s[i % kValues], kNumbers[i % kValues]));
    ++i;
  }
  state.counters["allocations"] = static_cast<double>(allocations() - before) / double(i);
}

template <class Sentence>
void encode(benchmark::State& state) {
  measure(state, [](double time_s, double value) { return Sentence::encode(time_s, value); });
}

template <class Sentence>
void print(benchmark::State& state) {
  measure(state, [](double time_s, double value) {
    char text[256];
    const int size = Sentence::print(text, sizeof text, time_s, value);
    benchmark::DoNotOptimize(text);
    return size;
  });
}

template <class Sentence>
void add() {
  const std::string name = std::string{"encode/"} + Sentence::kName;
  benchmark::RegisterBenchmark((name + "/this_writer").c_str(), encode<Sentence>);
  benchmark::RegisterBenchmark((name + "/snprintf").c_str(), print<Sentence>);
}

[[maybe_unused]] const bool kAdded = [] {
  add<Behavior>();
  add<Helm>();
  add<Course>();
  add<Drive>();
  add<Status>();
  add<Navigation>();
  return true;
}();

}  // namespace
}  // namespace frontseat_driver::bench
