"""A channel is widened where runs with nothing missing are more restless than was guessed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import lfilter

from truck_blowout_sim.diagnosis.case.restlessness import long_run_variance, widen, widths
from truck_blowout_sim.diagnosis.case.study import Study

Studies = Callable[..., Study]
CHANNEL = "tractor_yaw_rate_radps"


@pytest.mark.parametrize("decay", [0.0, 0.5, 0.8])
def test_the_long_run_variance_is_that_of_the_sum(decay: float) -> None:
    rng = np.random.default_rng(0)
    made = [lfilter([1.0], [1.0, -decay], rng.standard_normal(2000))[200:] for _ in range(40)]
    found = np.mean([long_run_variance(one, 40) for one in made])
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


def test_a_restless_channel_is_widened_in_every_run_with_its_columns(study_of: Studies) -> None:
    calm = study_of(holdout={}, baseline=True)
    study = restless(calm, calm.baseline[0], 4.0)
    factor = widths(study)[CHANNEL]
    assert factor > 2.0
    k = study.runs[0].channels.index(CHANNEL)
    before, columns = [run.sigma for run in (*study.runs, *study.holdout)], study.columns.copy()
    widen(study)
    for run, sigma in zip((*study.runs, *study.holdout), before, strict=True):
        np.testing.assert_allclose(run.sigma[:, k], factor * sigma[:, k])
    rows = np.arange(study.runs[0].measured.size).reshape(study.runs[0].measured.shape)[:, k]
    np.testing.assert_allclose(factor * study.columns[rows], columns[rows])


@pytest.mark.parametrize("baseline", [True, False])
def test_a_calm_truck_keeps_the_guess(study_of: Studies, baseline: bool) -> None:
    assert max(widths(study_of(baseline=baseline)).values()) < 1.1


def test_training_runs_are_asked_where_no_baseline_is(study_of: Studies) -> None:
    swinging = restless(study_of(), 0, 4.0)
    assert widths(swinging)[CHANNEL] > 2.0
