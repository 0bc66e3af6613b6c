// What follows the decoding: the session's step, and the messages made of what it tells.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "allocations.h"
#include "frontseat_driver/session/nmea_session.h"
#include "message_builder.h"
#include "mix.h"

namespace frontseat_driver::bench {
namespace {

using ros_layer::MessageBuilder;

constexpr std::size_t kRead = 4096;
constexpr std::size_t kSentences = 20'000;

/// Takes everything a session says, and does nothing.
class Nobody : public session::Output {
 public:
  bool send(const session::Now&, std::string_view) override { return true; }
  void heard(const session::Now&, std::string_view line) override { bytes += line.size(); }
  void event(const session::Now&, const vehicle::Event&) override { ++events; }
  void confirmed() override {}

  std::size_t bytes = 0;
  std::size_t events = 0;
};

/// A steady clock that goes on by a millisecond at each look.
class Clock {
 public:
  session::Now now() {
    now_.steady += std::chrono::milliseconds{1};
    now_.utc += std::chrono::milliseconds{1};
    now_.stamp += std::chrono::milliseconds{1};
    return now_;
  }

 private:
  session::Now now_{session::SteadyTime{std::chrono::hours{1}}, std::chrono::hours{400'000},
                    std::chrono::hours{400'000}};
};

void perSentence(benchmark::State& state, double sentences, std::size_t allocated) {
  state.counters["ns"] = benchmark::Counter(
      sentences * 1e-9, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["allocations"] = static_cast<double>(allocated) / sentences;
}

void session(benchmark::State& state) {
  const Sample mix = vehicleMix(kSentences);
  session::NmeaOptions options;
  options.dialect = protocol::Dialect::Kingfisher;
  session::NmeaSession session{options};
  Nobody out;
  Clock clock;
  session.connected(clock.now(), out);
  session.step(clock.now(), out);
  const std::size_t before = allocations();
  for (auto _ : state) {
    for (std::string_view left = mix.bytes; !left.empty();
         left.remove_prefix(std::min(kRead, left.size()))) {
      const session::Now now = clock.now();
      session.receive(now, left.substr(0, kRead), out);
      session.step(now, out);
    }
  }
  perSentence(state, static_cast<double>(state.iterations()) * kSentences, allocations() - before);
}

vehicle::Navigation navigation() {
  vehicle::Navigation out;
  out.measured_at = vehicle::TimeOfDay{std::chrono::hours{12}};
  out.position = vehicle::Position{42.361851, -71.090809};
  out.from_gps = true;
  out.altitude_m = 12.5;
  out.depth_m = 3.25;
  out.heading_deg = 234.3296;
  out.roll_deg = -6.797;
  out.pitch_deg = -1.7068;
  return out;
}

vehicle::Velocity velocity() {
  vehicle::Velocity out;
  out.measured_at = vehicle::TimeOfDay{std::chrono::hours{12}};
  out.east_m_s = 0.0294;
  out.north_m_s = -0.0686;
  out.down_m_s = 0.0;
  out.roll_rate_deg_s = out.pitch_rate_deg_s = out.yaw_rate_deg_s = 0.06;
  return out;
}

/// `make` is called with the builder and the time for every message.
template <class Make>
void convert(benchmark::State& state, Make make) {
  ros_layer::Parameters parameters;
  parameters.session.dialect = static_cast<protocol::Dialect>(state.range(0));
  MessageBuilder builder{parameters};
  Clock clock;
  builder.take(navigation(), clock.now());
  builder.take(velocity(), clock.now());
  const std::size_t before = allocations();
  for (auto _ : state) make(builder, clock.now());
  perSentence(state, static_cast<double>(state.iterations()), allocations() - before);
}

void odometry(benchmark::State& state) {
  convert(state, [](MessageBuilder& builder, const session::Now& now) {
    builder.take(navigation(), now);
    const auto message = builder.odometry();
    benchmark::DoNotOptimize(message->pose.pose.position.x);
  });
}

void odometryAndTransform(benchmark::State& state) {
  convert(state, [](MessageBuilder& builder, const session::Now& now) {
    builder.take(navigation(), now);
    const auto message = builder.odometry();
    const auto transform = builder.transform(*message);
    benchmark::DoNotOptimize(transform.has_value());
  });
}

void imu(benchmark::State& state) {
  convert(state, [](MessageBuilder& builder, const session::Now& now) {
    builder.take(velocity(), now);
    const auto message = builder.imu();
    benchmark::DoNotOptimize(message->orientation.x);
  });
}

constexpr auto kSandshark = static_cast<int>(protocol::Dialect::Sandshark);
constexpr auto kKingfisher = static_cast<int>(protocol::Dialect::Kingfisher);

BENCHMARK(session)->Unit(benchmark::kMillisecond);
BENCHMARK(odometry)->ArgName("dialect")->Arg(kSandshark)->Arg(kKingfisher);
BENCHMARK(odometryAndTransform)->ArgName("dialect")->Arg(kKingfisher);
BENCHMARK(imu)->ArgName("dialect")->Arg(kKingfisher);

}  // namespace
}  // namespace frontseat_driver::bench
