"""Air brakes: transport delay, chamber lag, torque quadratic in pressure, fade, locking.

References: thesis L615 (quadratic torque); FMVSS 121 timing; S-cam placeholder values in YAML.
Known limits: fade follows dissipated energy without cooling; no hysteresis of the foundation brake.
Validated with: test/physics/test_brakes.py (torque curve, delay and lag against the closed form,
a locked wheel stays locked).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.choose import pick, shared, where, whole
from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import (
    CIRCUIT,
    CIRCUIT_AT,
    CIRCUIT_SIZE,
    GLOBAL_S,
    HUB,
    HUB_S,
    INPUT,
    N_CIRCUITS,
    TOPOLOGY,
)
from truck_blowout_sim.physics.places import brake_line
from truck_blowout_sim.physics.scalar import clip

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
_LEAST_LAG_S = 1e-6  # a chamber without a lag follows at once


@core
def write_lines(x: Floats, topo: Integers, inputs: Floats) -> None:
    """Put the control pressures of this step into the delay lines."""
    n = topo[TOPOLOGY.line_length]
    position = int(shared(x[GLOBAL_S.line_position])) + 1
    if position >= n:
        position = 0
    x[GLOBAL_S.line_position] = position
    for c in range(N_CIRCUITS):
        pressed = max(inputs[INPUT.brake_pressure_steer_pa + c], 0.0)
        x[brake_line(topo, c) + position] = pressed


@core
def delayed_pa(x: Floats, p: Floats, topo: Integers, circuit: int, dt: float) -> float:
    """Control pressure [Pa] as it was one transport delay ago, interpolated."""
    n = topo[TOPOLOGY.line_length]
    at = CIRCUIT_AT + circuit * CIRCUIT_SIZE
    delay = (p[at + CIRCUIT.delay_s] + p[at + CIRCUIT.delay_extra_s]) / dt
    back = x[GLOBAL_S.line_position] - clip(delay, 0.0, n - 2.0)
    back = where(back < 0.0, back + n, back)
    back = where(back < n, back, 0.0)  # just below zero, plus n is rounded to n itself
    i = whole(back)
    j = where(i + 1 < n, i + 1, 0)
    line = brake_line(topo, circuit)
    before = pick(x, line + i)
    return before + (back - i) * (pick(x, line + j) - before)


@core
def advance_chamber(x: Floats, s: int, p: Floats, circuit: int, control_pa: float,
                    dt: float) -> None:
    """First-order lag of a chamber towards the control pressure, or zero while released."""
    at = CIRCUIT_AT + circuit * CIRCUIT_SIZE
    target = where(x[s + HUB_S.released] > 0.0, 0.0, control_pa)
    lag = max(p[at + CIRCUIT.lag_s] + p[at + CIRCUIT.lag_extra_s], _LEAST_LAG_S)
    x[s + HUB_S.chamber_pa] += (target - x[s + HUB_S.chamber_pa]) * dt / (lag + dt)


@core
def torque_nm(x: Floats, s: int, p: Floats, h: int, circuit: int) -> float:
    """Brake torque [N m] of a hub at its chamber pressure and heat."""
    at = CIRCUIT_AT + circuit * CIRCUIT_SIZE
    off = (p[h + HUB.brake_enabled] == 0.0) | (p[at + CIRCUIT.enabled] == 0.0)
    over = max(x[s + HUB_S.chamber_pa] - p[h + HUB.brake_pushout_pa], 0.0)
    torque = p[h + HUB.brake_linear_nmppa] * over - p[h + HUB.brake_quadratic_nmppa2] * over * over
    fade = 1.0 + p[at + CIRCUIT.fade_per_j] * x[s + HUB_S.heat_j]
    return where(off, 0.0, max(torque, 0.0) * p[h + HUB.brake_gain] / max(fade, 0.05))


@core
def advance_spin(x: Floats, s: int, inertia: float, free_nm: float, brake_nm: float,
                 dt: float) -> float:
    """Advance a hub's spin; the brake stops it but never drives it. Returns the torque used."""
    free = x[s + HUB_S.spin_radps] + dt * free_nm / inertia
    bite = dt * brake_nm / inertia
    forward, backward = free > bite, free < -bite
    spin = where(forward, free - bite, where(backward, free + bite, 0.0))
    used = where(forward, brake_nm, where(backward, -brake_nm, free * inertia / dt))
    x[s + HUB_S.heat_j] += dt * used * 0.5 * (spin + x[s + HUB_S.spin_radps])
    x[s + HUB_S.spin_radps] = spin
    x[s + HUB_S.angle_rad] += dt * spin
    x[s + HUB_S.brake_nm] = used
    return used
