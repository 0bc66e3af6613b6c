#include <ros/ros.h>

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

#include "frontseat_driver/sim/simulator_config.h"
#include "simulator_arguments.h"
#include "simulator_ros.h"

namespace frontseat_driver::sim {
namespace {

SimulatorProgram program() {
  return {"nmea_simulator",
          "Simulated vehicle with the NMEA interface of a Sandshark or a Kingfisher.",
          helpOf(simulatorParameters())};
}

/// What cannot be used, in one line.
std::optional<std::string> takeValues(
    const std::vector<std::pair<std::string, std::string>>& values, SimulatorConfig& config) {
  for (const auto& [name, value] : values) {
    if (auto wrong = setParameter(config, name, value)) return wrong;
  }
  return std::nullopt;
}

int fail(const std::string& line) {
  std::cerr << line << std::endl;
  return EXIT_FAILURE;
}

std::unique_ptr<SimulatorServer> listen(const SimulatorConfig& config,
                                        SimulatorServer::OnTruth on_truth) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  auto server = std::make_unique<SimulatorServer>(
      makeFrontseat(config, std::chrono::duration_cast<UtcTime>(now)), config.server,
      std::move(on_truth));
  const bool ipv6 = config.server.bind.find(':') != std::string::npos;
  std::cout << "listening on " << (ipv6 ? "[" : "") << config.server.bind << (ipv6 ? "]" : "")
            << ":" << server->port() << " as " << protocol::toString(config.dialect) << std::endl;
  return server;
}

int runAlone(const SimulatorArguments& arguments) {
  SimulatorConfig config;
  if (const auto wrong = takeValues(arguments.values, config)) return fail(*wrong);
  if (const auto wrong = findContradiction(config)) return fail(*wrong);
  sigset_t ending;
  sigemptyset(&ending);
  sigaddset(&ending, SIGINT);
  sigaddset(&ending, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &ending, nullptr);  // before the server's thread begins
  const auto server = listen(config, {});
  server->start();
  int signal = 0;
  sigwait(&ending, &signal);
  server->stop();
  return EXIT_SUCCESS;
}

int runNode(const SimulatorArguments& arguments) {
  std::signal(SIGTERM, [](int) { ros::requestShutdown(); });
  const ros::NodeHandle node{"~"};
  SimulatorConfig config;
  const auto values = privateParameters(node, program().parameters, SimulatorNode::ownParameters());
  if (const auto wrong = takeValues(values, config)) return fail(*wrong);
  if (const auto wrong = takeValues(arguments.values, config)) return fail(*wrong);
  if (const auto wrong = findContradiction(config)) return fail(*wrong);
  SimulatorNode truth{node};
  const auto server = listen(config, [&truth](const Truth& now) { truth.publish(now); });
  truth.offerControls(*server, config.dialect);
  server->start();
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
    ros::init(argc, argv, "nmea_simulator");
    // Private parameters are on the parameter server now; what is left are options.
    return runNode(parseArguments(program(), {argv + 1, argv + argc}));
  } catch (const std::exception& error) {
    return fail(error.what());
  }
}
