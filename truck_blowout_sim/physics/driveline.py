"""Throttle to net force at the driven wheels.

References: the proving-ground map, F = throttle * P / v - drag * (1 - throttle) in top gear;
engine drag from FMEP 1.9 bar (docs/physics.md); clutch opening as in thesis L761.
Known limits: one gear; no driveline inertia beyond the hubs; equal torque at all driven hubs.
Validated with: test/physics/test_driveline.py (map, start from rest, standing without creep).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.choose import where
from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import DRIVE, DRIVE_AT
from truck_blowout_sim.physics.scalar import clip

Floats = NDArray[np.float64]


@core
def net_force_n(p: Floats, time_s: float, throttle: float, speed_mps: float) -> float:
    """Net force [N] at the driven wheels, forward positive."""
    creep = p[DRIVE_AT + DRIVE.creep_speed_mps]
    fade = clip(speed_mps / creep, -1.0, 1.0)
    pull = throttle * p[DRIVE_AT + DRIVE.power_w] / max(abs(speed_mps), creep)
    pull = min(pull, p[DRIVE_AT + DRIVE.max_force_n])
    drag = (p[DRIVE_AT + DRIVE.drag_n] + p[DRIVE_AT + DRIVE.drag_extra_n]
            + p[DRIVE_AT + DRIVE.drag_extra_nspm] * abs(speed_mps))
    closed = max(1.0 - throttle / p[DRIVE_AT + DRIVE.retarder_throttle], 0.0)
    drag = drag * (1.0 - throttle) + p[DRIVE_AT + DRIVE.retarder_n] * closed
    return where(time_s >= p[DRIVE_AT + DRIVE.clutch_open_time_s],
                 -p[DRIVE_AT + DRIVE.clutch_open_drag_n] * fade, pull - drag * fade)
