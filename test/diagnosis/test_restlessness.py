"""A channel is widened where runs with nothing missing are more restless than was guessed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import lfilter

from truck_blowout_sim.diagnosis.algebra.color import autocovariance
from truck_blowout_sim.diagnosis.case.calibration import calibrate
from truck_blowout_sim.diagnosis.case.restlessness import (
    colors,
    long_run_variance,
    resting_level,
    whiten,
)
from truck_blowout_sim.diagnosis.case.runs import prepare_run
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.settings import Settings
from truck_blowout_sim.recordings import Recording, Series
from truck_blowout_sim.vehicle import Packed

Studies = Callable[..., Study]
CHANNEL = "tractor_yaw_rate_radps"
STEP_S = 0.0025


@pytest.mark.parametrize("decay", [0.0, 0.5, 0.8])
def test_the_long_run_variance_is_that_of_the_sum(decay: float) -> None:
    rng = np.random.default_rng(0)
    made = [lfilter([1.0], [1.0, -decay], rng.standard_normal(2000))[200:] for _ in range(40)]
    found = np.mean([long_run_variance(autocovariance(one, 40) / one.size) for one in made])
    assert found == pytest.approx(1.0 / (1.0 - decay) ** 2, rel=0.2)


def restless(study: Study, i: int, by: float) -> Study:
    """The study, one channel of run ``i`` swinging at a third of a hertz by so many sigmas."""
    run = study.runs[i]
    k = run.channels.index(CHANNEL)
    measured = run.measured.copy()
    wave = np.sin(2.0 * np.pi * 0.33 * np.arange(measured.shape[0]) * study.settings.bin_s)
    measured[:, k] += by * run.sigma[:, k] * wave
    runs = tuple(replace(r, measured=measured) if j == i else r for j, r in enumerate(study.runs))
    return replace(study, runs=runs)


def width(study: Study, channel: str = CHANNEL) -> float:
    """Long-run width of a channel over its first guess."""
    color = colors(study)[channel]
    return float(color.surprise[0, -1] / (1.0 - color.foretold[0, -1].sum()))


def test_a_restless_channel_is_widened_in_every_run_with_its_columns(study_of: Studies) -> None:
    calm = study_of(holdout={}, baseline=True)
    study = restless(calm, calm.baseline[0], 4.0)
    factor = width(study)
    assert factor > 2.0
    k = study.runs[0].channels.index(CHANNEL)
    columns, residual = study.columns.copy(), study.residual()
    whiten(study)
    rows = np.arange(study.runs[0].measured.size).reshape(study.runs[0].measured.shape)[:, k]
    np.testing.assert_allclose(factor * study.columns[rows], columns[rows])
    np.testing.assert_allclose(factor * study.residual()[rows], residual[rows])
    model = study.holdout_models[0]
    np.testing.assert_allclose(study.holdout[0].plain(study.holdout[0].residual(model)),
                               np.nan_to_num(study.holdout[0].measured - model), atol=1e-12)


@pytest.mark.parametrize("baseline", [True, False])
def test_a_calm_truck_keeps_the_guess(study_of: Studies, baseline: bool) -> None:
    study = study_of(baseline=baseline)
    assert max(width(study, name) for name in colors(study)) < 1.1
    assert min(width(study, name) for name in colors(study)) > 0.999
    assert 0.0 < resting_level(study) <= 1.0


def test_without_baseline_runs_training_is_asked_and_its_color_taken_out(
        study_of: Studies) -> None:
    swinging = restless(study_of(), 0, 4.0)
    k = swinging.runs[0].channels.index(CHANNEL)
    shape = swinging.runs[0].measured.shape
    before = swinging.residual().reshape(shape)[:, k]
    whiten(swinging)
    after = swinging.residual().reshape(shape)[:, k]
    assert swinging.runs[0].color.lags > 0
    assert np.mean(np.square(after)) < 0.3 * np.mean(np.square(before))


@pytest.mark.parametrize("empties", [False, True])
def test_a_tire_that_empties_is_no_color_of_its_gauge(
    truck: Packed, few: Settings, drive_it: Callable[..., Recording], empties: bool
) -> None:
    """Without baseline runs, it would hide by its own color: a gauge reads 0 and nobody notices."""
    run, name = drive_it(), "tire_pressure_trailer_1_left_outer_pa"
    time_s = run["steering_wheel_angle_rad"].time_s
    full = truck["tire.trailer_1_left_outer.pressure_pa"]
    left = np.exp(-np.maximum(time_s - 5.0, 0.0)) if empties else np.ones(time_s.size)
    noise = 500.0 * np.random.default_rng(3).standard_normal(time_s.size)
    gauge = run.with_channels({name: Series(time_s, full * left + noise)})
    study = Study((prepare_run(gauge, "train", truck, few, step_s=STEP_S),), (), truck, few)
    calibrate(study)
    k, shape = study.runs[0].channels.index(name), study.runs[0].measured.shape
    worst = np.abs(study.residual().reshape(shape)[:, k]).max()
    assert worst > 4.0 if empties else worst < 0.5


def test_what_is_missing_in_training_does_not_widen_the_channel_that_shows_it(
    study_of: Studies
) -> None:
    """It pulls the sheet and the gain of its own channel away from the baseline runs."""
    calm = study_of(baseline=True)
    i = calm.train[0]
    run, k = calm.runs[i], calm.runs[i].channels.index("hub_speed_trailer_2_left_radps")
    measured = run.measured.copy()
    measured[measured.shape[0] // 2:, k] *= 0.5
    study = replace(calm, runs=tuple(replace(r, measured=measured) if j == i else r
                                     for j, r in enumerate(calm.runs)))
    for name, color in colors(study).items():
        np.testing.assert_array_equal(color.surprise, colors(calm)[name].surprise)
    assert resting_level(study) == resting_level(calm)
