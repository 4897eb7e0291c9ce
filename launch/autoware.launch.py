"""The truck as Autoware's vehicle; start Autoware's planning and control beside it.

ros2 launch truck_blowout_sim autoware.launch.py initial_speed_mps:=15.0

What is published, and what was tested: docs/autoware.md.
"""

from __future__ import annotations

from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import EnvironmentVariable, LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

from launch import LaunchDescription

PACKAGE = "truck_blowout_sim"
DISCOVERY = "ROS_AUTOMATIC_DISCOVERY_RANGE"
SHARED = ("vehicle", "namespace", "initial_speed_mps", "record_path", "blow", "rviz",
          "discovery_range")  # fmt: skip


def argument(name: str, default: object, description: str) -> DeclareLaunchArgument:
    """A launch argument with a default."""
    return DeclareLaunchArgument(name, default_value=default, description=description)


def generate_launch_description() -> LaunchDescription:
    """What `ros2 launch` asks for."""
    simulator = IncludeLaunchDescription(
        PythonLaunchDescriptionSource(
            PathJoinSubstitution([FindPackageShare(PACKAGE), "launch", "simulator.launch.py"])
        ),
        launch_arguments=[(name, LaunchConfiguration(name)) for name in SHARED],
    )
    # Autoware's frame, mid rear axle on the ground, below the truck's own
    base_link = Node(
        package="tf2_ros",
        executable="static_transform_publisher",
        name="rear_axle",
        arguments=["--x", LaunchConfiguration("rear_axle_x_m"),
                   "--z", LaunchConfiguration("rear_axle_z_m"),
                   "--frame-id", "tractor/base_link", "--child-frame-id", "base_link"],
    )  # fmt: skip
    return LaunchDescription([
        argument("vehicle", "international_9400i_trailmobile",
                 "Name of a shipped vehicle, or path of a vehicle file."),
        argument("namespace", "truck", "Namespace of the simulator's own topics and services."),
        argument("initial_speed_mps", "0.0", "Speed at the start and after reset [m/s]."),
        argument("record_path", "", "Bag to write from the start; empty: none."),
        argument("blow", "", "Blowouts at set instants, TIRE@SECONDS, joined by commas."),
        argument("rear_axle_x_m", "-3.574", "Mid rear axle ahead of tractor/base_link [m]."),
        argument("rear_axle_z_m", "-0.9", "The ground above tractor/base_link [m]."),
        argument("rviz", "false", "Show the truck (needs rviz2)."),
        argument("discovery_range", EnvironmentVariable(DISCOVERY, default_value="LOCALHOST"),
                 "Who may take part: LOCALHOST, this machine; SUBNET, as ROS 2 by itself."),
        simulator,
        base_link,
    ])  # fmt: skip
