"""Whether the simulator's clock kept pace with a recording that is played by wall time."""

from __future__ import annotations

from time import monotonic

from rclpy.node import Node
from rosgraph_msgs.msg import Clock

from truck_blowout_sim.nodes.clock import NS
from truck_blowout_sim.nodes.qos import latest, subscription

_ENOUGH_S = 1.0  # of wall time, to tell a rate from a hiccup
_TOLERANCE = 0.03  # as in the simulator's own diagnostics


class PaceWatch:
    """Compares `/clock` with the wall.

    Args:
        node: owner.
        rate: recorded seconds that are played a second of wall time.
    """

    def __init__(self, node: Node, rate: float) -> None:
        self._rate = rate
        self._first: tuple[float, float] | None = None
        self._last: tuple[float, float] | None = None
        self._subscription = subscription(node, Clock, "/clock", self._take, latest())

    def begin(self) -> None:
        """Playback begins: what was heard before does not count."""
        self._first = self._last = None

    @property
    def warning(self) -> str:
        """A sentence if the simulator was slower or faster than the recording, else empty."""
        if self._first is None or self._last is None:
            return ""
        wall_s, simulated_s = (b - a for a, b in zip(self._first, self._last, strict=True))
        if wall_s < _ENOUGH_S or abs(simulated_s / wall_s / self._rate - 1.0) < _TOLERANCE:
            return ""
        played_s = wall_s * self._rate
        return (f"the simulator advanced {simulated_s:.2f} s while {played_s:.2f} s of the"
                " recording were played by wall time, so commands came at the wrong instants:"
                " play with --ros-args -p use_sim_time:=true")  # fmt: skip

    def _take(self, message: Clock) -> None:
        self._last = (monotonic(), message.clock.sec + message.clock.nanosec / NS)
        self._first = self._first or self._last
