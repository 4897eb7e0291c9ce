"""What stretches of time show of an event, against sums written out."""

from __future__ import annotations

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.effects.base import CHANGED_IN_S, Timing
from truck_blowout_sim.diagnosis.fit.stretches import lasting, of_stretches, stretches

COUNT = 7


@pytest.mark.parametrize("timing", ["step", "pulse", "ramp"])
def test_each_stretch_is_the_sum_or_the_mean_of_its_instants(timing: Timing) -> None:
    rng = np.random.default_rng(1)
    columns, left = rng.normal(size=(50, COUNT)), rng.normal(size=50)
    first, end = stretches(timing, COUNT)
    slope, bend = of_stretches(timing, columns.T @ left, columns.T @ columns, first, end)
    join = np.mean if timing == "ramp" else np.sum
    for a, b, s, w in zip(first, end, slope, bend, strict=True):
        column = join(columns[:, a:b], axis=1)
        assert s == pytest.approx(column @ left)
        assert w == pytest.approx(column @ column)


def test_a_step_has_one_stretch_for_each_instant_and_others_have_all() -> None:
    assert stretches("step", COUNT)[0].tolist() == list(range(COUNT))
    for timing in ("pulse", "ramp"):
        first, end = stretches(timing, COUNT, 1, COUNT - 1)
        assert {(a, b) for a, b in zip(first, end, strict=True)} == {
            (a, b) for a in range(1, COUNT - 1) for b in range(a + 1, COUNT + 1)}


def test_what_lasts_is_the_sum_of_its_parts_from_each_instant_on() -> None:
    rng = np.random.default_rng(2)
    parts, left = rng.normal(size=(50, COUNT)), rng.normal(size=50)
    slope, bend = lasting(parts.T @ left, parts.T @ parts)
    whole = np.stack([parts[:, k:].sum(axis=1) for k in range(COUNT)], axis=1)
    np.testing.assert_allclose(slope, whole.T @ left)
    np.testing.assert_allclose(bend, whole.T @ whole, atol=1e-12)


def test_what_grows_is_over_soon_and_a_wind_may_last() -> None:
    first, end = stretches("ramp", COUNT, apart_s=CHANGED_IN_S / 2.0)
    assert (end - first).max() == 2
    first, end = stretches("ramp", COUNT, apart_s=2.0 * CHANGED_IN_S)
    assert set(end - first) == {1}
    first, end = stretches("pulse", COUNT, apart_s=2.0 * CHANGED_IN_S)
    assert (end - first).max() == COUNT
