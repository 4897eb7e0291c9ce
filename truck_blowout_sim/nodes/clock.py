"""Time of a simulation: counted in whole steps, released by the wall or by another clock.

Nothing here knows ROS. A pace says how long to wait before the next tick; a tick is always the
same number of steps. A pace never asks for two ticks to make up for a late one: time that was
lost stays lost, and shows in the factor achieved.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

NS = 1_000_000_000


@dataclass
class StepClock:
    """Simulated time as integer nanoseconds: `base_ns + steps * step_ns`, free of rounding."""

    step_ns: int
    base_ns: int = 0
    steps: int = 0

    @property
    def now_ns(self) -> int:
        """Simulated time in nanoseconds."""
        return self.base_ns + self.steps * self.step_ns

    def advance(self, steps: int) -> None:
        """Count steps that were taken."""
        self.steps += steps

    def move_to(self, now_ns: int) -> None:
        """Let the same truck stand at another time (a followed clock that jumped)."""
        self.base_ns, self.steps = now_ns, 0


class WallPace:
    """Paced by the wall clock, `factor` simulated seconds a second; 0: as fast as possible."""

    def __init__(self, tick_s: float, factor: float, wall_s: float) -> None:
        self.tick_s = tick_s
        self.factor = factor
        self._due_s = wall_s

    @property
    def interval_s(self) -> float:
        """Wall time between two ticks."""
        return self.tick_s / self.factor if self.factor > 0 else 0.0

    def wait_s(self, wall_s: float, now_ns: int) -> float:
        """Seconds until the next tick is due."""
        return self._due_s - wall_s if self.factor > 0 else 0.0

    def ticked(self, wall_s: float) -> float:
        """Set the next tick's time; seconds this one is late: by more than one, the grid moves."""
        if self.factor <= 0:
            return 0.0
        late_s = wall_s - self._due_s
        # Inside one interval the grid stands, so that jitter does not add up to drift.
        start_s = self._due_s if late_s < self.interval_s else wall_s
        self._due_s = start_s + self.interval_s
        return max(late_s, 0.0)

    @property
    def known(self) -> bool:
        """Whether it is known what time it is."""
        return True

    def restart(self, wall_s: float) -> None:
        """The next tick is due one interval from now."""
        self._due_s = wall_s + self.interval_s


class FollowPace:
    """Follows the time that somebody else publishes: a tick is due once that time has come."""

    def __init__(self, tick_ns: int) -> None:
        self.tick_ns = tick_ns
        self.target_ns: int | None = None

    def wait_s(self, wall_s: float, now_ns: int) -> float:
        """0 while the followed clock is a whole tick ahead, else until it says something."""
        if self.target_ns is None or now_ns + self.tick_ns > self.target_ns:
            return math.inf
        return 0.0

    def ticked(self, wall_s: float) -> float:
        """Lateness is measured against the followed clock, not the wall; see `behind_s`."""
        return 0.0

    @property
    def known(self) -> bool:
        """Whether it is known what time it is."""
        return self.target_ns is not None

    def behind_s(self, now_ns: int) -> float:
        """How far the simulation is behind the followed clock, in whole ticks, seconds."""
        if self.target_ns is None:
            return 0.0
        return max(self.target_ns - now_ns - self.tick_ns, 0) / NS

    def restart(self, wall_s: float) -> None:
        """Nothing to forget."""


def jump(previous_ns: int, now_ns: int, backward_ns: int, forward_ns: int) -> str:
    """Judge two successive readings of a followed clock.

    Args:
        previous_ns, now_ns: the readings.
        backward_ns: a step back by more than this is a jump (less is a reordered datagram).
        forward_ns: a step ahead by more than this is a jump.

    Returns:
        "backward", "forward", or "" for time that simply goes on.
    """
    if now_ns < previous_ns - backward_ns:
        return "backward"
    return "forward" if now_ns > previous_ns + forward_ns else ""


@dataclass(frozen=True)
class PaceReport:
    """What a `PaceMeter` found: the factor achieved, lateness of the ticks (s), their number."""

    factor: float
    late_mean_s: float
    late_p99_s: float
    late_worst_s: float
    ticks: int


@dataclass
class PaceMeter:
    """Factor achieved and lateness since the last report."""

    wall_s: float
    now_ns: int
    ticks: int = 0
    late_s: list[float] = field(default_factory=list)

    def tick(self, late_s: float) -> None:
        """Count one tick."""
        self.ticks += 1
        if late_s > 0.0:
            self.late_s.append(late_s)

    def report(self, wall_s: float, now_ns: int) -> PaceReport:
        """What was found since the last report; then begin anew."""
        span_s = max(wall_s - self.wall_s, 1e-9)
        # a tick that was not late has no entry
        late = sorted(self.late_s)
        beyond = max(1, round(0.01 * self.ticks))
        out = PaceReport(
            factor=(now_ns - self.now_ns) / NS / span_s,
            late_mean_s=sum(late) / self.ticks if self.ticks else 0.0,
            late_p99_s=late[-beyond] if len(late) >= beyond else 0.0,
            late_worst_s=late[-1] if late else 0.0,
            ticks=self.ticks,
        )
        self.restart(wall_s, now_ns)
        return out

    def restart(self, wall_s: float, now_ns: int) -> None:
        """Begin anew, after a report or when time was moved."""
        self.wall_s, self.now_ns, self.ticks = wall_s, now_ns, 0
        self.late_s.clear()
