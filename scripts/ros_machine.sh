#!/usr/bin/env bash
# Builds, tests and starts the lab on a ROS machine: Ubuntu 24.04 with ROS 2 Jazzy in /opt/ros/jazzy.
#
#   scripts/ros_machine.sh                  all steps
#   scripts/ros_machine.sh build launch     these
#
# install: what package.xml names (needs root); build: colcon build; test: colcon test of what needs
# neither the pages nor the lock files' tools; launch: the lab under ros2 launch takes a robot, plays
# it and records it; bags: rosbag2 reads and plays that recording.
# Not `set -u`: the setup files of ROS read variables that are not set.
set -eo pipefail
cd "$(dirname "$0")/.."
LOGS=${ROS_MACHINE_LOGS:-$(mktemp -d)}
mkdir -p "$LOGS"
BAG=$LOGS/session
STARTED=()

sourced() {
    # Elsewhere: the wheels of a clone's set-up, where somebody put the `ros2` command beside them.
    if [ -d /opt/ros/jazzy ]; then
        . /opt/ros/jazzy/setup.bash
        . install/setup.bash
    else
        . .venv/mrlab.sh
    fi
}

within() { # SECONDS WHAT COMMAND...: wait until a command succeeds
    local seconds=$1 what=$2
    shift 2
    for _ in $(seq "$seconds"); do
        if "$@"; then return; fi
        sleep 1
    done
    echo "waited $seconds s in vain for $what" >&2
    return 1
}

begin() { # LOG COMMAND...: start a process, which ends with the script
    local log=$1
    shift
    # A group of its own, and SIGINT as on a terminal: a shell's child in the background ignores it.
    python3 -c 'import os, signal, sys
os.setsid()
signal.signal(signal.SIGINT, signal.SIG_DFL)
os.execvp(sys.argv[1], sys.argv[1:])' "$@" >"$LOGS/$log" 2>&1 &
    STARTED+=($!)
}

finish() {
    for process in "${STARTED[@]}"; do
        kill -INT -- "-$process" 2>/dev/null || true
        wait "$process" 2>/dev/null || true
    done
    STARTED=()
}
trap finish EXIT

call() { # SERVICE TYPE REQUEST: call a service, which has to succeed
    ros2 service call "$1" "mrlab_msgs/srv/$2" "$3" | tee "$LOGS/call.log"
    grep -q "success=True" "$LOGS/call.log"
}

step_install() {
    # Ubuntu lets pip install into the system only when told to.
    export PIP_BREAK_SYSTEM_PACKAGES=1 DEBIAN_FRONTEND=noninteractive
    apt-get update
    apt-get install -y --no-install-recommends python3-pip python3-dev g++
    rosdep update --rosdistro jazzy
    rosdep install --from-paths . msg_schemas --ignore-src -y --rosdistro jazzy
    pip install -r requirements-ros.lock
}

step_build() {
    . /opt/ros/jazzy/setup.bash
    colcon build --base-paths . msg_schemas
}

step_test() {
    sourced
    colcon test --base-paths . msg_schemas --packages-select mrlab_ros --return-code-on-test-failure \
        --pytest-args test/unit/core test/unit/messages test/unit/ros -n 2
    colcon test-result --verbose
}

step_launch() {
    sourced
    rm -rf "$BAG"
    begin launch.log ros2 launch mrlab_ros lab.launch.py web:=false "state_dir:=$LOGS/state"
    within 60 "the lab" grep -q "the lab is ready" "$LOGS/launch.log" ||
        { cat "$LOGS/launch.log"; return 1; }
    call /lab/spawn_robot SpawnRobot "{model: ur5e, automatic: true}"
    call /converter/convert ConvertTrajectory \
        "{path: $PWD/examples/quintic_ur5e.mat, robot_model: ur5e, id: quintic}"
    call /recorder/start StartRecording "{bag: $BAG}"
    call /ur5e_1/load LoadTrajectory "{id: quintic}"
    call /ur5e_1/play Trigger "{}"
    sleep 3
    call /recorder/stop Trigger "{}"
    finish
}

step_bags() {
    sourced
    if [ ! -d "$BAG" ]; then echo "there is no recording; run launch and bags together" >&2; return 1; fi
    ros2 bag info "$BAG" | tee "$LOGS/info.log"
    grep -q "/ur5e_1/joint_states" "$LOGS/info.log"
    begin play.log ros2 bag play --loop "$BAG"
    timeout 30 ros2 topic echo --once /ur5e_1/joint_states sensor_msgs/msg/JointState
    finish
}

for step in "${@:-install build test launch bags}"; do
    for each in $step; do
        echo "== $each"
        "step_$each"
    done
done
echo "done; the logs are in $LOGS"
