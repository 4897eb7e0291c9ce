"""Scalar helpers of the core: limits, dead zone, displacement-driven friction.

References: Fancher's leaf form F = F_env + (F_old - F_env) exp(-|d|/beta), with the exponential
replaced by 1/(1 + |d|/beta), equal to first order for the small moves of one step.
Known limits: friction has no Stribeck rise.
Validated with: test/physics/test_scalar.py.
"""

from __future__ import annotations

from truck_blowout_sim.physics.jit import core


@core
def clip(value: float, low: float, high: float) -> float:
    """Limit ``value`` to [low, high]."""
    return low if value < low else (high if value > high else value)


@core
def deadzone(value: float, half_width: float) -> float:
    """Zero inside +-half_width, the excess outside."""
    if value > half_width:
        return value - half_width
    if value < -half_width:
        return value + half_width
    return 0.0


@core
def hysteresis(force: float, move: float, limit: float, transition: float) -> float:
    """Friction force after a ``move``, approaching +-``limit`` over the ``transition`` length.

    All in the same pair of units (N and m, or N m and rad).
    """
    share = abs(move) / (transition + abs(move))
    envelope = limit if move > 0.0 else -limit
    return force + (envelope - force) * share


@core
def ramp(time_s: float, start_s: float, end_s: float, rise_s: float) -> float:
    """0 before start, 1 between, 0 after end, with smooth flanks of ``rise_s``."""
    if time_s <= start_s or time_s >= end_s + rise_s:
        return 0.0
    up = smooth((time_s - start_s) / rise_s) if rise_s > 0.0 else 1.0
    down = smooth((time_s - end_s) / rise_s) if rise_s > 0.0 else 0.0
    return up - down


@core
def smooth(share: float) -> float:
    """Cubic step from 0 to 1 as ``share`` runs from 0 to 1."""
    s = clip(share, 0.0, 1.0)
    return s * s * (3.0 - 2.0 * s)


@core
def smooth_slopes(share: float) -> tuple[float, float]:
    """First and second derivative of :func:`smooth`; zero where it has ended."""
    if share <= 0.0 or share >= 1.0:
        return 0.0, 0.0
    return 6.0 * share * (1.0 - share), 6.0 - 12.0 * share
