"""Where the model is linear: the truck that the runs ask for, within its sheet.

References: Gauss-Newton with Gaussian priors (Tarantola 2005, section 3.4).
Known limits: two rounds; the columns, taken anew where these end, stay so from there on.
Validated with: test/diagnosis/test_calibration.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.algebra.linear import Projector
from truck_blowout_sim.diagnosis.case.memory import check_memory
from truck_blowout_sim.diagnosis.case.restlessness import resting_level, whiten
from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.case.study import (
    FURTHEST,
    Progress,
    Study,
    build_columns,
    row_ranges,
)
from truck_blowout_sim.diagnosis.nuisance import Nuisance
from truck_blowout_sim.simulation.ending import stands
from truck_blowout_sim.simulation.equilibrium import initial_vector
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
_KNOWN = 0.6  # prior sigmas to which baseline runs must hold a number to count as known
_ROUNDS = 2
_STEPS = (1.0, 0.5, 0.25)  # of the way, the first that helps
_SHARES = (1.0, 0.5)  # of what baseline runs ask for


def calibrate(study: Study, progress: Progress | None = None) -> None:
    """Move the reference to the sheet numbers that the baseline runs ask for.

    Only the point moves at which the model is linear: every run is corrected so that amounts and
    their priors go on counting from the sheet, and what the runs ask for stays open to effects.
    Without baseline runs it stays at the sheet: nothing else tells the truck from what is missing.

    Raises:
        InputError: too many runs for this machine's memory.
    """
    check_memory(study)
    warm_up(study)
    _drive_all(study)
    _count_all(study)
    _weigh_all(study)
    build_columns(study, progress)
    study.amounts = {number.name: 0.0 for number in study.settings.nuisances}
    if not study.baseline:
        whiten(study)
        study.level = resting_level(study)
        return
    rows, n_sheet = row_ranges(study), len(study.settings.nuisances)
    kept = _moved(study, _asked_for(study), progress)
    study.known = _known(study)
    study.runs = tuple(run.shifted(study.columns[part, :n_sheet] @ kept)
                       for run, part in zip(study.runs, rows, strict=True))
    study.holdout = tuple(run.shifted(part[:, :n_sheet] @ kept)
                          for run, part in zip(study.holdout, study.holdout_columns, strict=True))
    _drive_all(study)
    whiten(study)
    study.level = resting_level(study)


def _drive_all(study: Study) -> None:
    """Models of all runs, holdout too, of the truck at the reference."""
    study.update_models()
    study.holdout_models = study.simulate([(run, study.packed) for run in study.holdout])


def _count_all(study: Study) -> None:
    """Leave out of the runs where the vehicle slides and the reference does not."""
    units, least_s = study.packed.vehicle.units, study.settings.episode_s
    fitted, unseen = ([run.counted(model, units, least_s)
                       for run, model in zip(runs, models, strict=True)] for runs, models in (
        (study.runs, study.models), (study.holdout, study.holdout_models)))
    study.runs, study.models = tuple(run for run, _ in fitted), [model for _, model in fitted]
    study.holdout, study.holdout_models = (tuple(run for run, _ in unseen),
                                           [model for _, model in unseen])


def _weigh_all(study: Study) -> None:
    """Widths of all runs, from the motion of the reference."""
    study.runs, study.holdout = (
        tuple(run.weighed(model, study.settings) for run, model in zip(runs, models, strict=True))
        for runs, models in ((study.runs, study.models), (study.holdout, study.holdout_models)))


def _asked_for(study: Study) -> Floats:
    """Amounts of the sheet's numbers that lower what baseline runs leave and priors say, together.

    Gauss-Newton with the sensitivities of the sheet, each step shortened until it helps.
    """
    sheet, columns = study.settings.nuisances, _baseline_columns(study)
    projector = Projector.of(columns)
    n_sheet = len(sheet)
    instruments = Projector.of(columns, range(n_sheet, columns.shape[1]))
    runs = [study.runs[i] for i in study.baseline]

    def left_by(models: Sequence[Floats], amounts: Floats) -> tuple[float, Floats]:
        residual = np.concatenate([run.residual(model)
                                   for run, model in zip(runs, models, strict=True)])
        return instruments.chi2(residual) + float(amounts @ amounts), residual

    kept: Floats = np.zeros(n_sheet)
    least, residual = left_by([study.models[i] for i in study.baseline], kept)
    for _ in range(_ROUNDS):
        wanted = np.clip(projector.amounts(residual + columns[:, :n_sheet] @ kept)[:n_sheet],
                         -FURTHEST, FURTHEST)
        for share in _STEPS:
            tried = kept + share * (wanted - kept)
            truck = apply_amounts(study.packed, sheet, tried)
            left, there = left_by(study.simulate([(run, truck) for run in runs]), tried)
            if left < least:
                least, kept, residual = left, tried, there
                break
        else:
            break
    return kept


def _moved(study: Study, wanted: Floats, progress: Progress | None) -> Floats:
    """Move the reference all the way, or half, or not: where all runs are explained best.

    What the baseline runs hardly show can be far off where a tire is lost.
    """
    given, sheet = study.packed, study.settings.nuisances
    n_sheet, nowhere = len(sheet), np.zeros(len(sheet))
    least = Projector.of(study.columns).chi2(study.residual())
    at_sheet = (study.columns, study.holdout_columns, study.holdout_models, study.models)
    for share in _SHARES:
        kept = share * wanted
        study.packed = apply_amounts(given, sheet, kept)
        study.amounts = dict(zip((n.name for n in sheet), kept.tolist(), strict=True))
        _drive_all(study)
        build_columns(study, progress)
        shift = study.columns[:, :n_sheet] @ kept
        if Projector.of(study.columns).chi2(study.residual() + shift) < least:
            return kept
    study.packed, study.amounts = given, {n.name: 0.0 for n in sheet}
    study.columns, study.holdout_columns, study.holdout_models, study.models = at_sheet
    study.forget()
    return nowhere


def _known(study: Study) -> frozenset[str]:
    """Numbers of the sheet that the baseline runs determine."""
    spread = np.sqrt(np.diag(Projector.of(_baseline_columns(study)).covariance()))
    return frozenset(number.name for number, sigma in zip(
        study.settings.nuisances, spread, strict=False) if sigma < _KNOWN)


def _baseline_columns(study: Study) -> Floats:
    rows = row_ranges(study)
    return np.concatenate([study.columns[rows[i]] for i in study.baseline])


def warm_up(study: Study) -> None:
    """Settle the reference truck once for each run, so that its variants settle quickly.

    Learns, too, what the fine step changes there. Where the coarse step finds no equilibrium,
    everything is simulated on the fine one.
    """
    def warmed(run: Run) -> Run:
        state = initial_vector(study.packed, run.drive.initial, run.drive.step_s)
        if not stands(state, study.packed):
            run = replace(run, drive=run.fine)
            state = initial_vector(study.packed, run.fine.initial, run.fine.step_s)
        warm = replace(run, drive=replace(run.drive, warm=state),
                       fine=replace(run.fine, warm=state))
        return warm.corrected(study.packed)
    with ThreadPoolExecutor(study.workers) as pool:
        study.runs = tuple(pool.map(warmed, study.runs))
        study.holdout = tuple(pool.map(warmed, study.holdout))


def apply_amounts(packed: Packed, sheet: Sequence[Nuisance], amounts: Floats) -> Packed:
    """The truck with nuisances at the given amounts [prior sigmas], one after another."""
    for nuisance, amount in zip(sheet, amounts, strict=True):
        packed = packed.unchecked(nuisance.values(packed, float(amount) * nuisance.sigma))
    return packed
