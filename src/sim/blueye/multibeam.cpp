#include "multibeam.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "frontseat_driver/sim/angles.h"

namespace frontseat_driver::sim {
namespace {

constexpr double kSpeedOfSound = 1480.0;
constexpr double kFrequency_hz = 750e3;
constexpr double kHighFrequency_hz = 1.2e6;
constexpr double kAperture_deg = 130.0;
constexpr double kDefaultRange_m = 20.0;
constexpr double kTilt_rad = 0.25;  // it looks a little down
constexpr std::uint32_t kStep = 1;  // bytes of one sample

struct Rate {
  bp::MultibeamConfig::PingRate rate;
  double hz;
};
constexpr Rate kRates[] = {
    {bp::MultibeamConfig::PING_RATE_NORMAL, 10.0},  {bp::MultibeamConfig::PING_RATE_HIGH, 15.0},
    {bp::MultibeamConfig::PING_RATE_HIGHEST, 40.0}, {bp::MultibeamConfig::PING_RATE_LOW, 5.0},
    {bp::MultibeamConfig::PING_RATE_LOWEST, 2.0},   {bp::MultibeamConfig::PING_RATE_STANDBY, 0.0}};

}  // namespace

BlueyeMultibeam::BlueyeMultibeam(const MultibeamSize& size, Random random)
    : size_(size), random_(random), active_(size.active_from_start) {
  config_.set_frequency_mode(bp::MULTIBEAM_FREQUENCY_MODE_LOW_FREQUENCY);
  config_.set_ping_rate(bp::MultibeamConfig::PING_RATE_NORMAL);
  config_.set_range(kDefaultRange_m);
  config_.set_gain(0.5);
  config_.set_gamma_correction(0.6);
  config_.set_maximum_number_of_beams(bp::MultibeamConfig::MAXIMUM_NUMBER_OF_BEAMS_MAX_1024);
  config_.set_device_id(bp::GUEST_PORT_DEVICE_ID_BLUEPRINT_SUBSEA_OCULUS_M750D);
  const std::size_t image = std::size_t{size.beams} * size.ranges;
  speckle_.resize(image + 4096);
  std::uint32_t noise = static_cast<std::uint32_t>(random_.below(1U << 30)) | 1U;
  for (char& sample : speckle_) {
    noise = noise * 1664525U + 1013904223U;
    sample = static_cast<char>(noise >> 28);  // 0 to 15 of 255
  }
}

void BlueyeMultibeam::configure(const bp::MultibeamConfig& config) {
  const auto device = config_.device_id();
  config_ = config;
  if (config_.device_id() == bp::GUEST_PORT_DEVICE_ID_UNSPECIFIED) config_.set_device_id(device);
  if (!(config_.range() > 0.0)) config_.set_range(kDefaultRange_m);
}

double BlueyeMultibeam::rateHz() const {
  if (!active_) return 0.0;
  if (size_.rate_hz > 0.0) return size_.rate_hz;
  for (const Rate& row : kRates) {
    if (row.rate == config_.ping_rate()) return row.hz;
  }
  return kRates[0].hz;
}

std::uint32_t BlueyeMultibeam::beams() const {
  switch (config_.maximum_number_of_beams()) {
    case bp::MultibeamConfig::MAXIMUM_NUMBER_OF_BEAMS_MAX_128:
      return std::min(size_.beams, 128U);
    case bp::MultibeamConfig::MAXIMUM_NUMBER_OF_BEAMS_MAX_256:
      return std::min(size_.beams, 256U);
    case bp::MultibeamConfig::MAXIMUM_NUMBER_OF_BEAMS_MAX_512:
      return std::min(size_.beams, 512U);
    default:
      return size_.beams;
  }
}

bp::MultibeamPing BlueyeMultibeam::ping(vehicle::UtcTime clock, double altitude_m, double pitch_rad,
                                        bool bearings_in_degrees) {
  const std::uint32_t width = beams();
  bp::MultibeamPing ping;
  ping.set_range(config_.range());
  ping.set_gain(config_.gain());
  const bool high = config_.frequency_mode() == bp::MULTIBEAM_FREQUENCY_MODE_HIGH_FREQUENCY;
  ping.set_frequency(high ? kHighFrequency_hz : kFrequency_hz);
  ping.set_speed_of_sound_used(kSpeedOfSound);
  ping.set_frequency_mode(config_.frequency_mode());
  ping.set_number_of_ranges(size_.ranges);
  ping.set_number_of_beams(width);
  ping.set_step(kStep);
  ping.set_device_id(config_.device_id());
  ping.mutable_frame_generation_timestamp()->set_seconds(clock.count() / 1000000000);
  ping.mutable_frame_generation_timestamp()->set_nanos(
      static_cast<std::int32_t>(clock.count() % 1000000000));
  const std::size_t image = std::size_t{width} * size_.ranges;
  std::string data = speckle_.substr(random_.below(4096), image);
  // The bottom begins where a beam meets it: the same slant range for all beams near the middle.
  const double down = std::sin(std::max(0.02, kTilt_rad - pitch_rad));
  const double bottom_m = altitude_m / down;
  if (bottom_m < config_.range()) {
    const auto row = static_cast<std::size_t>(bottom_m / config_.range() * size_.ranges);
    if (row < size_.ranges) std::memset(&data[row * width], 200, width);
  }
  ping.set_ping_data(std::move(data));
  for (std::uint32_t beam = 0; beam < width; ++beam) {
    const double share = (beam + 0.5) / width - 0.5;
    const double degrees = kAperture_deg * share;
    ping.add_bearings(static_cast<float>(bearings_in_degrees ? degrees : 100.0 * degrees));
  }
  return ping;
}

}  // namespace frontseat_driver::sim
