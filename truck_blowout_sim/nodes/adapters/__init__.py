"""Interfaces of other stacks, each active where its message package is installed.

Each adapter turns foreign commands into the five inputs of the truck, through the same checks and
timeouts as the simulator's own topics, or foreign services into the simulator's own.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from rclpy.node import Node

if TYPE_CHECKING:
    from truck_blowout_sim.nodes.simulator_node import Simulator

ADAPTERS = ("ackermann", "autoware", "interfaces")


def attach_all(node: Node, simulator: Simulator) -> tuple[str, ...]:
    """Attach every adapter whose messages are installed; returns their names."""
    active = []
    for name in ADAPTERS:
        module = import_module(f"{__name__}.{name}")
        if module.attach(node, simulator):
            active.append(name)
    return tuple(active)
