"""When a vehicle spins: what follows says little about its numbers.

From then on small differences grow. The model, driven open-loop by the recorded inputs, soon heads
elsewhere, and what it seems to lack is another in each run. So a run counts up to there.

Side slip grows at the yaw rate less lateral acceleration over speed. What adds up within two
seconds tells a spin from a turn and from an offset of a gyro.

References: Inagaki et al. 1994 (side slip and its rate as the limit of control).
Known limits: of the foremost unit, so a trailer may swing out unseen; an accelerometer that leans
by 0.1 rad feigns 0.2 rad of slip at 10 m/s; how far is a judgment.
Validated with: test/diagnosis/test_sliding.py.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from truck_blowout_sim.recordings import Recording

_SPUN_RAD = 0.5  # a vehicle that slips sideways by so much more is brought back by no steering
_WITHIN_S = 2.0
_FAST_MPS = 5.0  # slower, a small acceleration is a large angle


def spins_at_s(recording: Recording, unit: str) -> float:
    """When a unit turns by so much more than its path does, infinite if it never does.

    Infinite, too, where yaw rate, lateral acceleration or speed is not recorded.
    """
    names = [f"{unit}_{name}" for name in ("yaw_rate_radps", "ay_mps2", "vx_mps")]
    if not all(name in recording and len(recording[name]) > 1 for name in names):
        return np.inf
    rate = recording[names[0]]
    ay, speed = (np.interp(rate.time_s, recording[name].time_s, recording[name].value)
                 for name in names[1:])
    speed = np.abs(speed)
    grows = np.where(speed > _FAST_MPS, rate.value - ay / np.maximum(speed, _FAST_MPS), 0.0)
    slip = np.concatenate(([0.0], np.cumsum(0.5 * (grows[1:] + grows[:-1])
                                            * np.diff(rate.time_s))))
    before = np.interp(rate.time_s - _WITHIN_S, rate.time_s, slip)
    spun = np.flatnonzero(np.abs(slip - before) > _SPUN_RAD)
    return float(rate.time_s[spun[0]]) if spun.size else np.inf


def spin_notes(recordings: Iterable[Recording], unit: str) -> list[str]:
    """What a reader should know of runs that are fitted up to a spin only."""
    spins = [(one.name, spins_at_s(one, unit)) for one in recordings]
    return [f"{name}: the {unit} spins at {at_s:.1f} s; what follows does not count"
            for name, at_s in spins if np.isfinite(at_s)]
