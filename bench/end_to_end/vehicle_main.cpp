// A vehicle that does nothing but write sentences at a given rate. Prints its port, waits for its
// connections and for a line on standard input, writes, and prints what it did.
#include <linux/sockios.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <thread>

#include "frontseat_driver/protocol/message.h"
#include "write_times.h"

namespace frontseat_driver::bench {
namespace {

using Clock = std::chrono::steady_clock;

struct Options {
  int vehicles = 1;
  double rate_hz = 10.0;  ///< sentences of each vehicle; 0: as fast as they are taken
  int bundle = 1;         ///< sentences in one write
  long count = 100;       ///< sentences of each vehicle
  bool mix = false;       ///< all kinds, the first of each bundle and every `mix`-th a position
  std::string times;
};

void require(bool good, const char* what) {
  if (good) return;
  std::perror(what);
  std::exit(1);
}

std::string line(nmea::SentenceWriter out) { return std::string{out.finish().value()}; }

nmea::TimeOfDay timeOfDay() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<nmea::TimeOfDay>(now % std::chrono::hours{24});
}

/// A position that carries its number as its depth.
std::string navigation(std::size_t number) {
  protocol::NavigationUpdate out;
  out.sent_at = out.computed_at = timeOfDay();
  out.position = nmea::LatLon{42.361851, -71.090809};
  out.from_gps = true;
  out.altitude_m = 12.5;
  out.depth_m = static_cast<double>(number);
  out.heading_deg = 234.3296;
  out.roll_deg = -6.797;
  out.pitch_deg = -1.7068;
  return line(protocol::write("CP", out));
}

std::string other(std::size_t number) {
  const auto time = timeOfDay();
  switch (number % 6) {
    case 0: {
      protocol::VelocityUpdate out;
      out.sent_at = time;
      out.east_m_s = 0.0294;
      out.north_m_s = -0.0686;
      out.down_m_s = 0.0;
      out.pitch_rate_deg_s = 0.0609;
      out.roll_rate_deg_s = 0.0;
      out.yaw_rate_deg_s = -0.0611;
      return line(protocol::write("CP", out));
    }
    case 1: {
      protocol::kingfisher::RawImu out;
      out.sent_at = time;
      out.rate_x_deg_s = -0.061;
      out.rate_y_deg_s = -0.0001;
      out.rate_z_deg_s = -0.061;
      out.acceleration_x = -0.0269;
      out.acceleration_y = 0.1045;
      out.acceleration_z = -9.322;
      return line(protocol::write(out));
    }
    case 2: {
      protocol::kingfisher::RawCompass out;
      out.sent_at = out.measured_at = time;
      out.compass_id = 0;
      out.heading_deg = 234.3267;
      out.pitch_deg = -1.6556;
      out.roll_deg = -6.6286;
      return line(protocol::write(out));
    }
    case 3: {
      protocol::kingfisher::BatteryVoltage out;
      out.sent_at = time;
      out.stack_v = out.lowest_cell_v = out.highest_cell_v = 15.0918;
      out.temperature_c = 21.0;
      return line(protocol::write(out));
    }
    case 4: {
      protocol::gps::MinimumData out;
      out.measured_at = time;
      out.valid = true;
      out.position = nmea::LatLon{42.361851, -71.090809};
      out.speed_kn = 0.145;
      out.course_deg = 156.78;
      out.date = nmea::Date{2014, 12, 31};
      return line(protocol::write("GP", out));
    }
    default: {
      protocol::gps::Fix out;
      out.measured_at = time;
      out.position = nmea::LatLon{42.361851, -71.090809};
      out.quality = 1;
      out.satellites = 6;
      out.hdop = 2.8;
      out.altitude_m = 46.6;
      out.geoid_separation_m = -33.2;
      return line(protocol::write("GP", out));
    }
  }
}

int listenOnAnyPort() {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  require(bind(socket, reinterpret_cast<sockaddr*>(&address), size) == 0, "bind");
  require(listen(socket, 1024) == 0, "listen");
  getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
  std::printf("port %d\n", ntohs(address.sin_port));
  std::fflush(stdout);
  return socket;
}

void writeAll(int socket, const std::string& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t size = send(socket, bytes.data() + done, bytes.size() - done, MSG_NOSIGNAL);
    require(size > 0, "send");
    done += static_cast<std::size_t>(size);
  }
}

/// Until the other side's kernel has everything.
void waitUntilTaken(int socket) {
  for (int left = 1; left > 0;) {
    ioctl(socket, SIOCOUTQ, &left);
    if (left > 0) std::this_thread::sleep_for(std::chrono::milliseconds{1});
  }
}

void run(const Options& options) {
  const auto total =
      static_cast<std::size_t>(options.vehicles) * static_cast<std::size_t>(options.count);
  WriteTimes times{options.times, total};
  const int listener = listenOnAnyPort();
  std::vector<int> sockets;
  for (int i = 0; i < options.vehicles; ++i) {
    sockets.push_back(accept(listener, nullptr, nullptr));
    const int on = 1;
    require(setsockopt(sockets.back(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on) == 0, "no delay");
    writeAll(sockets.back(), other(0));  // tells the dialect
  }
  std::printf("connected\n");
  std::fflush(stdout);
  std::string go;
  std::getline(std::cin, go);
  const auto began = Clock::now();
  const std::chrono::duration<double> period{
      options.rate_hz > 0.0 ? options.bundle / options.rate_hz / options.vehicles : 0.0};
  long writes = 0;
  std::size_t number = 0;
  std::string bytes;
  for (long done = 0; done < options.count; done += options.bundle) {
    for (const int socket : sockets) {  // the vehicles one after the other, evenly spread
      if (options.rate_hz > 0.0) {
        std::this_thread::sleep_until(began + std::chrono::duration_cast<Clock::duration>(
                                                  period * static_cast<double>(writes)));
      }
      bytes.clear();
      const std::size_t first = number;
      for (int i = 0; i < options.bundle; ++i, ++number) {
        bytes += options.mix && number % 2 != 0 ? other(number / 2) : navigation(number);
      }
      for (std::size_t i = first; i < number; ++i) times.note(i);
      writeAll(socket, bytes);
      ++writes;
    }
  }
  for (const int socket : sockets) waitUntilTaken(socket);
  const double took = std::chrono::duration<double>(Clock::now() - began).count();
  std::printf("wrote %zu sentences in %.3f s\n", number, took);
  std::fflush(stdout);
  std::getline(std::cin, go);  // the connections stay until the end
}

}  // namespace
}  // namespace frontseat_driver::bench

int main(int argc, char** argv) {
  frontseat_driver::bench::Options options;
  CLI::App app{"Writes sentences at a given rate and notes when"};
  app.add_option("--vehicles", options.vehicles);
  app.add_option("--rate", options.rate_hz);
  app.add_option("--bundle", options.bundle);
  app.add_option("--count", options.count);
  app.add_flag("--mix", options.mix);
  app.add_option("--times", options.times)->required();
  CLI11_PARSE(app, argc, argv);
  frontseat_driver::bench::run(options);
}
