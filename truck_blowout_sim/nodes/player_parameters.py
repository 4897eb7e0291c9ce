"""The parameters of the player node; words as in `ros2 bag play`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rclpy.exceptions import NameValidationException
from rclpy.expand_topic_name import expand_topic_name
from rclpy.validate_full_topic_name import validate_full_topic_name
from rclpy.validate_topic_name import validate_topic_name

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.nodes.parameters import Spec

SPECS: tuple[Spec, ...] = (
    Spec("recording", "", "Recording to play: rosbag2 folder, .mcap, .csv, .mat, any log with a"
         " mapping file, or the name of a shipped recording."),
    Spec("map", "", "Mapping file: what in a foreign log becomes which channel"
         " (docs/bring_your_own_log.md)."),
    Spec("blow", "", "Blowouts that the recording does not mark, on its clock: `TIRE@SECONDS`,"
         " several joined by commas."),
    Spec("also", [""], "Further files of the same test."),
    Spec("rate", 1.0, "Recorded seconds a second; of simulated time under `use_sim_time`, else of"
         " wall time.", "", 0.01, 1000),
    Spec("loop", False, "Begin again at the end."),
    Spec("start_offset", 0.0, "Begin this far into the recording.", "s", 0, 1e7),
    Spec("playback_duration", 0.0, "Play this much of it; 0: to the end.", "s", 0, 1e7),
    Spec("delay", 0.0, "Wait this long before the first message, so that readers find it.", "s",
         0, 3600),
    Spec("start_paused", False, "Wait for `~/resume` or `~/play_next`."),
    Spec("remap", [""], "Topics of a foreign bag as `FROM:=TO`, `TO` a name of the simulator's"
         " outputs or commands; for all but names and types there is `map`."),
    Spec("measured", "measured", "Prefix of the topics that carry what was measured."),
    Spec("publish_measured", True, "Publish what was measured, not the commands alone."),
    Spec("wait_for_simulator_s", 5.0, "Wait this long for the simulator, then play without it;"
         " 0: do not wait.", "s", 0, 1e6),
    Spec("prepare_simulator", True, "Put the simulator into the recording's state at the start:"
         " pause, set `initial_*`, reset, resume."),
    Spec("simulator", "simulator", "Name of the simulator node."),
    Spec("record_path", "", "Bag for the simulator to write of the replay, from its first instant"
         " to its last; empty: none."),
    Spec("seek_to_s", 0.0, "Where `~/seek` goes, from the beginning of the recording.", "s",
         0, 1e7, live=True),
)  # fmt: skip


def check_names(values: Mapping[str, Any]) -> None:
    """Judge what becomes part of a name of ROS 2.

    Raises:
        InputError: with it, no topic or service can have that name.
    """
    for name in ("measured", "simulator"):
        try:
            topic = f"{values[name].rstrip('/')}/x"
            validate_topic_name(topic)
            validate_full_topic_name(expand_topic_name(topic, "player", "/truck"))
        except NameValidationException as error:
            problem = str(error).splitlines()[0]
            raise InputError(
                f"{quoted(values[name])}: {problem}", file="parameter", where=name,
                expected="letters, digits and _, in parts joined by /",
            ) from error  # fmt: skip


def remappings(words: list[str]) -> dict[str, str]:
    """Pairs from `FROM:=TO`, as in `ros2 bag play --remap`.

    Raises:
        InputError: a word that is no such pair.
    """
    pairs = {}
    for word in filter(None, words):
        source, mark, target = word.partition(":=")
        if not (source and mark and target):
            raise InputError(
                f"{quoted(word)} is no remapping", file="parameter", where="remap",
                expected="FROM:=TO, as in /ins/odometry:=tractor/odometry",
            )  # fmt: skip
        pairs[source] = target
    return pairs
