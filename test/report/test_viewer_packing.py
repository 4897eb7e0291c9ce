"""Numbers that go into a page come out again, rounded to their quantum."""

from __future__ import annotations

import hypothesis.strategies as st
import numpy as np
import pytest
from hypothesis import given
from hypothesis.extra.numpy import arrays

from truck_blowout_sim.report.viewer.packing import Packer, unpacked

NUMBERS = arrays(np.float64, st.integers(0, 60), elements=st.floats(-1e6, 1e6))


@given(NUMBERS, NUMBERS)
def test_two_series_return_within_half_a_quantum(first: np.ndarray, second: np.ndarray) -> None:
    packer = Packer()
    entries = [packer.add(first), packer.add(second, 1e-3)]
    text = packer.text()
    for entry, values in zip(entries, (first, second), strict=True):
        assert unpacked(entry, text) == pytest.approx(values, abs=0.5001 * entry["step"] + 1e-9)


def test_smooth_signals_take_little_more_than_a_byte_a_sample() -> None:
    packer = Packer()
    packer.add(np.sin(np.linspace(0.0, 20.0, 2000)))
    assert len(packer.text()) < 1.5 * 2000
