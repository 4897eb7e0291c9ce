from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from proving_ground.laws import usual
from proving_ground.tire import cornering_slope, steady_curve, steady_forces, trail_fraction

LAWS = usual()
LOAD = st.floats(2.0e3, 45.0e3)
SLIP = st.floats(-1.0, 1.0)


def test_curve_has_its_slope_peak_and_slide() -> None:
    slope, at, peak, slide_at, slide = 1.6e5, 0.28, 2.0e4, 0.85, 1.5e4
    small = 1.0e-5
    assert steady_curve(small, slope, at, peak, slide_at, slide) / small == pytest.approx(
        slope, rel=1e-3)
    assert steady_curve(at, slope, at, peak, slide_at, slide) == pytest.approx(peak)
    assert steady_curve(2.0, slope, at, peak, slide_at, slide) == slide
    assert max(steady_curve(0.01 * k, slope, at, peak, slide_at, slide)
               for k in range(100)) <= peak * (1 + 1e-12)


@pytest.mark.parametrize(("load", "stiffness"), [(9.81e3, 68.9e3), (24.5e3, 160.2e3),
                                                  (39.2e3, 226.7e3)])
def test_cornering_stiffness_meets_the_sheet(load: float, stiffness: float) -> None:
    assert cornering_slope(load, 1.0, LAWS) == pytest.approx(stiffness, rel=0.05)


def test_soft_tire_corners_stiffer_before_it_collapses() -> None:
    assert 1.1 < cornering_slope(26.5e3, 0.6, LAWS) / cornering_slope(26.5e3, 1.0, LAWS) < 1.35


@given(LOAD, SLIP, SLIP, st.floats(0.1, 1.0))
def test_force_stays_inside_the_friction_limit(
        load: float, sx: float, sy: float, friction: float) -> None:
    fx, fy, _ = steady_forces(load, sx, sy, cornering_slope(load, 1.0, LAWS), friction, 1.0, LAWS)
    assert math.hypot(fx, fy) <= 0.95 * friction * load
    assert fx * sx >= 0.0
    assert fy * sy >= 0.0


@given(LOAD, st.floats(1e-4, 1.0))
def test_force_is_odd_in_slip(load: float, slip: float) -> None:
    slope = cornering_slope(load, 1.0, LAWS)
    _, there, _ = steady_forces(load, 0.0, slip, slope, 1.0, 1.0, LAWS)
    _, back, _ = steady_forces(load, 0.0, -slip, slope, 1.0, 1.0, LAWS)
    assert there == -back


def test_trail_falls_through_zero_and_dies_out() -> None:
    assert trail_fraction(0.0) == 1.0
    assert trail_fraction(0.1) > trail_fraction(0.19) > 0.0 > trail_fraction(0.25)
    assert trail_fraction(0.5) == 0.0
