"""What stands behind a diagnosis, as data for the page: maps, overlays, candidates, numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.algebra.quantiles import NINETY
from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.case.study import Study, row_ranges
from truck_blowout_sim.diagnosis.name.judging import Found
from truck_blowout_sim.diagnosis.result import (
    Calibrated,
    Candidate,
    ChannelTimeMap,
    Overlay,
    Parameter,
    amount_text,
)

Floats = NDArray[np.float64]
Left = Sequence[tuple[Run, Floats]]  # run and its whitened residual [n, m]
_CELL_S = 0.5
_MOST_OVERLAYS = 8


def left_before(study: Study, found: Found, role: str) -> Left:
    """Residuals of the vehicle as given: where baseline runs moved it, the runs were shifted back.

    ``left_after`` has numbers of the sheet, starts and instruments fitted beside the effects.
    """
    if role == "holdout":
        return [(run, run.residual(model).reshape(run.measured.shape))
                for run, model in zip(study.holdout, study.holdout_models, strict=True)]
    return [(study.runs[i], study.runs[i].residual(found.models_null[i])
             .reshape(study.runs[i].measured.shape)) for i in study.train]


def left_after(study: Study, found: Found, role: str) -> Left:
    """Residuals of the diagnosed model, with the calibration that goes with it."""
    if role == "holdout":
        return [(p.run, p.left) for p in found.after]
    named = [r.hypothesis for r in found.named]
    clean = study.projector(named).remove(study.residual())
    rows = row_ranges(study)
    return [(study.runs[i], clean[rows[i]].reshape(study.runs[i].measured.shape))
            for i in study.train]


def pooled(left: Left) -> Mapping[str, float]:
    """Rms of each channel over all runs, in units of instrument noise."""
    sums: dict[str, list[Floats]] = {}
    for run, z in left:
        noise = run.plain(z) / run.noise
        for k, name in enumerate(run.channels):
            seen = np.isfinite(run.measured[:, k])
            if seen.any():
                sums.setdefault(name, []).append(noise[seen, k])
    return {name: float(np.sqrt(np.mean(np.concatenate(parts) ** 2)))
            for name, parts in sums.items()}


def maps(study: Study, found: Found) -> tuple[ChannelTimeMap, ...]:
    """Channel-by-time maps of every training and holdout run, half a second a cell.

    As nearly as whole bins allow.
    """
    result, bins = [], max(round(_CELL_S / study.settings.bin_s), 1)
    for role in ("train", "holdout"):
        pairs = zip(left_before(study, found, role), left_after(study, found, role), strict=True)
        for (run, before), (_, after) in pairs:
            n = before.shape[0] // bins
            result.append(ChannelTimeMap(
                run.recording.name, run.role, run.edges_s[:n * bins + 1:bins],
                run.channels, _cells(run, before, n, bins), _cells(run, after, n, bins)))
    return tuple(result)


def _cells(run: Run, left: Floats, n: int, bins: int) -> Floats:
    """Mean residual of each of n cells in sigma of the mean, [m, n]."""
    z = np.where(np.isfinite(run.measured), left, np.nan)[:n * bins]
    cube = z.reshape(n, bins, z.shape[1])
    count = np.isfinite(cube).sum(axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray((np.nansum(cube, axis=1) / np.sqrt(count)).T)


def overlays(study: Study, found: Found, about: Sequence[str] = ()) -> tuple[Overlay, ...]:
    """Measured, before and after of what the answer is ``about``, and what changed most."""
    before, after = (pooled(left_before(study, found, "train")),
                     pooled(left_after(study, found, "train")))
    changed = sorted(before, key=lambda n: after.get(n, 0.0) - before[n])
    names = list(dict.fromkeys((*about, *changed)))[:_MOST_OVERLAYS]
    result = []
    for role in ("train", "holdout"):
        pairs = zip(left_before(study, found, role), left_after(study, found, role), strict=True)
        for (run, first), (_, last) in pairs:
            first, last = run.plain(first), run.plain(last)
            for name in (n for n in names if n in run.channels):
                k = run.channels.index(name)
                y = run.measured[:, k]
                seen = np.isfinite(y)
                result.append(Overlay(
                    run.recording.name, run.role, name,
                    run.middles_s[seen], y[seen],
                    (y - first[:, k])[seen], (y - last[:, k])[seen],
                    float(np.median(run.noise[:, k]))))
    return tuple(result)


def candidates(found: Found) -> tuple[Candidate, ...]:
    """The first round's ranking with reasons."""
    named = {r.hypothesis.key for r in found.named}
    aliased = {r.hypothesis.key for rivals in found.rivals for r in rivals} - named
    result = []
    for trial in found.tried[:25]:
        ranked, h = trial.ranked, trial.ranked.hypothesis
        amount = h.effect.amount
        low, value, high = (amount.report(h.amount + k * NINETY * ranked.sigma)
                            for k in (-1.0, 0.0, 1.0))
        shown = Parameter(value, amount.unit, (min(low, high), max(low, high)))
        result.append(Candidate(
            name=h.effect.name, where=h.place, delta_chi2=ranked.delta,
            accepted=h.key in named, aliased=h.key in aliased,
            reason=str(trial.fate), rule=trial.fate.rule, value=trial.fate.value,
            limit=trial.fate.limit,
            p_value=(found.chance.p_value(ranked.support)
                     if found.chance and ranked.refitted else None),
            amount=amount_text(amount.name, shown).replace("90 %: ", "")))
    return tuple(result)


def calibrated(study: Study, joint: Mapping[str, float]) -> tuple[Calibrated, ...]:
    """Sheet numbers: what calibration and joint fit make of each, relative or in SI."""
    spread = np.sqrt(np.diag(study.projector().covariance()))
    sigma = dict(zip(study.names, spread.tolist(), strict=True))
    result = []
    for n in study.settings.nuisances:
        value = joint.get(n.name, 0.0)
        result.append(Calibrated(
            n.name, n.unit, 0.0, n.sigma, value * n.sigma, sigma.get(n.name, 1.0) * n.sigma,
            relative=n.kind == "scale"))
    return tuple(result)
