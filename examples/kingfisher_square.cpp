// Drives a square: `cmd_vel` out, `odom` back. The same as kingfisher_square.py.
//
//     rosrun frontseat_driver kingfisher_square _side:=20 _speed:=1.0

#include <geometry_msgs/Twist.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>

#include <algorithm>
#include <cmath>
#include <csignal>

namespace {

constexpr double kRate_hz = 10.0;  // a command that is not repeated is stale after command_timeout
constexpr double kOldest_s = 1.0;  // without odom for longer we do not know where we are
constexpr double kGain = 0.8;      // rad/s of turn per rad of error
constexpr double kLeast = 0.2;     // of the speed; some boats do not turn without any thrust

volatile std::sig_atomic_t ended = 0;
void onSignal(int) { ended = 1; }

class Square {
 public:
  explicit Square(ros::NodeHandle node)
      : command_(node.advertise<geometry_msgs::Twist>("cmd_vel", 1)),
        // Without tcpNoDelay a message may be held back for some 40 ms.
        odom_(node.subscribe("odom", 1, &Square::take, this, ros::TransportHints().tcpNoDelay())) {}

  void run(double side_m, double speed_m_s, double reached_m) {
    while (going() && heard_.isZero()) wait();
    const double corners[][2] = {
        {x_ + side_m, y_}, {x_ + side_m, y_ + side_m}, {x_, y_ + side_m}, {x_, y_}};
    for (const auto& corner : corners) driveTo(corner[0], corner[1], speed_m_s, reached_m);
    // Sooner than by command_timeout, which stops the boat if this program is killed.
    send(0.0, 0.0);
    ros::WallDuration(0.1).sleep();  // it leaves on another thread
  }

 private:
  static bool going() { return ros::ok() && !ended; }

  // Not ros::Rate: the driver's time-outs run in real time, whatever /clock does.
  void wait() {
    rate_.sleep();
    ros::spinOnce();
  }

  void take(const nav_msgs::Odometry& odom) {
    const auto& q = odom.pose.pose.orientation;
    x_ = odom.pose.pose.position.x;
    y_ = odom.pose.pose.position.y;
    // Counter-clockwise from east. It is no compass heading.
    yaw_ = std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z));
    heard_ = ros::SteadyTime::now();
  }

  void driveTo(double x, double y, double speed_m_s, double reached_m) {
    for (; going(); wait()) {
      if ((ros::SteadyTime::now() - heard_).toSec() > kOldest_s) {
        send(0.0, 0.0);
        continue;
      }
      if (std::hypot(x - x_, y - y_) < reached_m) break;
      const double error = std::remainder(std::atan2(y - y_, x - x_) - yaw_, 2.0 * M_PI);
      send(speed_m_s * std::max(kLeast, std::cos(error)), kGain * error);
    }
    if (going()) ROS_INFO("corner at %.1f, %.1f", x, y);
  }

  void send(double ahead_m_s, double turn_rad_s) {
    geometry_msgs::Twist twist;
    twist.linear.x = ahead_m_s;
    twist.angular.z = turn_rad_s;
    command_.publish(twist);
  }

  ros::Publisher command_;
  ros::Subscriber odom_;
  ros::WallRate rate_{kRate_hz};
  double x_ = 0.0, y_ = 0.0, yaw_ = 0.0;
  ros::SteadyTime heard_;
};

}  // namespace

int main(int argc, char** argv) {
  // roscpp's own handler would end the publisher before the last command.
  ros::init(argc, argv, "kingfisher_square", ros::init_options::NoSigintHandler);
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
  const ros::NodeHandle own("~");
  Square(ros::NodeHandle())
      .run(own.param("side", 20.0), own.param("speed", 1.0), own.param("reached", 1.5));
  return 0;
}
