from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from truck_blowout_sim.physics.trig import arctan, cosine, sine, turned

within_pi = st.floats(-math.pi, math.pi)


@given(st.floats(allow_nan=False))
def test_arctan_of_anything(x: float) -> None:
    assert arctan(x) == pytest.approx(math.atan(x), rel=1e-14, abs=1e-300)


@given(within_pi)
def test_sine_and_cosine_within_half_a_turn(angle: float) -> None:
    assert sine(angle) == pytest.approx(math.sin(angle), abs=1e-13)
    assert cosine(angle) == pytest.approx(math.cos(angle), abs=1e-13)


@given(st.floats(-1e-3, 1e-3))
def test_a_small_sine_keeps_its_relative_accuracy(angle: float) -> None:
    assert sine(angle) == pytest.approx(math.sin(angle), rel=1e-14, abs=1e-300)


@given(st.floats(-10.0, 10.0))
def test_cosine_and_sine_of_a_steer_angle(angle: float) -> None:
    assert turned(angle) == pytest.approx((math.cos(angle), math.sin(angle)), abs=1e-15)


def test_odd_and_even() -> None:
    assert sine(-0.3) == -sine(0.3)
    assert arctan(-2.0) == -arctan(2.0)
    assert cosine(-0.3) == cosine(0.3)
