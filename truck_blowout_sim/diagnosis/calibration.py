"""Where the model is linear: the truck that the runs ask for, within its sheet.

References: Gauss-Newton with Gaussian priors (Tarantola 2005, section 3.4).
Known limits: two rounds; the columns stay those of the sheet.
Validated with: test/diagnosis/test_calibration.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.linear import Projector
from truck_blowout_sim.diagnosis.runs import Run
from truck_blowout_sim.diagnosis.settings import Nuisance
from truck_blowout_sim.diagnosis.study import (
    FURTHEST,
    Progress,
    Study,
    build_columns,
    row_ranges,
)
from truck_blowout_sim.simulation.equilibrium import initial_vector
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
_KNOWN = 0.25  # prior sigmas to which baseline runs must hold a number to count as known


def calibrate(study: Study, rounds: int = 2, progress: Progress | None = None) -> None:
    """Move the reference to the sheet numbers that the baseline runs ask for.

    Without baseline runs, training runs serve, if that explains them better. Only the point moves
    at which the model is linear: every run is corrected so that amounts and their priors go on
    counting from the sheet, and what the runs ask for stays open to effects.
    """
    warm_up(study)
    study.update_models()
    study.holdout_models = study.simulate([(run, study.packed) for run in study.holdout])
    build_columns(study, progress)
    rows, sheet = row_ranges(study), study.settings.nuisances
    chosen = study.baseline or study.train
    columns = np.concatenate([study.columns[rows[i]] for i in chosen])
    projector = Projector.of(columns)
    least = projector.chi2(_residual_of(study, chosen))
    total: Floats = np.zeros(len(sheet))
    kept: Floats = np.zeros(len(sheet))
    if study.baseline:
        spread = np.sqrt(np.diag(projector.covariance()))
        study.known = frozenset(n.name for n, s in zip(sheet, spread, strict=False) if s < _KNOWN)
    given = study.packed
    for _ in range(rounds):
        # columns explain measured - model as + J amount
        residual = _residual_of(study, chosen) + columns[:, :len(sheet)] @ total
        total = np.clip(projector.amounts(residual)[:len(sheet)], -FURTHEST, FURTHEST)
        study.packed = apply_amounts(given, sheet, total)
        study.update_models()
        left = projector.chi2(_residual_of(study, chosen) + columns[:, :len(sheet)] @ total)
        if left < least:
            least, kept = left, total
    study.packed = apply_amounts(given, sheet, kept)
    study.amounts = dict(zip((n.name for n in sheet), kept.tolist(), strict=True))
    n_sheet = len(sheet)
    study.runs = tuple(run.shifted(study.columns[part, :n_sheet] @ kept)
                       for run, part in zip(study.runs, rows, strict=True))
    study.holdout = tuple(run.shifted(part[:, :n_sheet] @ kept)
                          for run, part in zip(study.holdout, study.holdout_columns, strict=True))
    study.update_models()
    study.holdout_models = study.simulate([(run, study.packed) for run in study.holdout])


def _residual_of(study: Study, chosen: Sequence[int]) -> Floats:
    """Whitened residual of some runs at the present models."""
    return np.concatenate([study.runs[i].residual(study.models[i]) for i in chosen])


def warm_up(study: Study) -> None:
    """Settle the reference truck once for each run, so that its variants settle quickly.

    Learns, too, what the fine step changes there.
    """
    def warmed(run: Run) -> Run:
        state = initial_vector(study.packed, run.drive.initial, run.drive.step_s)
        warm = replace(run, drive=replace(run.drive, warm=state),
                       fine=replace(run.fine, warm=state))
        return warm.corrected(study.packed)
    with ThreadPoolExecutor(study.workers) as pool:
        study.runs = tuple(pool.map(warmed, study.runs))
        study.holdout = tuple(pool.map(warmed, study.holdout))


def apply_amounts(packed: Packed, sheet: Sequence[Nuisance], amounts: Floats) -> Packed:
    """The truck with nuisances at the given amounts [prior sigmas], one after another."""
    for nuisance, amount in zip(sheet, amounts, strict=True):
        packed = packed.with_values(nuisance.values(packed, float(amount) * nuisance.sigma))
    return packed
