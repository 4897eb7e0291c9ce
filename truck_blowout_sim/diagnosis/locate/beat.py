"""A periodic force that the model does not have, in words and as an equation.

Validated with: test/diagnosis/test_periodic.py.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import degrees
from typing import Literal

from truck_blowout_sim.diagnosis.result.evidence import BeatScores

HARMONICS = (1, 2, 3)  # of a wheel turn
# once per wheel turn; at a steady pace along the course; from side to side at an even distance
Kind = Literal["turning", "steady", "swinging"]


@dataclass(frozen=True)
class Beat:
    """A periodic force that the model does not have.

    Attributes:
        kind: how it beats.
        every: distance [m], or of a steady pace time [s], from one beat to the next.
        score: standard errors by which the lines stand above what chance gives.
        evidence: twice the log-likelihood that the lines gain, comparable with a sum of squares.
        body: unit that shakes most; ``channel`` it shows in; ``amplitude`` there, SI.
        speed_mps: mean speed of the runs.
        scores: of everything tried, for a picture.
    """

    kind: Kind
    every: float
    score: float
    evidence: float
    body: str
    channel: str
    amplitude: float
    speed_mps: float
    scores: BeatScores

    @property
    def pace_hz(self) -> float:
        """Beats a second at the mean speed."""
        return 1.0 / self.every if self.kind == "steady" else self.speed_mps / self.every

    @property
    def unit(self) -> str:
        """Of the amplitude."""
        return "m/s2" if self.channel.endswith("_mps2") else "rad/s"

    @property
    def facts(self) -> tuple[tuple[str, str], ...]:
        """What stands behind it, for the page."""
        what = {"turning": "once per wheel turn", "steady": "at a steady pace",
                "swinging": "at an even distance"}[self.kind]
        return ((f"beat {what}", f"{self.pace_hz:.2f} a second, {self.score:.0f} standard errors, "
                 f"buys {self.evidence:.0f}"),)

    @property
    def equation(self) -> str:
        """For an engineer."""
        if self.kind == "turning":
            return (f"{self.channel} - model = sum_k a_k cos(2 pi k s / {self.every:.3f} m + phi_k)"
                    f", k = 1 to {HARMONICS[-1]}, root of summed a_k^2 = {self.amplitude:.3g} "
                    f"{self.unit}")
        phase = f"t / {self.every:.4f} s" if self.kind == "steady" else f"s / {self.every:.1f} m"
        return (f"{self.channel} - model = {self.amplitude:.3g} {self.unit} * "
                f"cos(2 pi {phase} + phi)")

    @property
    def sentence(self) -> str:
        """For a driver."""
        if self.kind == "turning":
            return (f"Something beats once per wheel turn, every {self.every:.2f} m "
                    f"({self.pace_hz:.1f} times a second at {self.speed_mps:.0f} m/s), most on the "
                    f"{self.body}: look at its tires for a loose tread, a flat spot or a bent rim.")
        if self.kind == "swinging":
            return (f"The {self.body} swings from side to side every {self.every:.0f} m "
                    f"({self.pace_hz:.1f} times a second at {self.speed_mps:.0f} m/s), by "
                    f"{degrees(self.amplitude):.2g} deg/s of yaw rate, which neither the hand "
                    "wheel nor a known effect explains.")
        return (f"The {self.body} surges {self.pace_hz:.2f} times a second at a steady pace, which "
                "neither the pedals nor a known effect explains.")

    @property
    def ordinary(self) -> str:
        """For a driver, where no baseline run tells that it is new."""
        return (f"The {self.body} shakes once per wheel turn, by {self.amplitude:.2g} {self.unit}. "
                "Every sound wheel does so a little; without baseline runs this is no sign of a "
                "fault.")

    @property
    def next_test(self) -> str:
        """What would find its cause."""
        if self.kind == "swinging":
            return ("Drive the same road again, at another speed and the other way: what then "
                    "swings at the same places comes from the road, what swings at the same "
                    f"distances from the air behind the {self.body}.")
        if self.kind == "turning":
            return (f"Look at every tire and rim of the {self.body}; then drive steadily with an "
                    "accelerometer on one axle after the other: it beats most over the wheel at "
                    "fault.")
        return ("Drive at a steady speed in two gears, then coast with the clutch open: what then "
                "beats on does not come from the engine.")
