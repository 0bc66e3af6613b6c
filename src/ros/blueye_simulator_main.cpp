#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "frontseat_driver/sim/blueye/parameters.h"
#include "simulator_arguments.h"
#include "simulator_ros.h"

namespace frontseat_driver::sim {
namespace {

using Values = std::vector<std::pair<std::string, std::string>>;

/// Where the drone is in the end, also when the system has chosen the ports.
const std::vector<std::string> kActualPorts{"actual_telemetry_port", "actual_request_port",
                                            "actual_control_port", "actual_http_port"};

SimulatorProgram program() {
  return {"blueye_simulator", "Simulated Blueye drone: protobuf over ZeroMQ, and drone_info.",
          helpOf(blueyeParameters())};
}

/// Port 80 is the one parameter whose standard value not everybody may have.
BlueyeSimulatorConfig standard() {
  BlueyeSimulatorConfig config;
  config.server.http_optional = true;
  return config;
}

/// What cannot be used, in one line.
std::optional<std::string> takeValues(const Values& values, BlueyeSimulatorConfig& config) {
  for (const auto& [name, value] : values) {
    if (name == "http_port") config.server.http_optional = false;
    if (auto wrong = setParameter(blueyeParameters(), config, name, value)) return wrong;
  }
  return std::nullopt;
}

int fail(const std::string& line) {
  std::cerr << line << std::endl;
  return EXIT_FAILURE;
}

std::unique_ptr<BlueyeServer> listen(BlueyeSimulatorConfig config, BlueyeServer::OnTruth on_truth) {
  config.drone.start_time =
      std::chrono::duration_cast<UtcTime>(std::chrono::system_clock::now().time_since_epoch());
  auto server = std::make_unique<BlueyeServer>(config.drone, config.server, std::move(on_truth));
  std::cout << "a Blueye drone on " << config.server.bind << ": telemetry "
            << server->telemetryPort() << ", requests " << server->requestPort() << ", control "
            << server->controlPort() << ", http " << server->httpPort() << std::endl;
  if (!server->httpProblem().empty()) {
    std::cerr << server->httpProblem()
              << ": clients that ask for drone_info first will not connect; set http_port, or run"
                 " with the privilege to listen on port 80"
              << std::endl;
  }
  return server;
}

int runAlone(const SimulatorArguments& arguments) {
  BlueyeSimulatorConfig config = standard();
  if (const auto wrong = takeValues(arguments.values, config)) return fail(*wrong);
  sigset_t ending;
  sigemptyset(&ending);
  sigaddset(&ending, SIGINT);
  sigaddset(&ending, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &ending, nullptr);  // before the server's threads begin
  const auto server = listen(config, {});
  server->start();
  int signal = 0;
  sigwait(&ending, &signal);
  server->stop();
  return EXIT_SUCCESS;
}

void tellPorts(ros::NodeHandle& node, const BlueyeServer& server) {
  const std::uint16_t ports[] = {server.telemetryPort(), server.requestPort(), server.controlPort(),
                                 server.httpPort()};
  // The telemetry port comes last: whoever waits for it finds the others.
  for (std::size_t i = kActualPorts.size(); i-- > 0;) {
    node.deleteParam(kActualPorts[i]);
    node.setParam(kActualPorts[i], static_cast<int>(ports[i]));
  }
}

ros::ServiceServer offerReboot(ros::NodeHandle& node, BlueyeServer& server) {
  const boost::function<bool(std_srvs::Trigger::Request&, std_srvs::Trigger::Response&)> callback =
      [&server](auto&, auto& response) {
        server.post([](BlueyeDrone& drone) { drone.reboot(); });
        response.success = true;
        return true;
      };
  return node.advertiseService("reboot", callback);
}

int runNode(const SimulatorArguments& arguments) {
  std::signal(SIGTERM, [](int) { ros::requestShutdown(); });
  ros::NodeHandle node{"~"};
  BlueyeSimulatorConfig config = standard();
  const Values values = privateParameters(node, program().parameters, kActualPorts);
  if (const auto wrong = takeValues(values, config)) return fail(*wrong);
  if (const auto wrong = takeValues(arguments.values, config)) return fail(*wrong);
  SimulatorNode truth{node};
  const auto server = listen(config, [&truth](const Truth& now) { truth.publish(now); });
  const ros::ServiceServer reboot = offerReboot(node, *server);
  server->start();
  tellPorts(node, *server);
  ros::spin();
  server->stop();
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace frontseat_driver::sim

int main(int argc, char** argv) {
  using namespace frontseat_driver::sim;
  const SimulatorArguments all = parseArguments(program(), {argv + 1, argv + argc});
  if (all.ended) return all.exit_code;
  try {
    if (!all.with_ros) return runAlone(all);
    ros::init(argc, argv, "blueye_simulator");
    // Private parameters are on the parameter server now; what is left are options.
    return runNode(parseArguments(program(), {argv + 1, argv + argc}));
  } catch (const std::exception& error) {
    return fail(error.what());
  }
}
