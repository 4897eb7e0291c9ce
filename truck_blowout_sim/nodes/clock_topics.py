"""`/clock`: publishing it, or following somebody else's."""

from __future__ import annotations

import struct
from typing import Any, Protocol

from rclpy.node import Node
from rosgraph_msgs.msg import Clock

from truck_blowout_sim.nodes.clock import NS, FollowPace, jump
from truck_blowout_sim.nodes.plant import Plant
from truck_blowout_sim.nodes.qos import latest, publisher, reliable, subscription

# A datagram that arrives out of order may carry a clock that is a little older.
_REORDERED_NS = 50_000_000
_CLOCK = struct.Struct("<4siI")
_LITTLE_ENDIAN = b"\x00\x01\x00\x00"
CLOCK, CLOCK_TYPE = "/clock", "rosgraph_msgs/msg/Clock"


def clock_bytes(now_ns: int) -> bytes:
    """A serialised rosgraph_msgs/Clock."""
    return _CLOCK.pack(_LITTLE_ENDIAN, *divmod(now_ns, NS))


class ClockPublisher:
    """Publishes simulated time.

    Args:
        node: owner.
        every: ticks between two messages.
    """

    def __init__(self, node: Node, every: int) -> None:
        self._publisher = publisher(node, Clock, CLOCK, reliable())
        self._every = every
        self._ticks = 0

    def publish(self, now_ns: int, *, always: bool = False) -> None:
        """One tick has passed; publish if it is due."""
        self._ticks += 1
        if always or self._ticks % self._every == 0:
            self._publisher.publish(clock_bytes(now_ns))


class Following(Protocol):
    """What a followed clock needs of the simulator."""

    plant: Plant
    paused: bool
    recorder: Any
    log: Any

    def begin(self) -> None:
        """The time is known now."""

    def restart(self, why: str) -> None:
        """Return to the initial state."""

    def record(self, wanted: bool) -> tuple[bool, str]:
        """Start or stop a bag."""


class FollowedClock:
    """Listens to `/clock` and sets the pace's target.

    Args:
        node: owner.
        simulator: what is moved in time.
        pace: gets the target.
        values: parameters; `max_clock_jump_s` is looked up at each message.
    """

    def __init__(
        self, node: Node, simulator: Following, pace: FollowPace, values: dict[str, Any]
    ) -> None:
        self._simulator = simulator
        self._pace = pace
        self._values = values
        subscription(node, Clock, CLOCK, self._take, latest())

    def rejoin(self) -> None:
        """After a pause: stand at the clock's present time, nothing is made up for."""
        target_ns = self._pace.target_ns
        if target_ns is not None and target_ns > self._simulator.plant.now_ns:
            self._simulator.plant.move_to(target_ns)

    def _take(self, message: Clock) -> None:
        now_ns = message.clock.sec * NS + message.clock.nanosec
        plant, log = self._simulator.plant, self._simulator.log
        if now_ns < 0:
            log.warning("a /clock below zero is ignored: no stamp has it", once=True)
            return
        before_ns, self._pace.target_ns = self._pace.target_ns, now_ns
        if before_ns is None or not plant.ready:
            plant.move_to(now_ns)
            if plant.ready:
                self._simulator.begin()
            if before_ns is None:
                log.info(f"following /clock from {now_ns / NS:.3f} s on")
            return
        forward_ns = round(self._values["max_clock_jump_s"] * NS)
        kind = jump(before_ns, now_ns, _REORDERED_NS, forward_ns)
        seconds = f"from {before_ns / NS:.3f} to {now_ns / NS:.3f} s"
        if kind == "backward":
            recorder = self._simulator.recorder
            recording = recorder.active
            if recording:
                recorder.stop()  # time in a bag cannot run backwards
            plant.move_to(now_ns)
            self._simulator.restart(f"/clock jumped back {seconds}")
            if recording:
                self._simulator.record(True)
        elif kind == "forward":
            plant.move_to(now_ns)
            log.warning(f"/clock jumped ahead {seconds}: the truck keeps its state")
        elif now_ns < before_ns:
            self._pace.target_ns = before_ns
