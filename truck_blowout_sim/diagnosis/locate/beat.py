"""A periodic force that the model does not have, in words and as an equation.

Validated with: test/diagnosis/test_periodic.py.
"""

from __future__ import annotations

from dataclasses import dataclass

from truck_blowout_sim.diagnosis.result.evidence import BeatScores

HARMONICS = (1, 2, 3)  # of a wheel turn


@dataclass(frozen=True)
class Beat:
    """A periodic force that the model does not have.

    Attributes:
        turning: once per wheel turn; else at a steady pace.
        every: distance [m] of a turn, or time [s], from one beat to the next.
        score: standard errors by which the lines stand above what chance gives.
        evidence: twice the log-likelihood that the lines gain, comparable with a sum of squares.
        body: unit that shakes most; ``channel`` it shows in; ``amplitude`` there, SI.
        speed_mps: mean speed of the runs.
        scores: of everything tried, for a picture.
    """

    turning: bool
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
        return self.speed_mps / self.every if self.turning else 1.0 / self.every

    @property
    def unit(self) -> str:
        """Of the amplitude."""
        return "m/s2" if self.channel.endswith("_mps2") else "rad/s"

    @property
    def facts(self) -> tuple[tuple[str, str], ...]:
        """What stands behind it, for the page."""
        what = "once per wheel turn" if self.turning else "at a steady pace"
        return ((f"beat {what}", f"{self.pace_hz:.2f} a second, {self.score:.0f} standard errors, "
                 f"buys {self.evidence:.0f}"),)

    @property
    def equation(self) -> str:
        """For an engineer."""
        if self.turning:
            return (f"{self.channel} - model = sum_k a_k cos(2 pi k s / {self.every:.3f} m + phi_k)"
                    f", k = 1 to {HARMONICS[-1]}, root of summed a_k^2 = {self.amplitude:.3g} "
                    f"{self.unit}")
        return (f"{self.channel} - model = {self.amplitude:.3g} {self.unit} * cos(2 pi t / "
                f"{self.every:.4f} s + phi)")

    @property
    def sentence(self) -> str:
        """For a driver."""
        if self.turning:
            return (f"Something beats once per wheel turn, every {self.every:.2f} m "
                    f"({self.pace_hz:.1f} times a second at {self.speed_mps:.0f} m/s), most on the "
                    f"{self.body}: look at its tires for a loose tread, a flat spot or a bent rim.")
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
        if self.turning:
            return (f"Look at every tire and rim of the {self.body}; then drive steadily with an "
                    "accelerometer on one axle after the other: it beats most over the wheel at "
                    "fault.")
        return ("Drive at a steady speed in two gears, then coast with the clutch open: what then "
                "beats on does not come from the engine.")
