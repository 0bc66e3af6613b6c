#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <string>

#include "capture_player.h"
#include "capture_times.h"
#include "convert.h"
#include "frontseat_driver/capture/text_reader.h"

// Publishes a text capture on nmea/replay, for a driver with source: topic.

namespace frontseat_driver::ros_layer {
namespace {

/// What the user wants.
struct Wishes {
  std::string capture;
  double rate = 1.0;
  CaptureTimes::Start start;
};

Wishes readWishes(const ros::NodeHandle& own) {
  Wishes wishes;
  if (!own.getParam("capture", wishes.capture)) {
    throw std::invalid_argument{
        "parameter capture is missing; the path of a text file is accepted"};
  }
  own.param("rate", wishes.rate, wishes.rate);
  if (!(wishes.rate >= 0.0)) {
    throw std::invalid_argument{"parameter rate is " + std::to_string(wishes.rate) +
                                "; a number above 0 is accepted, or 0: as fast as possible"};
  }
  const auto text = own.param<std::string>("start", "2000-01-01");
  const auto start = CaptureTimes::readStart(text);
  if (!start) {
    throw std::invalid_argument{"parameter start is '" + text +
                                "'; a date such as 2014-11-19 or a time such as "
                                "2014-11-19T14:30:00Z is accepted"};
  }
  wishes.start = *start;
  return wishes;
}

capture::TextReader open(const std::string& path) {
  return capture::TextReader{capture::FileSource::open(path)};
}

void play(const Wishes& wishes, CapturePlayer& player) {
  capture::TextReader ahead = open(wishes.capture);
  CaptureTimes times{firstTime(ahead), wishes.start};
  capture::TextReader lines = open(wishes.capture);
  if (!player.awaitListener()) return;
  while (const auto entry = lines.next()) {
    if (entry->direction == capture::Direction::ToVehicle) continue;
    Sentence sentence;
    sentence.header.stamp = toRosTime(times.timeOf(*entry));
    sentence.sentence = std::string{entry->line};
    if (!player.play(sentence)) return;
  }
  player.finish();
  ROS_INFO("%lu lines of %s were played", static_cast<unsigned long>(player.played()),
           wishes.capture.c_str());
}

}  // namespace
}  // namespace frontseat_driver::ros_layer

int main(int argc, char** argv) {
  using namespace frontseat_driver::ros_layer;
  ros::init(argc, argv, "nmea_replay");
  try {
    ros::NodeHandle node;
    const Wishes wishes = readWishes(ros::NodeHandle{"~"});
    CapturePlayer player{node, wishes.rate};
    ros::AsyncSpinner echo{1};
    echo.start();
    play(wishes, player);
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return EXIT_FAILURE;
  }
}
