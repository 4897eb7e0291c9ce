"""An experiment again: simulator and player, the tire blown at the recorded instant, a bag.

ros2 launch truck_blowout_sim replay.launch.py recording:=/path/to/bag record_path:=/tmp/again
"""

from __future__ import annotations

from launch.actions import (
    DeclareLaunchArgument,
    EmitEvent,
    GroupAction,
    IncludeLaunchDescription,
    RegisterEventHandler,
    SetEnvironmentVariable,
)
from launch.event_handlers import OnProcessExit
from launch.events import Shutdown
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
    share = FindPackageShare(PACKAGE)
    player = Node(
        package=PACKAGE,
        executable="player",
        namespace=LaunchConfiguration("namespace"),
        output="screen",
        parameters=[{
            "recording": ParameterValue(LaunchConfiguration("recording"), value_type=str),
            "map": ParameterValue(LaunchConfiguration("map"), value_type=str),
            "start_offset": ParameterValue(LaunchConfiguration("start_offset"), value_type=float),
            "loop": ParameterValue(LaunchConfiguration("loop"), value_type=bool),
            "record_path": ParameterValue(LaunchConfiguration("record_path"), value_type=str),
            "wait_for_simulator_s": 600.0,  # the first start compiles the model
            "use_sim_time": True,
        }],
    )  # fmt: skip
    shared = ("vehicle", "namespace", "real_time_factor", "record_folder", "rviz",
              "discovery_range")  # fmt: skip
    # The player has the bag begun and ended. A group of its own: what the included file is given
    # would otherwise hold for the player, too.
    simulator = GroupAction([
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource(
                PathJoinSubstitution([share, "launch", "simulator.launch.py"])
            ),
            launch_arguments=[*((name, LaunchConfiguration(name)) for name in shared),
                              ("record_path", "")],
        )
    ])  # fmt: skip
    # The simulator would run on for ever: the end of the recording is the end of the launch.
    end = RegisterEventHandler(
        OnProcessExit(target_action=player, on_exit=[EmitEvent(event=Shutdown(reason="played"))])
    )
    default = PathJoinSubstitution([share, "config", "recordings", "test_2013_steer_blowout.csv"])
    return LaunchDescription([
        argument("recording", default, "Recording: rosbag2 folder, .mcap, .csv, .mat, or any log"
                 " with a mapping file."),
        argument("map", "", "Mapping file of a foreign log; empty: none."),
        argument("vehicle", "international_9400i_trailmobile",
                 "Name of a shipped vehicle, or path of a vehicle file."),
        argument("namespace", "truck", "Namespace of every relative topic and service."),
        argument("real_time_factor", "1.0", "Simulated seconds a second of wall time."),
        argument("start_offset", "0.0", "Begin this far into the recording [s]."),
        argument("loop", "false", "Begin again at the end."),
        argument("record_path", "", "Bag to write, under record_folder; empty: none."),
        argument("record_folder", "", "Folder of the bag; empty: the folder of the launch."),
        argument("rviz", "false", "Show the truck (needs rviz2)."),
        argument("discovery_range", EnvironmentVariable(DISCOVERY, default_value="LOCALHOST"),
                 "Who may take part: LOCALHOST, this machine; SUBNET, as ROS 2 by itself."),
        SetEnvironmentVariable(DISCOVERY, LaunchConfiguration("discovery_range")),
        simulator,
        player,
        end,
    ])  # fmt: skip
