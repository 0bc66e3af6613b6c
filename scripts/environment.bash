# Sourced by the scripts beside it: one environment for building, testing and the demo.

repository=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build_dir=${BUILD_DIR:-$repository/build}
case $build_dir in /*) ;; *) build_dir=$repository/$build_dir ;; esac

# ROS belongs to the system's python3; another one that comes first in PATH would lack its modules.
export PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH

if [ ! -d "${HOME:-}" ] || [ ! -w "${HOME:-}" ]; then
  export HOME=$build_dir/home
  mkdir -p "$HOME"
fi

# Nothing is written to the home folder, and no name of this host needs to resolve.
export ROS_HOME=$build_dir/ros
export ROS_LOG_DIR=$ROS_HOME/log

# Lines of the programs come as they are said, also through a pipe.
export ROSCONSOLE_STDOUT_LINE_BUFFERED=1
export ROS_IP=127.0.0.1
unset ROS_HOSTNAME

# ROS's set-up files read variables that may be unset.
source_setup() {
  set +u
  # shellcheck disable=SC1090
  source "$1"
  set -u
}

if [ -f /opt/ros/noetic/setup.bash ]; then
  source_setup /opt/ros/noetic/setup.bash
fi
