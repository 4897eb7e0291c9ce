"""A hand wheel that reads late: the truck would answer before it is asked.

A steering, a tire and a body follow the hand wheel; none leads it. The hand wheel that a motion
needs (front slip geometry, lateral and yaw acceleration) is compared with the recorded one at
every shift between them. Where the best shift says that the truck leads by more than the sampling
and the smoothing of a sound log explain, the hand wheel's clock is late.

Known limits: a truck that itself follows late (tires at low speed, play) hides as much of a delay;
a truck that follows later than the model is no matter of this check.
Validated with: test/diagnosis/test_sensors_steering.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm

from truck_blowout_sim.diagnosis.sensors.distortions import Delay
from truck_blowout_sim.diagnosis.sensors.findings import Amount, SensorFinding
from truck_blowout_sim.diagnosis.sensors.signals import WHEEL
from truck_blowout_sim.diagnosis.sensors.words import equation, sentence

FloatArray = NDArray[np.float64]

_FARTHEST_S, _SPACING_S = 0.6, 0.02
_BLOCK_S = 10.0
_LEAST_BLOCKS = 4
_SOUND_S = 0.05  # half a sample of a 10 Hz log: what two clocks of one logger differ by
_SIGNIFICANT = 4.0
_NEXT = "record the angle of the road wheels, or tap the hand wheel while standing on loose ground"


@dataclass(frozen=True)
class Steered:
    """One run on its even grid: the hand wheel, what the motion needs of it, and where it counts.

    Attributes:
        wheel: recorded angle.
        motion: columns that together make the angle, up to their gains.
        used: samples before any blowout and off the brakes.
        period_s: of the grid.
    """

    wheel: FloatArray
    motion: FloatArray
    used: NDArray[np.bool_]
    period_s: float


def late_wheel(runs: Sequence[Steered]) -> SensorFinding | None:
    """The finding that the hand wheel reads late, if it does.

    Args:
        runs: those in which the fault may be.
    """
    shifts = np.arange(-_FARTHEST_S, _FARTHEST_S + 0.5 * _SPACING_S, _SPACING_S)
    blocks = [block for run in runs for block in _blocks(run, shifts)]
    if len(blocks) < _LEAST_BLOCKS:
        return None
    gathered = np.array(blocks)  # [block, shift, moments]
    delay = _best(gathered.sum(axis=0), shifts)
    # leaving one block out after the other: the scatter of the estimate, whatever colours the noise
    left = np.array([_best(gathered.sum(axis=0) - one, shifts) for one in gathered])
    count = len(blocks)
    sigma = float(np.sqrt((count - 1) / count * np.sum((left - left.mean()) ** 2)))
    sigma = float(np.hypot(sigma, 0.5 * _SPACING_S))
    beyond = delay - _SOUND_S
    if beyond < _SIGNIFICANT * sigma or delay >= _FARTHEST_S - _SPACING_S:
        return None
    return _finding(delay, sigma, beyond)


def _blocks(run: Steered, shifts: FloatArray) -> list[FloatArray]:
    """Moments of wheel and motion at every shift, stretch by stretch."""
    length = max(1, round(_BLOCK_S / run.period_s))
    steps = np.round(shifts / run.period_s).astype(int)
    margin = int(np.abs(steps).max())
    found = []
    for start in range(margin, run.wheel.size - margin - length + 1, length):
        part = slice(start, start + length)
        kept = run.used[part] & np.isfinite(run.motion[part]).all(axis=1)
        if kept.sum() < length // 2:
            continue
        motion = np.column_stack([np.ones(int(kept.sum())), run.motion[part][kept]])
        moments = []
        for step in steps.tolist():
            wheel = run.wheel[start + step : start + step + length][kept]
            joined = np.column_stack([motion, wheel])
            moments.append(joined.T @ joined)
        if all(np.isfinite(m).all() for m in moments):
            found.append(np.array(moments))
    return found


def _best(moments: FloatArray, shifts: FloatArray) -> float:
    """Shift of the wheel at which the motion explains it best, between the grid's points."""
    left = np.array([_unexplained(m) for m in moments])
    k = int(np.clip(np.argmin(left), 1, left.size - 2))
    bend = left[k - 1] - 2.0 * left[k] + left[k + 1]
    inside = 0.5 * (left[k - 1] - left[k + 1]) / bend if bend > 0.0 else 0.0
    return float(shifts[k] + np.clip(inside, -1.0, 1.0) * (shifts[1] - shifts[0]))


def _unexplained(moment: FloatArray) -> float:
    """Share of the wheel's variance that the motion leaves."""
    a, b, c = moment[:-1, :-1], moment[:-1, -1], float(moment[-1, -1])
    scale = np.sqrt(np.diag(a)) + 1e-12
    solved = np.linalg.lstsq(a / np.outer(scale, scale), b / scale, rcond=1e-9)[0]
    mean = float(b[0]) / float(a[0, 0])
    spread = c - mean**2 * float(a[0, 0])
    return (c - float((b / scale) @ solved)) / max(spread, 1e-300)


def _finding(delay_s: float, sigma_s: float, beyond_s: float) -> SensorFinding:
    distortion = Delay("channel_delay", "", "hand wheel", (WHEEL,))
    return SensorFinding(
        name="channel_delay", body="tractor", instrument="hand wheel", channels=(WHEEL,),
        parameters={"delay": Amount.about(delay_s, "s", sigma_s)},
        delta_chi2=(beyond_s / sigma_s) ** 2, p_value=float(norm.sf(beyond_s / sigma_s)),
        aliases=("channel_delay",),
        in_baseline=False, sentence=sentence(distortion, (delay_s,), (sigma_s,)),
        equation=equation("channel_delay"), next_test=_NEXT, distortion=distortion)  # fmt: skip
