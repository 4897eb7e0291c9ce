"""What a driver is told to do in one run."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

Program = Callable[[float], float]


@dataclass(frozen=True)
class Braking:
    """A brake application: control pressure (Pa gauge) on some groups between two instants."""

    start_s: float
    end_s: float
    pressure_pa: float
    groups: tuple[str, ...] = ("trailer",)

    def pressure(self, group: str, time_s: float) -> float:
        """Control pressure of a group, with 0.15 s of valve movement at both ends."""
        if group not in self.groups:
            return 0.0
        up, down = (time_s - self.start_s) / 0.15, (self.end_s - time_s) / 0.15
        return self.pressure_pa * min(1.0, max(0.0, min(up, down)))


@dataclass(frozen=True)
class Manoeuvre:
    """One run. `program` is the hand-wheel angle while the driver leaves the lane alone."""

    kind: str
    words: str
    speed_mps: float
    duration_s: float
    program: Program = field(default=lambda time_s: 0.0)
    open_loop: tuple[float, float] = (1.0e9, 1.0e9)   # from, to, s
    lane_after_m: float = 0.0
    release_s: float = 1.0e9
    brakings: tuple[Braking, ...] = ()
    blowout_s: float = 1.0e9
    blown: tuple[str, ...] = ()
    corrects: bool = True
    reaction_s: float = 0.7
    lane: Program | None = None      # lateral place to hold over time, m
    pace: Program | None = None      # speed over `speed_mps` to hold over time
