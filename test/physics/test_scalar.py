from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from truck_blowout_sim.physics.scalar import (
    clip,
    deadzone,
    hysteresis,
    ramp,
    reached,
    smooth,
)

numbers = st.floats(-1e6, 1e6)


@given(numbers)
def test_clip_keeps_inside_and_is_idempotent(value: float) -> None:
    once = clip(value, -2.0, 3.0)
    assert -2.0 <= once <= 3.0
    assert clip(once, -2.0, 3.0) == once


@given(numbers, st.floats(0.0, 1e3))
def test_dead_zone_takes_its_half_width_off(value: float, half: float) -> None:
    assert deadzone(value, half) == pytest.approx(np.sign(value) * max(abs(value) - half, 0.0))


def test_friction_approaches_its_limit_over_the_transition() -> None:
    force, step = 0.0, 1e-6
    for _ in range(2500):
        force = hysteresis(force, step, 100.0, 2.5e-3)
    # one transition length: 1 - 1/e of the way
    assert force == pytest.approx(100.0 * (1.0 - np.exp(-1.0)), rel=1e-3)


@given(st.floats(-100.0, 100.0), st.floats(-1.0, 1.0))
def test_friction_never_exceeds_its_limit(force: float, move: float) -> None:
    assert abs(hysteresis(force, move, 100.0, 2e-3)) <= 100.0 + 1e-9


def test_friction_stays_where_nothing_moves() -> None:
    assert hysteresis(37.0, 0.0, 100.0, 2e-3) == 37.0


def test_a_ramp_rises_holds_and_falls() -> None:
    values = [ramp(t, 1.0, 3.0, 0.5) for t in (0.9, 1.25, 2.0, 3.25, 3.6)]
    assert values == pytest.approx([0.0, 0.5, 1.0, 0.5, 0.0])


@pytest.mark.parametrize("step_s", [1e-3, 1.25e-3, 5e-3])
@pytest.mark.parametrize("origin_s", [0.0, -4.92])
def test_an_instant_on_a_step_edge_comes_there(origin_s: float, step_s: float) -> None:
    """However the edge was summed up: a flank of no width turns at the same step."""
    summed, instant = origin_s, origin_s + 800 * step_s
    for k in range(1, 1000):
        summed += step_s
        for time in (summed, origin_s + k * step_s):
            assert reached(time, instant) == (k >= 800)
            assert ramp(time, instant, math.inf, 0.0) == float(k >= 800)
            assert ramp(time, -math.inf, instant, 0.0) == float(k < 800)


def test_a_smooth_step_has_no_kink() -> None:
    edge = 1e-4
    assert smooth(edge) / edge < 1e-3
    assert (1.0 - smooth(1.0 - edge)) / edge < 1e-3
