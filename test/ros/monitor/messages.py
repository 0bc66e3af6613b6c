"""Messages as the driver publishes them, for the tests of the monitor."""

import math

import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from frontseat_driver.msg import CommandAck, ControlStatus, LinkStatus, MissionStatus
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import BatteryState, NavSatFix, NavSatStatus, Range

UNKNOWN = 1e6


def link(connected=True, since_s=0.1, received=1000, **counters):
    return LinkStatus(connected=connected, endpoint="192.168.1.2:29500", dialect="sandshark",
                      connects=1, bytes_received=received,
                      since_received=rospy.Duration.from_sec(since_s), **counters)


def control(grant=ControlStatus.GRANTED, commanding=True, enabled=True, reason=""):
    return ControlStatus(grant=grant, commanding=commanding, commands_enabled=enabled,
                         reason=reason)


def mission(state=MissionStatus.RUNNING, status="Running", dive_file="survey.dive", details=""):
    return MissionStatus(state=state, status=status, dive_file=dive_file, details=details)


def odom(x=0.0, y=0.0, heading_deg=0.0, roll_deg=0.0, pitch_deg=0.0, ahead=0.0, unknown=()):
    """`unknown`: places on the diagonal of the pose's covariance, or "twist"."""
    message = Odometry()
    message.pose.pose.position.x, message.pose.pose.position.y = x, y
    half = [math.radians(angle) / 2.0 for angle in (roll_deg, -pitch_deg, 90.0 - heading_deg)]
    (sr, sp, sy), (cr, cp, cy) = [math.sin(a) for a in half], [math.cos(a) for a in half]
    q = message.pose.pose.orientation
    q.x, q.y = sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy
    q.z, q.w = cr * cp * sy - sr * sp * cy, cr * cp * cy + sr * sp * sy
    message.twist.twist.linear.x = ahead
    covariance = [0.0] * 36
    for place in unknown:
        if place != "twist":
            covariance[7 * place] = UNKNOWN
    message.pose.covariance = covariance
    message.twist.covariance = [UNKNOWN if "twist" in unknown else 0.0] + [0.0] * 35
    return message


def fix(latitude=42.35, longitude=-71.1, status=NavSatStatus.STATUS_FIX):
    return NavSatFix(latitude=latitude, longitude=longitude, status=NavSatStatus(status=status))


def depth(depth_m):
    message = PoseWithCovarianceStamped()
    message.pose.pose.position.z = -depth_m
    return message


def altitude(altitude_m):
    return Range(range=altitude_m)


def battery(voltage=16.2, cells=(4.0, 4.1), temperature=20.0, location="battery_1"):
    message = BatteryState(voltage=voltage, cell_voltage=list(cells), location=location)
    if hasattr(message, "temperature"):  # older sensor_msgs know none
        message.temperature = temperature
    return message


def ack(command="BPRMB", status=CommandAck.DONE, round_trip=0.012, message=""):
    return CommandAck(command=command, status=status, round_trip=round_trip, message=message)


def diagnostics(*statuses):
    """Each a triple of name, level and message."""
    return DiagnosticArray(status=[DiagnosticStatus(name=name, level=level, message=message)
                                   for name, level, message in statuses])


def log(message, level=Log.WARN, name="/frontseat"):
    return Log(level=level, name=name, msg=message)
