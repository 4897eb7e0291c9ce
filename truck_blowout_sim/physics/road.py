"""The road under a tire: height, friction; gravity on grade and bank.

The map's x-y plane is the road's mean plane; grade and bank tilt gravity against it.

References: roughness as a sum of eight sines, an ISO 8608-like slope of the spectrum (amplitude
proportional to wavelength).
Known limits: grade and bank each change once, for the whole truck at a time; one friction patch.
Validated with: test/physics/test_road.py (rms height, force balance on a grade, slopes that begin).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.choose import any_of, where
from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import WORLD, WORLD_AT
from truck_blowout_sim.physics.scalar import reached
from truck_blowout_sim.physics.trig import heading, turned

Floats = NDArray[np.float64]
_WAVES = 8
_LONGEST_M = 20.0
_RATIO = 0.62
_TURN_RAD = 2.399963  # golden angle: phases of no two waves meet
_ACROSS_RADPM = 1.7  # how fast a wave's phase turns across the road
_LEAST_RAMP_S = 1e-3  # a ramp of no length is a step
# norm of the amplitudes _RATIO**k for unit rms
_NORM = math.sqrt(2.0 * (1.0 - _RATIO**2) / (1.0 - _RATIO ** (2 * _WAVES)))


@core
def height(p: Floats, x_m: float, y_m: float) -> float:
    """Road height [m] at a place in map."""
    rms = p[WORLD_AT + WORLD.road_roughness_m]
    if not any_of(rms != 0.0):
        return 0.0
    total = 0.0
    seed = p[WORLD_AT + WORLD.road_roughness_seed]
    amplitude = rms * _NORM
    wavelength = _LONGEST_M
    for k in range(_WAVES):
        phase = _TURN_RAD * (k + 1) * (1.0 + seed) + _ACROSS_RADPM * y_m
        total += amplitude * heading(2.0 * math.pi * x_m / wavelength + phase)[1]
        amplitude *= _RATIO
        wavelength *= _RATIO
    return total


@core
def friction(p: Floats, time_s: float, past_m: float, x_m: float, y_m: float) -> float:
    """Scale of tire-road friction at a place and time.

    ``past_m``: how far the tire is past the place where the foremost axle was when it met another
    friction; those behind meet it later.
    """
    scale = p[WORLD_AT + WORLD.friction_scale]
    met = reached(time_s, p[WORLD_AT + WORLD.friction_change_time_s]) & (past_m >= 0.0)
    changed = (x_m >= p[WORLD_AT + WORLD.friction_change_x_m]) | met
    scale = where(changed, scale * p[WORLD_AT + WORLD.friction_change_scale], scale)
    patched = ((p[WORLD_AT + WORLD.patch_x0_m] <= x_m) & (x_m <= p[WORLD_AT + WORLD.patch_x1_m])
               & (p[WORLD_AT + WORLD.patch_y0_m] <= y_m) & (y_m <= p[WORLD_AT + WORLD.patch_y1_m]))
    return where(patched, scale * p[WORLD_AT + WORLD.patch_scale], scale)


@core
def _share(since_s: float, ramp_s: float) -> float:
    """Share of its length that a ramp has run."""
    return min(max(since_s / max(ramp_s, _LEAST_RAMP_S), 0.0), 1.0)


@core
def _eased(since_s: float, ramp_s: float) -> float:
    """Share of a change that has come about: smooth, as axles enter a slope one after another."""
    s = _share(since_s, ramp_s)
    return s * s * (3.0 - 2.0 * s)


@core
def _easing(since_s: float, ramp_s: float) -> float:
    """Rate [1/s] of :func:`_eased`."""
    s = _share(since_s, ramp_s)
    return 6.0 * s * (1.0 - s) / max(ramp_s, _LEAST_RAMP_S)


@core
def turning(p: Floats, time_s: float) -> tuple[float, float]:
    """Angular velocity [rad/s] of the road about the map's x and y axes while a slope begins."""
    grading = p[WORLD_AT + WORLD.grade_change_rad] * _easing(
        time_s - p[WORLD_AT + WORLD.grade_change_time_s], p[WORLD_AT + WORLD.grade_change_ramp_s])
    banking = p[WORLD_AT + WORLD.bank_change_rad] * _easing(
        time_s - p[WORLD_AT + WORLD.bank_change_time_s], p[WORLD_AT + WORLD.bank_change_ramp_s])
    return banking, -grading


@core
def gravity(p: Floats, time_s: float) -> tuple[float, float, float]:
    """Gravity [m/s^2] in map axes of a road with grade (uphill along x) and bank (left high)."""
    g = p[WORLD_AT + WORLD.gravity_mps2]
    grade, bank = p[WORLD_AT + WORLD.road_grade_rad], p[WORLD_AT + WORLD.road_bank_rad]
    grade += p[WORLD_AT + WORLD.grade_change_rad] * _eased(
        time_s - p[WORLD_AT + WORLD.grade_change_time_s], p[WORLD_AT + WORLD.grade_change_ramp_s])
    bank += p[WORLD_AT + WORLD.bank_change_rad] * _eased(
        time_s - p[WORLD_AT + WORLD.bank_change_time_s], p[WORLD_AT + WORLD.bank_change_ramp_s])
    cos_grade, sin_grade = turned(grade)
    cos_bank, sin_bank = turned(bank)
    return -g * sin_grade, -g * sin_bank * cos_grade, -g * cos_grade * cos_bank
