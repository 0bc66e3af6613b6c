#include <ros/init.h>

#include "subscriber.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "subscriber");
  const frontseat_driver::bench::Subscriber subscriber{ros::NodeHandle{}, ros::NodeHandle{"~"}};
  ros::spin();
}
