// What the parameters of a Blueye accept.

#include "blueye/parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace frontseat_driver::ros_layer::blueye_layer {
namespace {

std::string errorOf(const std::string& host) {
  XmlRpc::XmlRpcValue parameters;
  parameters["host"] = host;
  try {
    readParameters(parameters);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(BlueyeHost, IsANameOrAnAddress) {
  for (const char* host : {"192.168.1.101", "localhost", "blueye-x3.local", "my_drone", "::1",
                           "[::1]", "fe80::1%eth0", "drone.example.org."}) {
    EXPECT_EQ(errorOf(host), "accepted") << host;
  }
}

TEST(BlueyeHost, IsRefusedWhenZeroMqWouldReadMoreIntoIt) {
  for (const char* host :
       {"tcp://192.168.1.101", "192.168.1.101:5555", "drone:5555", "a;b", "*", "a/b", "user@drone",
        "[::1]:5555", "[::1", "::1]", "::g", "", "two words", "d\xc3\xb8ne"}) {
    EXPECT_THAT(errorOf(host), testing::HasSubstr("a host name or an address")) << host;
  }
}

}  // namespace
}  // namespace frontseat_driver::ros_layer::blueye_layer
