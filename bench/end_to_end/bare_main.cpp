#include <ros/init.h>

#include "bare_publisher.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "bare");
  const frontseat_driver::bench::BarePublisher bare{ros::NodeHandle{}, ros::NodeHandle{"~"}};
  ros::spin();
}
