"""The plainest law: the variable that made the force history is found."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.law import plainest_law
from truck_blowout_sim.diagnosis.locate import Wrenches
from truck_blowout_sim.diagnosis.result_evidence import ForceHistory
from truck_blowout_sim.recordings import Recording, Series

TIMES = np.arange(0.5, 20.0)
SPEED = 25.0 - 0.7 * TIMES
YAW_RATE = 0.1 * np.sin(TIMES)


def run_with(**channels: np.ndarray) -> SimpleNamespace:
    recording = Recording("r", {n: Series(TIMES, v) for n, v in channels.items()})
    return SimpleNamespace(recording=recording)


def history(fx: np.ndarray, fy: np.ndarray) -> Wrenches:
    rng = np.random.default_rng(3)
    one = np.full(TIMES.size, 60.0)
    noisy = [f + rng.normal(0.0, 60.0, TIMES.size) for f in (fx, fy)]
    forces = ForceHistory("r", "trailer", TIMES, noisy[0], noisy[1], np.zeros(TIMES.size), one, one,
                          10.0 * one)
    return Wrenches(forces, 1.0, 900.0, 60, 0.0, 1.0)


@pytest.mark.parametrize(("fx", "fy", "variable", "factor"), [
    (-80.0 * SPEED, 0.0 * SPEED, "v", -80.0),
    (-4.0 * SPEED**2, 0.0 * SPEED, "v^2", -4.0),
    (0.0 * SPEED, 900.0 * SPEED * YAW_RATE, "v r", 900.0),
    (0.0 * SPEED, np.where(TIMES > 12.0, 2500.0, 0.0), "1 (constant while it acts)", 2500.0),
])
def test_finds_the_variable_that_made_the_force(
    fx: np.ndarray, fy: np.ndarray, variable: str, factor: float
) -> None:
    law = plainest_law(history(fx, fy), run_with(tractor_vx_mps=SPEED,
                                                 tractor_yaw_rate_radps=YAW_RATE))
    assert law.variable == variable
    assert law.factor == pytest.approx(factor, rel=0.1)
    assert law.explained > 0.8


def test_a_constant_force_can_be_put_into_the_model() -> None:
    law = plainest_law(history(0.0 * SPEED, np.where(TIMES > 12.0, 2500.0, 0.0)),
                       run_with(tractor_vx_mps=SPEED))
    assert law.values["unit.trailer.probe_start_s"] == pytest.approx(12.0, abs=1.1)
    assert law.values["unit.trailer.probe_fy_n"] == pytest.approx(2500.0, rel=0.1)


def test_pure_noise_is_hardly_explained() -> None:
    law = plainest_law(history(0.0 * SPEED, 0.0 * SPEED), run_with(tractor_vx_mps=SPEED))
    assert law.explained < 0.4
