"""Publishes `/diagnostics` by wall time, and looks after what only needs a look now and then."""

from __future__ import annotations

from typing import TYPE_CHECKING

from diagnostic_msgs.msg import DiagnosticArray
from rclpy.node import Node

from truck_blowout_sim.nodes import diagnostics
from truck_blowout_sim.nodes.clock import FollowPace
from truck_blowout_sim.nodes.qos import publisher, reliable

if TYPE_CHECKING:
    from truck_blowout_sim.nodes.simulator_node import Simulator

_CLOCK_WHILE_PAUSED_S = 0.1


class Reporter:
    """Called in every turn of the loop; does something about once a second."""

    def __init__(self, node: Node, simulator: Simulator) -> None:
        self._node = node
        self._simulator = simulator
        self._publisher = publisher(node, DiagnosticArray, "/diagnostics", reliable())
        self._period_s = 1.0 / simulator.values["diagnostics_rate_hz"]
        self._due_s = 0.0
        self._clock_due_s = 0.0
        self._warned: set[str] = set()
        self._name = node.get_fully_qualified_name().lstrip("/")

    def spin(self, wall_s: float) -> None:
        """Report if it is time to."""
        simulator = self._simulator
        standing = simulator.paused or not simulator.plant.ready
        if standing and simulator.clock and wall_s >= self._clock_due_s:
            # A node that joins now must learn what time it is.
            self._clock_due_s = wall_s + _CLOCK_WHILE_PAUSED_S
            simulator.clock.publish(simulator.plant.now_ns, always=True)
        if wall_s >= self._due_s:
            self._due_s = wall_s + self._period_s
            self._report(wall_s)

    def _report(self, wall_s: float) -> None:
        simulator, name = self._simulator, self._name
        plant, pace = simulator.plant, simulator.pace
        if not plant.ready:
            waiting = diagnostics.waiting_status(f"{name}: state", simulator.ready()[1])
            self._publisher.publish(diagnostics.array(plant.now_ns, [waiting]))
            return
        following = isinstance(pace, FollowPace)
        simulator.recorder.look_after()
        entries = [
            diagnostics.pace_status(
                f"{name}: pace", simulator.meter, wall_s, plant.now_ns,
                wanted_factor=None if following else simulator.values["real_time_factor"],
                behind_s=pace.behind_s(plant.now_ns) if isinstance(pace, FollowPace) else 0.0,
                paused=simulator.paused,
            ),
            diagnostics.inputs_status(f"{name}: inputs", plant.bank.inputs, plant.now_ns),
            diagnostics.recorder_status(f"{name}: recorder", simulator.recorder.state),
            diagnostics.state_status(f"{name}: state", plant.truck.ending, plant.truck.blown),
            diagnostics.clock_status(f"{name}: clock", self._node, following),
            diagnostics.outputs_status(f"{name}: outputs", self._node, simulator.outputs.topics),
        ]  # fmt: skip
        for entry in entries[-2:]:
            if entry.level == diagnostics.WARN and entry.name not in self._warned:
                self._warned.add(entry.name)
                simulator.log.warning(entry.message)
        self._publisher.publish(diagnostics.array(plant.now_ns, entries))
