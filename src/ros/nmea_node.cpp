#include <nodelet/loader.h>
#include <poll.h>
#include <ros/init.h>
#include <ros/names.h>
#include <ros/this_node.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdint>

namespace {

const int kEnding = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
std::atomic<bool> loaded{false};

// Before the nodelet is there, ROS may be waiting for its master, and nothing else can end that.
void onSignal(int) {
  if (!loaded) ros::requestShutdown();
  const std::uint64_t once = 1;
  [[maybe_unused]] const auto written = write(kEnding, &once, sizeof once);
}

// roscpp takes some 0.3 s from a signal to the end of ros::spin(), long enough for another command
// to the vehicle.
void waitForTheEnd() {
  constexpr int kLookForRosShutdown_ms = 50;
  pollfd signalled{kEnding, POLLIN, 0};
  while (ros::ok() && poll(&signalled, 1, kLookForRosShutdown_ms) <= 0) {
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
  // The terminal or the ssh session is gone; after nohup that is not to matter.
  if (std::signal(SIGHUP, onSignal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
  ros::init(argc, argv, NODE_NAME, ros::init_options::NoSigintHandler);
  {
    nodelet::Loader loader{false};
    const nodelet::V_string no_arguments;
    if (!loader.load(ros::this_node::getName(), NODELET_TYPE, ros::names::getRemappings(),
                     no_arguments)) {
      return 1;
    }
    loaded = true;
    waitForTheEnd();
  }
  ros::shutdown();
  return 0;
}
