"""Choices that hold for one truck and for eight: the same numbers in Python, compiled, abreast."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numba import njit
from numpy.typing import NDArray

from truck_blowout_sim.physics.choose import (
    any_of,
    cosine_and_sine,
    nearest,
    pick,
    power_where,
    seldom,
    shared,
    trucks_in,
    where,
    whole,
)
from truck_blowout_sim.physics.octet import EIGHT
from truck_blowout_sim.physics.octet_arrays import octets, room_for_eight

Floats = NDArray[np.float64]


@njit(error_model="numpy")
def work(x: Floats, out: Floats) -> None:
    """Everything a step may ask of a number."""
    a, b, total = x[0], x[1], 0.0
    for k in range(3):
        total += x[k] * 2.0
    big = (a > 1.0) & (b < 100)
    if any_of(big):
        total = where(big, math.sqrt(abs(total)), total)
    if seldom(b > 1.0):
        b = where(b > 1.0, 1.0 / b, b)
    out[0], out[1], out[2] = total, -b, power_where(a > 2.0, a, 0.5)
    out[3] = pick(x, whole(min(abs(a), 2.0)))
    out[4] = math.atan2(a, total) + math.asin(where(abs(a) < 1.0, a, 0.0)) + math.tanh(a)
    out[5], out[6] = nearest(a / 3.0), max(a, total, 1.0)
    out[7] = where((a == b) | (a != a), 7, 8)
    out[7] -= 1
    out[8], out[9] = cosine_and_sine(4.0 * a)


@njit(error_model="numpy")
def abreast(x: Floats, out: Floats) -> int:
    work(octets(x), octets(out))
    return trucks_in(octets(x)[0:1]) + 10 * trucks_in(x)


@njit(error_model="numpy")
def first_of(x: Floats) -> float:
    return shared(octets(x)[0])


@pytest.mark.parametrize("alike", [False, True])
def test_one_truck_eight_trucks_and_python_agree(alike: bool) -> None:
    x, out = room_for_eight(4), room_for_eight(10)
    x[:] = np.random.default_rng(2).normal(1.0, 2.0, x.shape)
    if alike:
        x[:] = np.array([2.5, 1.2, -0.3, 0.8])[:, None]
    assert abreast(x, out) == EIGHT + 10
    for lane in range(EIGHT):
        python, compiled = np.zeros(10), np.zeros(10)
        work.py_func(x[:, lane], python)
        work(x[:, lane].copy(), compiled)
        np.testing.assert_allclose(compiled, python, rtol=1e-14)
        np.testing.assert_allclose(out[:, lane], python, rtol=1e-14)
    assert first_of(x) == x[0, 0]


def test_a_truck_that_is_no_longer_a_number_is_alone_in_that() -> None:
    x, out, again = room_for_eight(4, value=1.5), room_for_eight(10), room_for_eight(10)
    abreast(x, out)
    x[:, 3] = np.nan
    abreast(x, again)
    others = np.arange(EIGHT) != 3
    assert np.array_equal(out[:, others], again[:, others])
    assert np.isnan(again[:6, 3]).all()


def test_room_begins_on_a_whole_vector() -> None:
    for n in range(1, 20):
        room = room_for_eight(n, 3, value=2.0)
        assert room.shape == (n, 3, EIGHT)
        assert room.ctypes.data % 64 == 0
        assert (room == 2.0).all()
