#include <nodelet/nodelet.h>
#include <ros/init.h>

#include <memory>
#include <pluginlib/class_list_macros.hpp>

#include "blueye/bridge.h"
#include "blueye/protobuf_log.h"

namespace frontseat_driver::ros_layer::blueye_layer {

/// frontseat_driver/BlueyeNodelet: one Blueye drone.
class BlueyeNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    // After an interrupted wait for the master nothing can be advertised; publishing would abort.
    if (ros::isShuttingDown()) return;
    throttleProtobufLog();
    XmlRpc::XmlRpcValue values;
    getPrivateNodeHandle().getParam(getPrivateNodeHandle().getNamespace(), values);
    try {
      const Parameters parameters = readParameters(values);
      for (const std::string& warning : unknownParameterWarnings(values)) {
        ROS_WARN("%s: %s", getName().c_str(), warning.c_str());
      }
      bridge_ =
          std::make_unique<Bridge>(getNodeHandle(), getPrivateNodeHandle(), getName(), parameters);
    } catch (const ParameterError& error) {
      ROS_FATAL("%s: %s", getName().c_str(), error.what());
      throw;
    }
  }

  std::unique_ptr<Bridge> bridge_;
};

}  // namespace frontseat_driver::ros_layer::blueye_layer

PLUGINLIB_EXPORT_CLASS(frontseat_driver::ros_layer::blueye_layer::BlueyeNodelet, nodelet::Nodelet)
