"""How far good models may differ: by the model's own motion, not by what the vehicle does."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.case.widths import swings, widths
from truck_blowout_sim.diagnosis.settings import Settings

Floats = NDArray[np.float64]
CHANNELS = ("tractor_yaw_rate_radps", "tractor_ay_mps2")


def test_the_swing_of_a_weave_is_its_rms_at_all_times(few: Settings) -> None:
    """Where the signal passes zero, too: there a late model is off most."""
    time_s = np.arange(0.0, 20.0, few.bin_s)
    weave = 0.1 * np.sin(2.0 * np.pi * time_s / few.swing_s)
    found = swings(np.stack([weave, 0.0 * weave], axis=1), few)
    inside = slice(round(few.swing_s / few.bin_s), -round(few.swing_s / few.bin_s))
    assert found[inside, 0] == pytest.approx(0.1 / np.sqrt(2.0), rel=0.05)
    assert (found[:, 1] == 0.0).all()


def test_what_is_not_finite_does_not_swing(few: Settings) -> None:
    signals = np.ones((60, 2))
    signals[10, 0], signals[:, 1] = np.inf, np.nan
    assert (swings(signals, few) == 0.0).all()


def test_noise_and_what_models_differ_by_add_in_squares(few: Settings) -> None:
    swing = np.full((5, 2), 0.1)
    models, loud, both = (widths(CHANNELS, np.full((5, 2), noise), swing, few)
                          for noise in (0.0, 100.0, 1.0))
    assert (models > 0.0).all()
    np.testing.assert_allclose(loud, 100.0, rtol=1e-3)
    np.testing.assert_allclose(both, np.hypot(1.0, models))


def uncorrected(study: Study) -> tuple[Run, Floats, int]:
    """The training run with the same motion at every step, zeros of its shape, and a channel."""
    still = np.zeros(study.runs[0].measured.shape)
    run = replace(study.runs[0], correction=still)
    return run, still, run.channels.index("tractor_yaw_rate_radps")


def test_what_is_missing_does_not_excuse_itself(study_of: Callable[..., Study]) -> None:
    """A motion that the model lacks widens no bin; one that the model has widens its own."""
    study = study_of()
    run, still, k = uncorrected(study)
    moved = still.copy()
    moved[30:45, k] = 0.2
    calm, kicked = (run.weighed(model, study.settings).sigma[:, k] for model in (still, moved))
    assert np.ptp(calm) == pytest.approx(0.0, abs=1e-3 * calm.mean())
    assert (kicked[30:45] > 3.0 * calm[30:45]).all()
    np.testing.assert_allclose(kicked[70:], calm[70:])


def test_what_a_finer_step_changes_widens_the_bins_around_it(study_of: Callable[..., Study]
                                                             ) -> None:
    """Where friction sticks and slips, one step is as good a model as another."""
    study = study_of()
    run, still, k = uncorrected(study)
    changed = still.copy()
    changed[20:40, k] = 0.01
    calm, unsure = (replace(run, correction=one).weighed(still, study.settings).sigma
                    for one in (still, changed))
    lasts = study.settings.correlation_s / study.settings.bin_s
    np.testing.assert_allclose(unsure[30, k], np.sqrt(calm[30, k]**2 + lasts * 0.01**2), rtol=1e-6)
    np.testing.assert_allclose(unsure[60:], calm[60:])
    np.testing.assert_allclose(np.delete(unsure, k, axis=1), np.delete(calm, k, axis=1))


def test_a_gauge_that_reads_once_a_second_swings_as_far_as_one_that_reads_always(
    few: Settings
) -> None:
    falls = np.clip(np.linspace(8e5, -4e5, 200), 0.0, None)[:, None]
    seldom = np.full_like(falls, np.nan)
    seldom[::round(1.0 / few.bin_s)] = falls[::round(1.0 / few.bin_s)]
    always, now_and_then = swings(falls, few), swings(seldom, few)
    assert np.median(now_and_then / np.maximum(always, 1.0)) == pytest.approx(1.0, rel=0.1)
