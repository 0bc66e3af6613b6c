#include "plot.h"

#include <unistd.h>

#include <cerrno>
#include <climits>
#include <string>
#include <system_error>

namespace frontseat_driver::decode {
namespace {

[[noreturn]] void fail(const std::string& what) {
  throw std::system_error(errno, std::generic_category(), what);
}

/// Where this program is, and what is installed with it.
std::string ownFolder() {
  char path[PATH_MAX];
  const ssize_t size = readlink("/proc/self/exe", path, sizeof path);
  if (size < 0) fail("/proc/self/exe");
  const std::string program{path, static_cast<std::size_t>(size)};
  return program.substr(0, program.rfind('/') + 1);
}

}  // namespace

void runPlot(const Options& options) {
  std::string program = ownFolder() + "nmea_plot";
  std::string input = options.input;
  std::string picture = options.plot;
  std::string vehicle = "--namespace=" + options.vehicle;
  char* const last = options.vehicle.empty() ? nullptr : vehicle.data();
  char* const arguments[] = {program.data(), input.data(), picture.data(), last, nullptr};
  execv(program.c_str(), arguments);
  fail(program);
}

}  // namespace frontseat_driver::decode
