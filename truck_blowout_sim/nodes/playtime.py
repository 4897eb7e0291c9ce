"""Where in the recording playback is: moved on by the wall, or by a clock that others publish."""

from __future__ import annotations

import math
from collections.abc import Callable
from time import monotonic

from rclpy.executors import Executor
from rclpy.node import Node
from rosgraph_msgs.msg import Clock

from truck_blowout_sim.nodes.clock import NS
from truck_blowout_sim.nodes.qos import latest, subscription
from truck_blowout_sim.nodes.signals import StopFlag

_SILENCE_S = 2.0
_WARN_EVERY_S = 10.0


class WallTime:
    """Position by wall time.

    Args:
        node: its clock stamps what is published.
        rate: recorded seconds a second.
    """

    def __init__(self, node: Node, rate: float) -> None:
        self._node = node
        self._rate = rate
        self._position_s = 0.0
        self._since_s: float | None = None
        self._origin_ns = 0
        self._origin_s = 0.0
        self.worst_late_s = 0.0

    @property
    def position_s(self) -> float:
        """Instant of the recording that is now."""
        if self._since_s is None:
            return self._position_s
        return self._position_s + (self._now_s() - self._since_s) * self._rate

    def begin(
        self,
        executor: Executor,
        stop: StopFlag | None,
        start_s: float,
        warn: Callable[[str], object],
    ) -> None:
        """Playback is about to begin at an instant of the recording.

        Args:
            executor: spun while waiting for a clock.
            stop: ends the wait.
            start_s: the instant.
            warn: takes a sentence about what is waited for.
        """
        self._await_clock(executor, stop, warn)
        self._lay(start_s)

    def stamp_ns(self, time_s: float) -> int:
        """Stamp for a message of an instant: the recording laid upon the node's clock."""
        return self._origin_ns + round((time_s - self._origin_s) / self._rate * NS)

    def wait_s(self, next_s: float) -> float:
        """Wall time until an instant is due, seconds; 0 or less: now."""
        wait_s = (next_s - self.position_s) / self._rate
        if wait_s <= 0.0:
            self.worst_late_s = max(self.worst_late_s, -wait_s)
        return wait_s

    def hold(self) -> None:
        """Pause."""
        self._position_s, self._since_s = self.position_s, None

    def go(self) -> None:
        """Go on after a pause."""
        self._lay(self._position_s)
        self.start()

    def start(self) -> None:
        """Run from where playback began, with the stamps as `begin` laid them."""
        self._since_s = self._now_s()

    def move_to(self, time_s: float) -> None:
        """Jump; goes on or stays paused as before."""
        self._position_s = time_s
        self._lay(time_s)
        if self._since_s is not None:
            self._since_s = self._now_s()

    def _lay(self, time_s: float) -> None:
        """This instant of the recording is now, for the stamps of what follows."""
        self._origin_ns, self._origin_s = self._clock_now_ns(), time_s

    def _now_s(self) -> float:
        return monotonic()

    def _clock_now_ns(self) -> int:
        return int(self._node.get_clock().now().nanoseconds)

    def _await_clock(
        self, executor: Executor, stop: StopFlag | None, warn: Callable[[str], object]
    ) -> None:
        """The wall is always there."""


class ClockTime(WallTime):
    """Position by `/clock`: a message is due once that clock has reached its instant."""

    def __init__(self, node: Node, rate: float) -> None:
        super().__init__(node, rate)
        self._clock_ns: int | None = None
        subscription(node, Clock, "/clock", self._take, latest())

    def wait_s(self, next_s: float) -> float:
        """0 if due, else until `/clock` says something."""
        wait_s = super().wait_s(next_s)
        # half a nanosecond's worth of rounding must not cost a tick
        return math.inf if wait_s > 1e-9 else 0.0

    def _now_s(self) -> float:
        return self._clock_now_ns() / NS

    def _clock_now_ns(self) -> int:
        return self._clock_ns or 0

    def _take(self, message: Clock) -> None:
        self._clock_ns = message.clock.sec * NS + message.clock.nanosec

    def _await_clock(
        self, executor: Executor, stop: StopFlag | None, warn: Callable[[str], object]
    ) -> None:
        # What was heard before a reset may be old: only a reading from now on counts.
        self._clock_ns = None
        warn_s = monotonic() + _SILENCE_S
        while self._clock_ns is None and not stop:
            executor.spin_once(timeout_sec=0.1)
            if monotonic() >= warn_s:
                warn_s = monotonic() + _WARN_EVERY_S
                warn(
                    "use_sim_time is set and nobody publishes /clock: waiting; start the simulator,"
                    " or play by wall time with use_sim_time false"
                )
