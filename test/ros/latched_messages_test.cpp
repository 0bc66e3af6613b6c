#include "latched_messages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/make_shared.hpp>

namespace frontseat_driver::ros_layer {
namespace {

using testing::HasSubstr;

ros::M_stringPtr connectionTo(const std::string& node, const char* latching,
                              const std::string& topic = "/boat/cmd_drive") {
  const auto header = boost::make_shared<ros::M_string>();
  *header = {{"topic", topic}, {"callerid", node}, {"latching", latching}};
  return header;
}

TEST(LatchedMessages, AreRefusedFromWhoWasThereBefore) {
  LatchedMessages messages{{{"/boat/cmd_drive", "/old"}}};
  const auto connection = connectionTo("/old", "1");
  EXPECT_THAT(messages.refusal(connection), HasSubstr("/old latches"));
  EXPECT_EQ(messages.refusal(connection), "") << "published since";
  EXPECT_EQ(messages.refusal(connectionTo("/old", "1", "/boat/cmd_vel")), "") << "another topic";
}

TEST(LatchedMessages, AreRefusedAfterAConnectionWasMadeAgain) {
  LatchedMessages messages{{}};
  EXPECT_EQ(messages.refusal(connectionTo("/new", "1")), "") << "published since it came";
  EXPECT_THAT(messages.refusal(connectionTo("/new", "1")), HasSubstr("/new latches"));
  const auto third = connectionTo("/new", "1");
  EXPECT_NE(messages.refusal(third), "");
  EXPECT_EQ(messages.refusal(third), "");
}

TEST(LatchedMessages, AreNoneOfWhoDoesNotLatch) {
  LatchedMessages messages{{{"/boat/cmd_drive", "/old"}}};
  EXPECT_EQ(messages.refusal(connectionTo("/old", "0")), "");
  EXPECT_EQ(messages.refusal(connectionTo("/old", "0")), "");
  EXPECT_EQ(messages.refusal(boost::make_shared<ros::M_string>()), "");
  EXPECT_EQ(messages.refusal(nullptr), "");
}

}  // namespace
}  // namespace frontseat_driver::ros_layer
