"""Scalar helpers of the core: limits, dead zone, displacement-driven friction.

References: Fancher's leaf form F = F_env + (F_old - F_env) exp(-|d|/beta), with the exponential
replaced by 1/(1 + |d|/beta), equal to first order for the small moves of one step.
Known limits: friction has no Stribeck rise.
Validated with: test/physics/test_scalar.py.
"""

from __future__ import annotations

import math

from truck_blowout_sim.physics.choose import where
from truck_blowout_sim.physics.jit import core

EDGE_S = 1e-9  # slack of an instant: step edges are sums of steps, which round
_EDGE_SHARE = 1e-9  # the same of a time over its duration


@core
def clip(value: float, low: float, high: float) -> float:
    """Limit ``value`` to [low, high]."""
    return where(value < low, low, where(value > high, high, value))


@core
def finite(value: float) -> bool:
    """Whether it is a number and not infinite."""
    return abs(value) < math.inf


@core
def two_ratios(a: float, b: float, c: float, d: float) -> tuple[float, float]:
    """``a / b`` and ``c / d`` by one division, which takes as long as a dozen products."""
    both = 1.0 / (b * d)
    return a * d * both, c * b * both


@core
def deadzone(value: float, half_width: float) -> float:
    """Zero inside +-half_width, the excess outside."""
    return where(value > half_width, value - half_width,
                 where(value < -half_width, value + half_width, 0.0))


@core
def hysteresis(force: float, move: float, limit: float, transition: float) -> float:
    """Friction force after a ``move``, approaching +-``limit`` over the ``transition`` length.

    All in the same pair of units (N and m, or N m and rad).
    """
    share = abs(move) / (transition + abs(move))
    envelope = where(move > 0.0, limit, -limit)
    return force + (envelope - force) * share


@core
def reached(time_s: float, at_s: float) -> bool:
    """Whether an instant has come; one on a step edge comes at that edge, however it rounds."""
    return time_s >= at_s - EDGE_S


@core
def ramp(time_s: float, start_s: float, end_s: float, rise_s: float) -> float:
    """0 before start, 1 from it on, 0 from end on, with smooth flanks of ``rise_s``."""
    up = where(rise_s > 0.0, smooth((time_s - start_s) / rise_s), 1.0)
    down = where(rise_s > 0.0, smooth((time_s - end_s) / rise_s), 0.0)
    during = reached(time_s, start_s) & (time_s < end_s + rise_s - EDGE_S)
    return where(during, up - down, 0.0)


@core
def smooth(share: float) -> float:
    """Cubic step from 0 to 1 as ``share`` runs from 0 to 1."""
    s = clip(share, 0.0, 1.0)
    return s * s * (3.0 - 2.0 * s)


@core
def smooth_slopes(share: float) -> tuple[float, float]:
    """First and second derivative of :func:`smooth`; zero where it has ended."""
    over = (share <= _EDGE_SHARE) | (share >= 1.0 - _EDGE_SHARE)
    return (where(over, 0.0, 6.0 * share * (1.0 - share)),
            where(over, 0.0, 6.0 - 12.0 * share))
