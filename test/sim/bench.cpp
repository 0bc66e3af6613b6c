#include "bench.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "frontseat_driver/nmea/sentence.h"

namespace frontseat_driver::sim {

std::string sentence(const std::string& body) {
  std::array<char, 8> end{};
  std::snprintf(end.data(), end.size(), "*%02X\r\n", nmea::checksum(body));
  return "$" + body + end.data();
}

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> all;
  std::istringstream in{line.substr(1, line.rfind('*') - 1)};
  for (std::string field; std::getline(in, field, ',');) all.push_back(field);
  if (line.find(",*") != std::string::npos) all.emplace_back();
  return all;
}

Bench::Bench(const SandsharkConfig& config)
    : frontseat_(std::make_unique<SandsharkFrontseat>(config)), now_(config.start_time) {}

Bench::Bench(const KingfisherConfig& config)
    : frontseat_(std::make_unique<KingfisherFrontseat>(config)), now_(config.start_time) {}

void Bench::bytes(ClientId client, const std::string& text) {
  frontseat_->clientBytes(client, text, now_);
}

void Bench::run(double s) {
  const UtcTime end = now_ + std::chrono::milliseconds{std::lround(s * 1e3)};
  for (frontseat_->step(now_, *this); now_ < end;) {
    now_ += std::chrono::milliseconds{10};
    frontseat_->step(now_, *this);
  }
}

std::string Bench::heardBytes(ClientId client) { return std::exchange(heard_[client], {}); }

std::vector<std::string> Bench::heard(ClientId client, std::string_view address) {
  std::vector<std::string> lines;
  std::istringstream in{heardBytes(client)};
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (address.empty() || line.compare(1, address.size(), address) == 0) lines.push_back(line);
  }
  return lines;
}

SandsharkConfig runningSandshark() {
  SandsharkConfig config;
  config.start_time = kNoon;
  config.noise = false;
  config.mission.ready_s = 0.0;
  config.mission.legs = {{{0.0, 5000.0}, 0.0, Setpoint::VerticalMode::Depth, 1.5}};
  return config;
}

KingfisherConfig restingKingfisher() {
  KingfisherConfig config;
  config.start_time = kNoon;
  config.noise = false;
  config.waves_deg = 0.0;
  config.loop.clear();
  return config;
}

std::vector<PlanePoint> usualLoop() {
  const KingfisherConfig usual;
  return usual.loop;
}

}  // namespace frontseat_driver::sim
