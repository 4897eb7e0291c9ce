"""When a hypothesis counts: significance, plausibility, and what it must earn against others.

Validated with: test/diagnosis/test_sensors_solve.py (calibration on runs without a fault).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.stats import chi2 as chi2_law

from truck_blowout_sim.diagnosis.sensors.case import Case, Hypothesis
from truck_blowout_sim.diagnosis.sensors.distortions import Delay, LeverArm, Scale

FloatArray = NDArray[np.float64]
# Share of sound logs in which a fault may be stated: one in fifty.
FALSE_ALARMS = 0.02
# A rival within this of the best sum of squares cannot be told from it (odds of about 90 to 1),
ALIAS_CHI2 = 9.0
# nor one that explains all but this share: the noise of the rows is itself an estimate.
ALIAS_SHARE = 0.05
_PER_PARAMETER = 2.0  # what a parameter must earn when hypotheses of different size compete
# Beyond these a "correction" would erase the channel it corrects, and every residual with it.
_FARTHEST = {"rad/s": 0.5, "scale_error": 0.8, "roll_leak": 2.0, "s": 0.6, "m": 10.0}
_NEVER_ALONE = ("_x_m", "_y_m", "_vx_mps", "_vy_mps", "_roll_rad", "_pitch_rad")
_ODD = 6.0
CLEAR = 3.0  # standard errors
_WILDEST_SCALE = 0.75  # four times too small: what reads less is dead
_NEAREST_M = 0.18  # a tape measure errs less
_AT_BOUND = 0.98  # of what a parameter can be: the search's end, not the instrument's
_FARTHEST_M = {"forward": 3.0, "left": 1.5, "up": 3.0}  # nobody errs by more; the body ends before


def family_p(delta_chi2: float, parameters: int, tests: int) -> float:
    """Chance that any of ``tests`` hypotheses gains as much from noise alone."""
    single = float(chi2_law.sf(max(delta_chi2, 0.0), parameters))
    return min(1.0, single * tests)


def admissible(hypothesis: Hypothesis, amounts: Sequence[float]) -> bool:
    """Whether the amounts, one for each parameter, make sense.

    Nothing arrives early, no gain is off by three quarters, nothing sits beside the truck.
    """
    kind = hypothesis.distortion
    if at_bound(hypothesis, amounts):
        return False
    if isinstance(kind, Delay):
        return amounts[0] > 0.0
    if isinstance(kind, LeverArm):
        inside = all(abs(a) < _FARTHEST_M[d] for d, a in zip(kind.directions, amounts, strict=True))
        return inside and max(abs(a) for a in amounts) > _NEAREST_M
    return not isinstance(kind, Scale) or abs(amounts[0]) < _WILDEST_SCALE


def farthest(hypothesis: Hypothesis) -> FloatArray:
    """How far the search follows each parameter."""
    return np.array([
        _FARTHEST[name if name in _FARTHEST else si_unit]
        for name, si_unit in hypothesis.distortion.parameters
    ])  # fmt: skip


def at_bound(hypothesis: Hypothesis, amounts: Sequence[float]) -> bool:
    """Whether a parameter was stopped by the end of the search: then it is no estimate."""
    return bool(np.any(np.abs(np.array(amounts)) >= _AT_BOUND * farthest(hypothesis)))


def determined(amounts: Sequence[float], sigmas: FloatArray) -> list[int]:
    """Parameters worth stating: those that differ from zero, at least the clearest one."""
    clear = np.abs(np.array(amounts)) / sigmas
    return [k for k in range(len(amounts)) if clear[k] > CLEAR or k == int(np.argmax(clear))]


def handicap(case: Case, hypothesis: Hypothesis) -> float:
    """What a hypothesis must earn: by its size, for contradicting a sound baseline, for oddity.

    One channel of an instrument seldom comes late alone.
    """
    distortion = hypothesis.distortion
    earned = _PER_PARAMETER * len(distortion.parameters)
    if hypothesis.everywhere and any(case.is_baseline):
        earned += ALIAS_CHI2
    if isinstance(distortion, Delay) and distortion.channels[0].endswith(_NEVER_ALONE):
        earned += _ODD if len(distortion.channels) == 1 else 0.0
    return earned
