#include <nodelet/nodelet.h>

#include <pluginlib/class_list_macros.hpp>

#include "bare_publisher.h"
#include "subscriber.h"

namespace frontseat_driver::bench {

template <class Part>
class PartNodelet : public nodelet::Nodelet {
  void onInit() override {
    part_ = std::make_unique<Part>(getNodeHandle(), getPrivateNodeHandle());
  }
  std::unique_ptr<Part> part_;
};

using BareNodelet = PartNodelet<BarePublisher>;
using SubscriberNodelet = PartNodelet<Subscriber>;

}  // namespace frontseat_driver::bench

PLUGINLIB_EXPORT_CLASS(frontseat_driver::bench::BareNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(frontseat_driver::bench::SubscriberNodelet, nodelet::Nodelet)
