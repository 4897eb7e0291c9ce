"""Anti-lock control: per-wheel slip threshold, or the 4S/4M tractor with 2S/1M trailer.

References: thesis L627 (off at 0.08, on at 0.06, cut-out speed); Bendix and Eaton descriptions:
one trailer modulator for all four chambers, the slower sensed wheel decides; trailing axle sensed.
Known limits: reference speed is the true body speed; no pressure-build steps, one hold time.
Validated with: test/physics/test_abs.py (thresholds, cut-out, axle control).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.choose import where
from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import ABS, ABS_AT, HUB_S

Floats = NDArray[np.float64]


@core
def decide(x: Floats, s: int, p: Floats, slip: float, speed_mps: float, dt: float) -> None:
    """Set or clear the release flag of the hub at state ``s`` from the sensed ``slip``.

    ``slip``: of braking positive, whichever way the truck rolls.
    """
    off = (p[ABS_AT + ABS.mode] == 0.0) | (abs(speed_mps) < p[ABS_AT + ABS.cutout_speed_mps])
    released = x[s + HUB_S.released] > 0.0
    held_s = x[s + HUB_S.hold_s] + dt
    ends = (slip < p[ABS_AT + ABS.slip_on]) & (held_s >= p[ABS_AT + ABS.hold_s])
    slips = slip > p[ABS_AT + ABS.slip_off]
    held_s = where(released, held_s, where(slips, 0.0, x[s + HUB_S.hold_s]))
    release = where(released, where(ends, 0.0, 1.0), where(slips, 1.0, 0.0))
    x[s + HUB_S.hold_s] = where(off, x[s + HUB_S.hold_s], held_s)
    x[s + HUB_S.released] = where(off, 0.0, release)
