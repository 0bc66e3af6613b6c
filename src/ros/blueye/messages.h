#pragma once

#include <blueye/telemetry.pb.h>
#include <frontseat_driver/BlueyeAutoPilotReference.h>
#include <frontseat_driver/BlueyeBatteryDetails.h>
#include <frontseat_driver/BlueyeCalibrationState.h>
#include <frontseat_driver/BlueyeControlMode.h>
#include <frontseat_driver/BlueyeControllerHealth.h>
#include <frontseat_driver/BlueyeInfo.h>
#include <frontseat_driver/BlueyeMissionStatus.h>
#include <frontseat_driver/BlueyeNotification.h>
#include <frontseat_driver/BlueyePositionEstimate.h>
#include <frontseat_driver/BlueyeRecordState.h>
#include <frontseat_driver/BlueyeReference.h>
#include <frontseat_driver/Dvl.h>
#include <frontseat_driver/MagneticDeclination.h>
#include <frontseat_driver/MotionInput.h>
#include <frontseat_driver/MultibeamPing.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/FluidPressure.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/MagneticField.h>
#include <sensor_msgs/NavSatFix.h>
#include <sensor_msgs/Range.h>
#include <sensor_msgs/RelativeHumidity.h>
#include <sensor_msgs/Temperature.h>
#include <sensor_msgs/TimeReference.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Duration.h>
#include <std_msgs/Float64.h>

#include <optional>
#include <string>
#include <variant>

#include "conventions.h"
#include "frontseat_driver/vehicle/command.h"

/// Blueye telemetry into messages and commands back: the only place where its frames and units
/// change. Forward-right-down and north-east-down become FLU and ENU, degrees become radians. What
/// is absent, not valid or not finite gives nothing, or NaN and unknown variances where a message
/// needs a value; never zero.
namespace frontseat_driver::ros_layer::blueye_layer {

namespace pb = blueye::protocol;

/// What a conversion needs besides the message.
struct Context {
  ros::Time stamp;  ///< when it arrived
  const Conventions& conventions;
  const Deviations& deviations;
  std::string base_frame = "base_link";
  std::string odom_frame = "odom";

  std_msgs::Header header(const std::string& frame) const;
};

/// In (-pi, pi].
double wrap_rad(double angle_rad);

/// A heading clockwise from north as a yaw counter-clockwise from east, both rad.
double yawOf(double heading_rad);

/// A name of the protocol without the prefix that all names of its kind have.
std::string shortName(const std::string& name, const std::string& prefix);

/// Bytes as text if they can be printed, else in hexadecimal.
std::string printable(const std::string& bytes);

/// Roll, pitch and heading, degrees.
geometry_msgs::Quaternion orientationOf(const pb::Attitude& attitude, const Conventions& how);

/// A number that tells something: not 0, which the wire leaves out, nor NaN or infinite.
bool isPositive(double value);

/// Of each of two axes, from the radius that holds 95 percent; of an unknown one if it is 0.
double varianceOfRadius95(double radius_m);

bool isUsable(const pb::LatLongPosition& position);

/// The velocity of a DVL in FLU; empty without a valid beam.
std::optional<geometry_msgs::Vector3> velocityOf(const pb::DvlVelocity& dvl,
                                                 const Conventions& how);

/// Rates, and accelerations with `factor` (AccelerometerSense); what there is not has covariance
/// -1.
void fill(sensor_msgs::Imu& out, const pb::Imu& imu, const std::optional<double>& factor,
          const Context& context);

std::optional<geometry_msgs::PoseWithCovarianceStamped> toDepth(const pb::DepthTel&,
                                                                const Context&);
std::optional<sensor_msgs::FluidPressure> toPressure(const pb::DepthTel&, const Context&);
std::optional<sensor_msgs::Range> toAltitude(const pb::AltitudeTel&, const Context&);
std::optional<sensor_msgs::Range> toForwardDistance(const pb::ForwardDistanceTel&, const Context&);
std::optional<BlueyePositionEstimate> toEstimate(const pb::PositionEstimateTel&, const Context&);
std::optional<sensor_msgs::NavSatFix> toNavFix(const pb::PositionEstimateTel&,
                                               const std::optional<double>& depth_m,
                                               const Context&);
std::optional<geometry_msgs::TwistWithCovarianceStamped> toDvlTwist(const pb::DvlVelocityTel&,
                                                                    const Context&);
std::optional<Dvl> toDvl(const pb::DvlVelocityTel&, const Context&);
std::optional<sensor_msgs::MagneticField> toMagneticField(const pb::Imu&, const Context&);
std::optional<sensor_msgs::Temperature> toImuTemperature(const pb::CalibratedImuTel&,
                                                         const Context&);
std::optional<sensor_msgs::BatteryState> toBattery(const pb::Battery&, int number, const Context&);
std::optional<sensor_msgs::BatteryState> toBattery(const pb::BatteryBQ40Z50&, int number,
                                                   const Context&);
BlueyeBatteryDetails toBatteryDetails(const pb::BatteryBQ40Z50&, int number, const Context&);
std::optional<BlueyeControlMode> toControlMode(const pb::ControlModeTel&, const Context&);
std::optional<BlueyeInfo> toInfo(const pb::DroneInfoTel&, const Context&);
std::optional<sensor_msgs::TimeReference> toTimeReference(const pb::DroneTimeTel&, const Context&);
std::optional<BlueyeReference> toReference(const pb::ReferenceTel&, const Context&);
std::optional<BlueyeControllerHealth> toHealth(const pb::ControllerHealthTel&, const Context&);
std::optional<geometry_msgs::WrenchStamped> toWrench(const pb::ControlForceTel&, const Context&);
std::optional<MagneticDeclination> toDeclination(const pb::MagneticDeclinationTel&, const Context&);
std::optional<BlueyeMissionStatus> toMission(const pb::MissionStatusTel&, const Context&);
std::optional<BlueyeAutoPilotReference> toAutoPilot(const pb::ReferenceAutoPilotTel&,
                                                    const Context&);
std::optional<sensor_msgs::Temperature> toWaterTemperature(const pb::WaterTemperatureTel&,
                                                           const Context&);
std::optional<sensor_msgs::Temperature> toCpuTemperature(const pb::CPUTemperatureTel&,
                                                         const Context&);
std::optional<sensor_msgs::Temperature> toCanisterTemperature(
    const pb::CanisterBottomTemperatureTel&, const Context&);
std::optional<sensor_msgs::RelativeHumidity> toHumidity(const pb::CanisterBottomHumidityTel&,
                                                        const Context&);
std::optional<std_msgs::Float64> toLights(const pb::LightsTel&, const Context&);
std::optional<std_msgs::Float64> toGuestPortLights(const pb::GuestPortLightsTel&, const Context&);
std::optional<std_msgs::Float64> toLaser(const pb::LaserTel&, const Context&);
std::optional<sensor_msgs::JointState> toCameraTilt(const pb::TiltAngleTel&, const Context&);
std::optional<sensor_msgs::JointState> toServo(const pb::GenericServoTel&, const Context&);
std::optional<sensor_msgs::JointState> toMultibeamTilt(const pb::MultibeamServoTel&,
                                                       const Context&);
std::optional<std_msgs::Bool> toTiltStabilization(const pb::TiltStabilizationTel&, const Context&);
std::optional<BlueyeRecordState> toRecordState(const pb::RecordStateTel&, const Context&);
std::optional<sensor_msgs::NavSatFix> toPilotFix(const pb::PilotGPSPositionTel&, const Context&);
std::optional<BlueyeCalibrationState> toCalibration(const pb::CalibrationStateTel&, const Context&);
std::optional<std_msgs::Duration> toDiveTime(const pb::DiveTimeTel&, const Context&);
std::optional<MultibeamPing> toPing(const pb::MultibeamPingTel&, const Context&);
std::optional<sensor_msgs::BatteryState> toSurfaceUnit(const pb::SurfaceUnitTel&, const Context&);

/// Everything but the value.
BlueyeNotification toNotification(const pb::Notification&, const Context&);

/// A command in the drone's axes, or why it was refused: field, value and range.
using ConvertedMotion = std::variant<vehicle::DroneCommand, std::string>;

ConvertedMotion toCommand(const MotionInput& motion);

/// What full thrust gives, for `cmd_vel`.
struct FullSpeed {
  double surge_m_s = 1.0;
  double sway_m_s = 0.5;
  double heave_m_s = 0.5;
  double yaw_rate_rad_s = 1.0;
};

/// Each axis divided by its full speed and clamped; roll and pitch are not followed.
ConvertedMotion toCommand(const geometry_msgs::Twist& velocity, const FullSpeed& full);

/// Degrees clockwise from north, [0, 360), for ResetPosition.
double headingOf_deg(double yaw_rad);

}  // namespace frontseat_driver::ros_layer::blueye_layer
