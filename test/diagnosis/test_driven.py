"""Runs that ask the same numbers of the sheet are driven alike."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np

from truck_blowout_sim.diagnosis.case.driven import driven


def test_runs_are_as_alike_as_the_numbers_they_ask() -> None:
    """A turn is like a turn of twice the size, and not like a stop."""
    rng = np.random.default_rng(0)
    turn, stop = rng.normal(size=(40, 1)), rng.normal(size=(40, 1))
    nothing = np.zeros((40, 1))
    blocks = [np.hstack([turn, nothing, turn]), np.hstack([nothing, stop, turn])]
    unseen = [np.hstack([2.0 * turn, nothing, turn])]
    runs = [SimpleNamespace(measured=np.zeros((40, 1))) for _ in blocks]
    study = SimpleNamespace(settings=SimpleNamespace(nuisances=("cornering", "brakes")), runs=runs,
                            columns=np.concatenate(blocks), holdout_columns=unseen)
    one, other, again = driven(study)  # type: ignore[arg-type]
    assert one @ other == 0.0
    np.testing.assert_allclose([one @ one, one @ again], 1.0)
