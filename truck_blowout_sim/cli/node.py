"""`truck-blowout simulator` and `player`: a thin door to the ROS 2 nodes.

The terminal knows nothing of the nodes but their entry points: where ROS 2 is not installed, the
other verbs work without it.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib.metadata import entry_points
from importlib.util import find_spec

from truck_blowout_sim.errors import InputError

GROUP = "truck_blowout_sim.nodes"
NODES = {
    "simulator": "Run the ROS 2 node `simulator`; its options and `--ros-args` follow.",
    "player": "Run the ROS 2 node `player`, which plays a recording to the simulator.",
}


def run(name: str, words: Sequence[str]) -> int:
    """Run a node until it ends; returns its exit status.

    Args:
        name: key of `NODES`.
        words: what stands behind it on the command line.

    Raises:
        InputError: ROS 2 or the package's entry points are not installed.
    """
    if find_spec("rclpy") is None:
        raise InputError(
            f"{name} needs rclpy, which is not installed",
            expected="pip install 'truck_blowout_sim[ros]' (Linux, x86-64), or a sourced ROS 2",
        )
    for point in entry_points(group=GROUP):
        if point.name == name:
            sys.argv = [name, *words]
            return int(point.load()())
    raise InputError(f"the node {name} is not installed", expected="pip install this package again")
