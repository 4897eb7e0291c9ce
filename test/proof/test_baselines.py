from __future__ import annotations

from pathlib import Path
from typing import cast

import numpy as np
import pytest
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.algebra.color import Color
from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.proof.baselines import compare
from truck_blowout_sim.proof.baselines.compare import mean_square, stretch, unchanged
from truck_blowout_sim.proof.baselines.features import INPUTS, Stretch, motion_columns
from truck_blowout_sim.proof.baselines.gaussian_process import gaussian_process, predict_residual
from truck_blowout_sim.proof.baselines.sparse_regression import (
    fit_law,
    integrate,
    optimizer_name,
    own_stlsq,
    thresholded,
)
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.simulation.drive import Drive

Floats = NDArray[np.float64]
NAMES = ("tractor_vx_mps", "tractor_yaw_rate_radps")
BIN_S, LEAK_S = 0.1, 2.0


def driven(seed: int, n: int = 300) -> Stretch:
    """Residuals of de/dt = -e / 2 s + (0.3 steer, -0.2 throttle), commands slow and random."""
    rng = np.random.default_rng(seed)
    inputs = np.zeros((n, len(INPUTS)))
    inputs[:, 0] = 1.0
    for name in ("steer", "throttle"):
        walk = np.convolve(rng.normal(size=n + 39), np.hanning(40) / 6.0, "valid")
        inputs[:, INPUTS.index(name)] = walk
    rate = np.stack([0.3 * inputs[:, 1], -0.2 * inputs[:, 2]], axis=1)
    e = np.zeros((n, 2))
    for k in range(1, n):
        kept = np.exp(-BIN_S / LEAK_S)
        e[k] = kept * e[k - 1] + (1 - kept) * LEAK_S * rate[k - 1]
    return Stretch(NAMES, e, np.full((n, 2), 0.01), inputs, BIN_S)


def test_thresholded_least_squares_finds_the_terms_that_are_there() -> None:
    rng = np.random.default_rng(1)
    x = rng.normal(size=(400, 6))
    law = np.array([[1.5, 0, 0, -0.4, 0, 0], [0, 0.9, 0, 0, 0, 0]])
    y = x @ law.T
    y = y + 0.02 * rng.normal(size=y.shape)
    found = own_stlsq(x, y)
    assert found == pytest.approx(law, abs=0.01)
    assert np.count_nonzero(found) == 3


def test_own_optimizer_agrees_with_pysindy() -> None:
    pytest.importorskip("pysindy")
    rng = np.random.default_rng(2)
    x = rng.normal(size=(200, 5))
    y = x @ rng.normal(size=(5, 2)) + 0.1 * rng.normal(size=(200, 2))
    assert thresholded(x, y) == pytest.approx(own_stlsq(x, y), abs=1e-9)


@pytest.mark.parametrize("distribution", ["kilted", "jazzy"])
def test_the_pinned_environments_have_pysindy(distribution: str) -> None:
    pins = Path(__file__).resolve().parents[2] / "requirements" / f"{distribution}.txt"
    if not pins.is_file():
        pytest.skip("not in a source tree")
    assert "\npysindy==" in pins.read_text(encoding="utf-8")


def test_the_rival_runs_with_pysindy_where_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    pysindy = pytest.importorskip("pysindy")
    fitted = []

    class Watched(pysindy.STLSQ):
        def fit(self, x: Floats, y: Floats) -> Watched:
            fitted.append(x.shape)
            super().fit(x, y)
            return self

    monkeypatch.setattr(pysindy, "STLSQ", Watched)
    law = fit_law([driven(3)], NAMES)
    assert optimizer_name() == "pysindy.STLSQ"
    assert len(fitted) == 3  # one for each leak
    assert law.leak_s == LEAK_S


def test_sparse_law_predicts_a_run_it_never_saw() -> None:
    law = fit_law([driven(3), driven(4)], NAMES)
    unseen = driven(5)
    assert law.leak_s == LEAK_S
    left = unseen.less(integrate(law, unseen, NAMES), NAMES)
    assert mean_square([left], NAMES) < 0.05 * mean_square([unseen], NAMES)


def test_gaussian_process_finds_a_smooth_law_and_knows_nothing_far_away() -> None:
    rng = np.random.default_rng(6)
    x = rng.uniform(-2, 2, size=(150, 1))
    y = np.sin(2 * x[:, 0]) + 0.05 * rng.normal(size=150)
    asked = np.array([[-1.0], [0.3], [1.2], [60.0]])
    found = gaussian_process(x, y, asked)
    assert found[:3] == pytest.approx(np.sin(2 * asked[:3, 0]), abs=0.1)
    assert abs(found[3]) < 1e-6


def test_gaussian_process_skips_gaps() -> None:
    learned, unseen = driven(7), driven(8)
    learned.left[:, 0] = 0.5 * learned.inputs[:, 1]
    learned.left[10:40, 0] = np.nan
    found = predict_residual([learned], unseen, NAMES[:1])
    assert found[:, 0] == pytest.approx(0.5 * unseen.inputs[:, 1], abs=0.15)


def test_mean_square_is_in_noise_and_blind_to_gaps() -> None:
    left = np.array([[0.03, np.nan], [-0.03, 0.01]])
    one = Stretch(NAMES, left, np.full((2, 2), 0.01), np.zeros((2, len(INPUTS))), BIN_S)
    assert mean_square([one], NAMES) == pytest.approx((9.0 + 1.0) / 2)


def test_only_motion_is_compared() -> None:
    channels = ("tractor_vx_mps", "tractor_roll_rad", "trailer_yaw_rate_radps")
    assert motion_columns(channels) == [0, 2]


def test_a_residual_that_lasts_counts_in_full(monkeypatch: pytest.MonkeyPatch) -> None:
    """What the bins before foretell is taken from a residual to fit it, not to compare errors."""
    monkeypatch.setattr(compare, "inputs_of", lambda run: np.zeros((40, len(INPUTS))))
    lasting = Color.of(0.9 ** np.arange(3.0)[None, :].repeat(2, axis=0))
    left = np.stack([np.full(40, 0.3), np.linspace(0.0, 0.2, 40)], axis=1)
    left[7, 1] = np.nan
    drive = cast("Drive", None)
    run = Run(Recording("run", {}), "holdout", drive, NAMES, (0, 1), BIN_S * np.arange(41.0), left,
              np.full(left.shape, 0.05), np.full(left.shape, 0.01), drive,
              np.zeros(left.shape), lasting)
    whitened = run.residual(np.zeros(left.shape)).reshape(left.shape)
    assert np.nanmean(np.square(whitened[1:, 0])) < 0.2 * np.nanmean(np.square(left[:, 0] / 0.05))
    np.testing.assert_allclose(stretch(run, whitened).left, left, atol=1e-12)


def test_a_run_that_is_cut_where_it_slides_is_compared_up_to_there(
    monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(compare, "inputs_of", lambda run: np.zeros((12, len(INPUTS))))
    drive, left = cast("Drive", None), np.full((12, 2), 0.3)
    run = Run(Recording("run", {}), "holdout", drive, NAMES, (0, 1), BIN_S * np.arange(13.0), left,
              np.full(left.shape, 0.05), np.full(left.shape, 0.01), drive,
              np.zeros(left.shape), Color.of(np.eye(1, 3).repeat(2, axis=0)))
    whole = np.vstack([np.full(left.shape, 0.1), np.full((28, 2), 99.0)])
    np.testing.assert_allclose(unchanged(run, whole).left, 0.2, atol=1e-12)
