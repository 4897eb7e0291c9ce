"""A gain that noise of its own regressor makes is doubtful; a true one is not."""

from __future__ import annotations

import numpy as np
import pytest
import trial_faults as faults
from trial_drive import make_run

from truck_blowout_sim.diagnosis.sensors.case import Case, Hypothesis, make_case
from truck_blowout_sim.diagnosis.sensors.reversal import made_by_noise
from truck_blowout_sim.diagnosis.sensors.solve import noise_inflation, refine
from truck_blowout_sim.diagnosis.sensors.system import assemble
from truck_blowout_sim.recordings import Recording, Series

GYRO = "trailer_yaw_rate_radps"
MEMORY_S = 1.5  # no smoothing takes it out


def noisy(run: Recording, times: float, seed: int) -> Recording:
    """With noise on the trailer's gyro as large as so many times its motion."""
    rng, series = np.random.default_rng(seed), run[GYRO]
    noise = faults.remembering(series.time_s, MEMORY_S, rng)
    moved = series.value + times * float(np.std(series.value)) * noise
    return run.with_channels({GYRO: Series(series.time_s, moved)})


def asked(runs: list[Recording]) -> tuple[Case, Hypothesis, tuple[float, ...], dict[str, float]]:
    """The gyro's gain error as least squares has it."""
    case = make_case(runs, [], None)
    gain = next(h for h in case.hypotheses
                if (h.distortion.name, h.distortion.unit) == ("yaw_rate_scale", "trailer"))
    inflation = noise_inflation(assemble(case))
    return case, gain, refine(case, [gain], inflation).amounts[0], inflation


def test_noise_of_the_gyro_looks_like_a_gain_and_is_doubtful() -> None:
    """Least squares finds noise over noise and signal: 0.5² / (1 + 0.5²) = 20 %."""
    case, gain, amount, inflation = asked([noisy(make_run(k, 14.0), 0.5, k) for k in range(2)])
    assert amount[0] == pytest.approx(0.2, abs=0.12)
    assert made_by_noise(case, [gain], [amount], inflation) == [True]


@pytest.mark.parametrize("error", [0.1, -0.1])
def test_a_true_gain_of_a_quiet_gyro_is_not_doubtful(error: float) -> None:
    runs = [make_run(k, 12.0) for k in range(2)]
    runs = [r.with_channels({GYRO: Series(r[GYRO].time_s, (1.0 + error) * r[GYRO].value)})
            for r in runs]
    case, gain, amount, inflation = asked(runs)
    assert amount[0] == pytest.approx(error, rel=0.05)
    assert made_by_noise(case, [gain], [amount], inflation) == [False]


def test_a_gain_that_noise_would_rather_hide_is_not_doubtful() -> None:
    """Noise makes this gain look larger than it is; one below zero it can only hide."""
    runs = [noisy(make_run(k, 14.0), 0.3, k) for k in range(2)]
    runs = [r.with_channels({GYRO: Series(r[GYRO].time_s, 0.6 * r[GYRO].value)}) for r in runs]
    case, gain, amount, inflation = asked(runs)
    assert amount[0] < -0.2
    assert made_by_noise(case, [gain], [amount], inflation) == [False]
