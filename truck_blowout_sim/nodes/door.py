"""Opens a node: signal handlers first, then the imports, which take seconds.

A Ctrl-C in the first second would otherwise end in a traceback out of some library's import.
"""

from __future__ import annotations

import os
import sys
import threading
from collections.abc import Sequence
from importlib import import_module

from truck_blowout_sim.nodes.signals import StopFlag

COMPILER = "compiler"
"""Name of the thread that compiles the model; see `plant.Plant.build`."""

DISCOVERY = "ROS_AUTOMATIC_DISCOVERY_RANGE"


def open_node(name: str, arguments: Sequence[str] | None = None) -> int:
    """Run the node of a module `<name>_node` from its command line to its end.

    Args:
        name: of the node.
        arguments: command line without the program's name; the process's own if None.

    Returns:
        Exit status: 0 done or ended by a signal, 2 bad usage or input, 1 an internal failure.
    """
    with StopFlag() as stop:
        try:
            stop.at_once = True
            module = import_module(f"truck_blowout_sim.nodes.{name}_node")
            stop.at_once = False
            status = int(module.main(arguments, stop))
        except BaseException:
            if not stop.interrupted:
                raise
            print(f"{name}: {stop.reason} while starting", file=sys.stderr)
            status = 0
        if any(thread.name == COMPILER for thread in threading.enumerate()):
            # A compiler cannot be interrupted, and the interpreter must not end under its feet.
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(status)
    return status


def open_node_here(name: str, arguments: Sequence[str] | None = None) -> int:
    """As `open_node`, but only nodes of this machine take part, unless the environment says more.

    ROS 2 by itself joins every node of the same domain in the whole subnet.
    """
    os.environ.setdefault(DISCOVERY, "LOCALHOST")
    return open_node(name, arguments)


def simulator() -> int:
    """`truck-blowout-simulator`."""
    return open_node_here("simulator")


def player() -> int:
    """`truck-blowout-player`."""
    return open_node_here("player")


def lane_keeper() -> int:
    """`truck-blowout-lane-keeper`."""
    return open_node_here("lane_keeper")
