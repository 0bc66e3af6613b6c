#include "nmea_nodelet.h"

#include <ros/init.h>

#include <pluginlib/class_list_macros.hpp>

#include "parameters.h"

namespace frontseat_driver::ros_layer {

void NmeaNodelet::onInit() {
  // After an interrupted wait for the master nothing can be advertised; publishing would abort.
  if (ros::isShuttingDown()) return;
  XmlRpc::XmlRpcValue values;
  getPrivateNodeHandle().getParam(getPrivateNodeHandle().getNamespace(), values);
  try {
    const Parameters parameters = readParameters(values);
    for (const std::string& warning : unknownParameterWarnings(values)) {
      ROS_WARN("%s: %s", getName().c_str(), warning.c_str());
    }
    bridge_ = std::make_unique<NmeaBridge>(getNodeHandle(), getPrivateNodeHandle(), getName(),
                                           parameters);
  } catch (const ParameterError& error) {
    ROS_FATAL("%s: %s", getName().c_str(), error.what());
    throw;
  }
}

}  // namespace frontseat_driver::ros_layer

PLUGINLIB_EXPORT_CLASS(frontseat_driver::ros_layer::NmeaNodelet, nodelet::Nodelet)
