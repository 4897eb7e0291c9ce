"""A channel that moves on where everything named is in force: more than baseline runs let it.

The missing wrench (`wrench.py`) weighs a force on a whole body; a small one that swings shows in
one channel first. What everything named, and calibration, leave of each channel in training is held
against what they leave in the baseline runs of the same truck, by the test of `by_chance.py`.

References: as `by_chance.py`; Bonferroni 1936 (several channels are asked).
Known limits: says that something acts and where it shows, not what; says nothing without baseline
runs, and nothing where an instrument was found faulty.
Validated with: test/diagnosis/test_restless.py (a load that swings is noticed, a calm truck not).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.study import Study, row_ranges
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.locate.by_chance import chance_of, most_by_chance
from truck_blowout_sim.diagnosis.locate.comparable import Left
from truck_blowout_sim.diagnosis.locate.left_over import GUESSED

Floats = NDArray[np.float64]
_UNITS = (("_mps2", "m/s2"), ("_mps", "m/s"), ("_radps", "rad/s"), ("_rad", "rad"))
_NAMES = (("_vx_mps", "speed"), ("_vy_mps", "lateral speed"), ("_yaw_rate_radps", "yaw rate"),
          ("_ay_mps2", "lateral acceleration"), ("_ax_mps2", "longitudinal acceleration"))


@dataclass(frozen=True)
class Restless:
    """A channel that no known effect calms.

    Attributes:
        body: unit whose channel it is.
        left: root mean square of what is left, SI; ``usual``: the most that chance leaves of it
            beside these baseline runs.
        evidence: sum of squares beyond the usual.
    """

    body: str
    channel: str
    left: float
    usual: float
    evidence: float

    @property
    def equation(self) -> str:
        """For an engineer."""
        unit = next((unit for end, unit in _UNITS if self.channel.endswith(end)), "")
        return (f"rms({self.channel} - model) = {self.left:.3g} {unit}; baseline runs allow "
                f"{self.usual:.3g} at most")

    @property
    def sentence(self) -> str:
        """For a driver."""
        what = next((name for end, name in _NAMES if self.channel.endswith(end)), "motion")
        return (f"The {self.body}'s {what} moves in a way that no known effect explains, "
                f"{self.left / self.usual:.1f} times as much as the baseline runs allow.")

    @property
    def next_test(self) -> str:
        """What would find its cause."""
        return (f"Repeat the run at another speed, then with another load: whether the {self.body} "
                "moves on by itself, with the speed or with the hand wheel tells what makes it.")


@dataclass(frozen=True)
class Unrest:
    """What moves on by itself.

    Attributes:
        channel: the one that is farthest beyond what baseline runs allow, if one is.
        chance: that any channel moves so much more where nothing is missing.
    """

    channel: Restless | None = None
    chance: float = 1.0


def unrest(study: Study, named: Sequence[Hypothesis]) -> Unrest:
    """What moves on in training. Study's models have ``named`` in force."""
    if not study.baseline:
        return Unrest()
    clean = Left.of(study, study.models, named, comparable=True)
    channels = [c for c in dict.fromkeys(c for i in study.train for c in study.runs[i].channels)
                if c.endswith(tuple(end for end, _ in _NAMES))]
    judged = [_judge(study, clean, name, len(channels)) for name in channels]
    return Unrest(
        max((one for one, _ in judged if one is not None), key=lambda one: one.evidence,
            default=None),
        min(len(channels) * min((chance for _, chance in judged), default=1.0), 1.0))


def _judge(study: Study, clean: Left, channel: str, asked: int) -> tuple[Restless | None, float]:
    """A channel, if more of it is left than baseline runs allow one of ``asked`` channels.

    With the chance that so much is left of this one where nothing is missing.
    """
    parts, base = ([_left(study, clean, channel, i) for i in which
                    if channel in study.runs[i].channels]
                   for which in (study.train, study.baseline))
    train, still = ([square for left, _ in group if (square := _mean_square(left)) > 0.0]
                    for group in (parts, base))
    if not train or not still:
        return None, 1.0
    still.append(GUESSED)
    chance = chance_of(train, still)
    usual = float(np.sqrt(most_by_chance(train, still, study.settings.alarms_by_rest / asked)))
    typical = float(np.exp(0.5 * np.mean(np.log(train))))
    if typical <= usual:
        return None, chance
    left, plain = (np.concatenate(one) for one in zip(*parts, strict=True))
    size = float(np.sqrt(_mean_square(plain)))
    return Restless(channel.split("_", 1)[0], channel, size, size * usual / typical,
                    float(left @ left - left.size * usual**2)), chance


def _left(study: Study, clean: Left, channel: str, i: int) -> tuple[Floats, Floats]:
    """What is left of a channel in one run, whitened, and in the channel's unit."""
    run = study.runs[i]
    k = run.channels.index(channel)
    seen = np.isfinite(run.measured[:, k]) & clean.rows_of(study, i)
    removed = clean.removed[row_ranges(study)[i]]
    return removed.reshape(run.measured.shape)[seen, k], run.plain(removed)[seen, k]


def _mean_square(values: Floats) -> float:
    return float(np.mean(values**2)) if values.size else 0.0
