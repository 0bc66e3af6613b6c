#include <nodelet/loader.h>
#include <ros/init.h>
#include <ros/names.h>
#include <ros/this_node.h>

#include <csignal>

// Leaves as Ctrl-C does: zero thrust, orderly close. roscpp by itself handles SIGINT only.
void onTerminate(int) { ros::requestShutdown(); }

int main(int argc, char** argv) {
  ros::init(argc, argv, "nmea_node");
  std::signal(SIGTERM, onTerminate);
  nodelet::Loader loader{false};
  const nodelet::V_string no_arguments;
  if (!loader.load(ros::this_node::getName(), "frontseat_driver/NmeaNodelet",
                   ros::names::getRemappings(), no_arguments)) {
    return 1;
  }
  ros::spin();
  return 0;
}
