"""The simulator alone, headless; `rviz:=true` shows it.

ros2 launch truck_blowout_sim simulator.launch.py --show-args
"""

from __future__ import annotations

from launch.actions import DeclareLaunchArgument, SetEnvironmentVariable
from launch.conditions import IfCondition
from launch.substitutions import (
    Command,
    EnvironmentVariable,
    LaunchConfiguration,
    NotSubstitution,
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


def shared(*parts: str) -> PathJoinSubstitution:
    """A file of this package."""
    return PathJoinSubstitution([FindPackageShare(PACKAGE), "config", *parts])


def arguments() -> list[DeclareLaunchArgument]:
    """What the launch takes."""
    return [
        argument("vehicle", "international_9400i_trailmobile",
                 "Name of a shipped vehicle, or path of a vehicle file."),
        argument("namespace", "truck", "Namespace of every relative topic and service."),
        argument("initial_speed_mps", "0.0", "Speed at the start and after reset [m/s]."),
        argument("real_time_factor", "1.0",
                 "Simulated seconds a second of wall time; 0: as fast as it can."),
        argument("record_path", "", "Bag to write from the start; empty: none."),
        argument("record_folder", "", "The only folder in which other nodes may have bags"
                 " written; empty: the folder of the launch."),
        argument("blow", "", "Blowouts at set instants, TIRE@SECONDS of simulated time after"
                 " readiness, joined by commas."),
        argument("use_sim_time", "false", "Follow /clock instead of publishing it."),
        argument("params_file", shared("nodes", "simulator.yaml"), "All other parameters."),
        argument("rviz", "false", "Show the truck (needs rviz2)."),
        argument("state_publisher", "false", "Have robot_state_publisher place wheels and trailer"
                 " in /tf instead of the simulator."),
        argument("discovery_range", EnvironmentVariable(DISCOVERY, default_value="LOCALHOST"),
                 "Who may take part: LOCALHOST, this machine; SUBNET, as ROS 2 by itself."),
        argument("rviz_config", shared("rviz", "truck.rviz"), "Layout of RViz."),
    ]  # fmt: skip


def simulator_node() -> Node:
    """The simulator with the arguments of the launch as its parameters."""
    vehicle = LaunchConfiguration("vehicle")
    namespace = LaunchConfiguration("namespace")
    use_sim_time = LaunchConfiguration("use_sim_time")
    return Node(
        package=PACKAGE,
        executable="simulator",
        namespace=namespace,
        output="screen",
        parameters=[
            LaunchConfiguration("params_file"),
            {
                "vehicle": vehicle,
                "initial_speed_mps": ParameterValue(
                    LaunchConfiguration("initial_speed_mps"), value_type=float
                ),
                "real_time_factor": ParameterValue(
                    LaunchConfiguration("real_time_factor"), value_type=float
                ),
                "record_path": ParameterValue(LaunchConfiguration("record_path"), value_type=str),
                "record_folder": ParameterValue(
                    LaunchConfiguration("record_folder"), value_type=str
                ),
                "blow": ParameterValue(LaunchConfiguration("blow"), value_type=str),
                "tf_of_joints": ParameterValue(
                    NotSubstitution(LaunchConfiguration("state_publisher")), value_type=bool
                ),
                "use_sim_time": ParameterValue(use_sim_time, value_type=bool),
            },
        ],
    )


def generate_launch_description() -> LaunchDescription:
    """What `ros2 launch` asks for."""
    vehicle = LaunchConfiguration("vehicle")
    namespace = LaunchConfiguration("namespace")
    simulator = simulator_node()
    description = ParameterValue(
        Command(["ros2 run truck_blowout_sim urdf ", vehicle]), value_type=str
    )
    state_publisher = Node(
        package="robot_state_publisher",
        executable="robot_state_publisher",
        namespace=namespace,
        parameters=[{"robot_description": description, "use_sim_time": True}],
        # the simulator says it already
        remappings=[("robot_description", "~/robot_description")],
        condition=IfCondition(LaunchConfiguration("state_publisher")),
    )
    rviz = Node(
        package="rviz2",
        executable="rviz2",
        arguments=["-d", LaunchConfiguration("rviz_config")],
        parameters=[{"use_sim_time": True}],
        condition=IfCondition(LaunchConfiguration("rviz")),
    )
    return LaunchDescription([
        *arguments(),
        SetEnvironmentVariable(DISCOVERY, LaunchConfiguration("discovery_range")),
        simulator,
        state_publisher,
        rviz,
    ])  # fmt: skip
