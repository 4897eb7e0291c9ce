"""Throttle to torque at the driven hubs.

References: the proving-ground map, F = throttle * P / v - drag * (1 - throttle) in top gear;
engine drag from FMEP 1.9 bar (docs/physics.md); clutch opening as in thesis L761.
Known limits: one gear; no driveline inertia beyond the hubs; each hub has a fixed share, so a hub
that spins does not take from the others.
Validated with: test/physics/test_driveline.py (map, start from rest, standing without creep, power
of wheels that spin, wheels held back on ice).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.choose import where
from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import DRIVE, DRIVE_AT
from truck_blowout_sim.physics.scalar import clip, reached, two_ratios

Floats = NDArray[np.float64]


@core
def engine(p: Floats, time_s: float, throttle: float, speed_mps: float) -> tuple[float, float]:
    """Power [W] that the engine offers, and drag [N] of engine and retarder at the wheels."""
    drag = (p[DRIVE_AT + DRIVE.drag_n] + p[DRIVE_AT + DRIVE.drag_extra_n]
            + p[DRIVE_AT + DRIVE.drag_extra_nspm] * abs(speed_mps))
    closed = max(1.0 - throttle / p[DRIVE_AT + DRIVE.retarder_throttle], 0.0)
    drag = drag * (1.0 - throttle) + p[DRIVE_AT + DRIVE.retarder_n] * closed
    opened = reached(time_s, p[DRIVE_AT + DRIVE.clutch_open_time_s])
    return (where(opened, 0.0, throttle * p[DRIVE_AT + DRIVE.power_w]),
            where(opened, p[DRIVE_AT + DRIVE.clutch_open_drag_n], drag))


@core
def hub_force_n(p: Floats, share: float, offered: tuple[float, float, float], spin_radps: float,
                radius_m: float, inertia_kgm2: float, dt: float) -> float:
    """Force [N] at the rolling radius of one driven hub, forward positive.

    ``offered``: power and drag of `engine`, and forward speed. The map is measured on the road and
    holds there while the wheel rolls; a wheel that spins takes no more power than it is offered.
    Drag fades with the spin of the hub, so that it stops a wheel and never drives it backward.
    """
    power, drag, speed = offered
    creep = p[DRIVE_AT + DRIVE.creep_speed_mps]
    rim = spin_radps * radius_m
    ahead = abs(rim) - abs(speed)
    spun = clip(2.0 * (ahead - p[DRIVE_AT + DRIVE.rolling_slip] * abs(rim)), 0.0, ahead)
    pull, fade = two_ratios(
        power, max(abs(speed) + spun, creep), rim * inertia_kgm2,
        max(creep * inertia_kgm2, dt * drag * share * radius_m * radius_m))
    return share * (min(pull, p[DRIVE_AT + DRIVE.max_force_n]) - drag * clip(fade, -1.0, 1.0))
