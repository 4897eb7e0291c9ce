"""A controller in the loop: the lane keeper steers, a tire blows, the truck stays in its lane.

ros2 launch truck_blowout_sim closed_loop.launch.py tire:=steer_left blow_after_s:=8.0
"""

from __future__ import annotations

from launch.actions import (
    DeclareLaunchArgument,
    IncludeLaunchDescription,
    SetEnvironmentVariable,
)
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import (
    EnvironmentVariable,
    LaunchConfiguration,
    PathJoinSubstitution,
)
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare

from launch import LaunchDescription

PACKAGE = "truck_blowout_sim"
DISCOVERY = "ROS_AUTOMATIC_DISCOVERY_RANGE"


def argument(name: str, default: object, description: str) -> DeclareLaunchArgument:
    """A launch argument with a default."""
    return DeclareLaunchArgument(name, default_value=default, description=description)


def generate_launch_description() -> LaunchDescription:
    """What `ros2 launch` asks for."""
    namespace = LaunchConfiguration("namespace")
    simulator = IncludeLaunchDescription(
        PythonLaunchDescriptionSource(
            PathJoinSubstitution([FindPackageShare(PACKAGE), "launch", "simulator.launch.py"])
        ),
        launch_arguments={
            "vehicle": LaunchConfiguration("vehicle"),
            "namespace": namespace,
            "initial_speed_mps": LaunchConfiguration("speed_mps"),
            "record_path": LaunchConfiguration("record_path"),
            # in simulated time from readiness: compiling takes its time on a fresh machine
            "blow": [LaunchConfiguration("tire"), "@", LaunchConfiguration("blow_after_s")],
            "discovery_range": LaunchConfiguration("discovery_range"),
            "rviz": LaunchConfiguration("rviz"),
        }.items(),
    )
    keeper = Node(
        package=PACKAGE,
        executable="lane_keeper",
        namespace=namespace,
        output="screen",
        parameters=[
            {"speed_mps": ParameterValue(LaunchConfiguration("speed_mps"), value_type=float)}
        ],
    )
    return LaunchDescription([
        argument("vehicle", "international_9400i_trailmobile",
                 "Name of a shipped vehicle, or path of a vehicle file."),
        argument("namespace", "truck", "Namespace of every relative topic and service."),
        argument("speed_mps", "23.0", "Speed at the start, which the driver holds [m/s]."),
        argument("tire", "steer_left", "Tire or hub to blow."),
        argument("blow_after_s", "10.0",
                 "When to blow it, after the simulator is ready [s of simulated time]."),
        argument("record_path", "", "Bag to write; empty: none."),
        argument("rviz", "false", "Show the truck (needs rviz2)."),
        argument("discovery_range", EnvironmentVariable(DISCOVERY, default_value="LOCALHOST"),
                 "Who may take part: LOCALHOST, this machine; SUBNET, as ROS 2 by itself."),
        SetEnvironmentVariable(DISCOVERY, LaunchConfiguration("discovery_range")),
        simulator,
        keeper,
    ])  # fmt: skip
