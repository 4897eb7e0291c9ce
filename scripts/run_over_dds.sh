#!/bin/sh
# run_over_dds.sh FOLDER: the test of 2013 over real DDS. Two processes, simulator and player: the
# player sends the recorded commands and has the tire blown by a service call, the simulator writes
# a bag. Then the bag is compared with the same run without ROS.
set -eu
folder=$1
bin=$(dirname -- "$0")/../.venv/bin
recording=$(dirname -- "$0")/../config/recordings/test_2013_steer_blowout.csv

if ! "$bin/python" -c "import rclpy" 2>/dev/null; then
    echo "rclpy is not installed here: the run over DDS is left out"
    exit 0
fi

rm -rf "$folder"
mkdir -p "$folder"
# Nothing beyond this machine takes part, nor any other run on it.
export ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST
export ROS_DOMAIN_ID="${ROS_DOMAIN_ID:-$(($$ % 100 + 1))}" ROS_LOG_DIR="$folder/log"

# The player keeps to the simulation's clock: on a busy machine both are late together.
"$bin/python" -m truck_blowout_sim.nodes.simulator --start-paused --record-folder "$folder" &
simulator=$!
trap 'kill -INT $simulator 2>/dev/null || true' EXIT INT TERM

"$bin/python" -m truck_blowout_sim.nodes.player "$recording" --record-path "$folder/bag" \
    --wait-for-simulator-s 600 --ros-args -p use_sim_time:=true
kill -INT "$simulator"
wait "$simulator"
trap - EXIT INT TERM
"$bin/truck-blowout" compare "$folder/bag" --force -o "$folder/comparison" > "$folder/comparison.txt"
echo "The run over DDS beside the same inputs simulated without ROS:"
"$bin/python" "$(dirname -- "$0")/sum_up_comparison.py" "$folder/comparison"
echo "$folder/comparison.txt: every channel; $folder/comparison/report.html: the same with figures"
