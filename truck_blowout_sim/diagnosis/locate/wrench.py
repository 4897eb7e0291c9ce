"""Where the missing force acts: an unknown wrench on each body, smoothed over time.

The response to a unit force or moment in each window is simulated; amounts follow from a linear
solve with a broad prior, nuisances projected out. Their ratio is the line of action.

References: input estimation by augmented-state smoothing (Bryson and Ho); discrepancy as a process
(Kennedy and O'Hagan 2001).
Known limits: wrench in the road plane, constant over a window.
Validated with: test/diagnosis/test_locate.py (synthetic wrenches: body, time, line of action).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve

from truck_blowout_sim.diagnosis.case.study import Progress, Study, row_ranges
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.models import with_effects
from truck_blowout_sim.diagnosis.locate.comparable import Left
from truck_blowout_sim.diagnosis.result.evidence import ForceHistory

Floats = NDArray[np.float64]
WINDOW_S = 1.0
_MOST_WINDOWS = 30
_UNITS = {"fx_n": 2000.0, "fy_n": 2000.0, "mz_nm": 8000.0}  # step of the finite difference
_PRIOR = {"fx_n": 5000.0, "fy_n": 5000.0, "mz_nm": 20000.0}


@dataclass(frozen=True, eq=False)
class Wrenches:
    """Missing wrench on one body of one run.

    Attributes:
        history: its time course, constant over each ``window_s``.
        delta: fall of the sum of squares it buys; ``degrees`` its number of free amounts.
        x_m, x_sigma_m: lateral line of action forward of base_link, inf where none shows.
    """

    history: ForceHistory
    window_s: float
    delta: float
    degrees: int
    x_m: float
    x_sigma_m: float


def missing_wrenches(study: Study, left: Left, models: Sequence[Floats],
                     named: Sequence[Hypothesis] = (), progress: Progress | None = None
                     ) -> tuple[Wrenches, ...]:
    """The wrench on each body in the training run that ``left`` says is explained worst."""
    worst = left.worst(study)
    return tuple(missing_wrench(study, worst, body, models, named, progress, left)
                 for body in study.packed.vehicle.units)


def missing_wrench(study: Study, i: int, body: str, models: Sequence[Floats],
                   named: Sequence[Hypothesis] = (), progress: Progress | None = None,
                   left: Left | None = None) -> Wrenches:
    """The wrench on ``body`` that explains what is left in run ``i`` once ``named`` is in force.

    ``models``: those of all runs with ``named`` in force; ``left``: what they leave, if only a
    part of the rows shall count.
    """
    left = left or Left.of(study, models, named)
    run, name = study.runs[i], f"unit.{body}."
    window = max(WINDOW_S, run.length_s / _MOST_WINDOWS)
    rows = row_ranges(study)[i]
    seen = left.seen[rows].reshape(run.measured.shape)[:, 0]
    last_s = run.edges_s[1:][seen > 0.0].max(initial=run.edges_s[0] + window)
    starts = np.arange(run.edges_s[0], last_s - 0.5 * window, window)
    truck = with_effects(study.packed, named, run.recording.name)
    jobs = [(study.late(run, truck, float(start)), truck.unchecked({
        name + f"probe_{kind}": step, name + "probe_start_s": float(start),
        name + "probe_end_s": float(start + window)}))
        for kind, step in _UNITS.items() for start in starts]
    base = models[i]
    results = study.simulate(jobs)
    if progress:
        progress("locating", 1.0)
    scale = [_PRIOR[kind] / _UNITS[kind] for kind in _UNITS for _ in starts]
    columns = np.stack([run.change(r, base) * s for r, s in zip(results, scale, strict=True)],
                       axis=1)
    columns *= left.seen[rows][:, None]
    reach = left.projector.reach(columns, rows)
    information = columns.T @ columns - reach.T @ left.projector.solve(reach)
    gradient = columns.T @ left.removed[rows]
    factor = cho_factor(information + np.eye(columns.shape[1]))
    amounts = cho_solve(factor, gradient)
    covariance = cho_solve(factor, np.eye(columns.shape[1]))
    return _as_wrenches(run.recording.name, body, starts, window, amounts, covariance,
                        float(gradient @ amounts))


def _as_wrenches(recording: str, body: str, starts: Floats, window: float, amounts: Floats,
                 covariance: Floats, delta: float) -> Wrenches:
    """Split the solution into force histories and a line of action."""
    n = starts.size
    prior = np.repeat(list(_PRIOR.values()), n)
    values = amounts * prior
    sigma = np.sqrt(np.diag(covariance)) * prior
    fy, mz = values[n:2 * n], values[2 * n:]
    spread_y, spread_m = sigma[n:2 * n], sigma[2 * n:]
    weight = np.where(np.abs(fy) > 2.0 * spread_y, 1.0 / spread_m**2, 0.0)
    strength = float(np.sum(weight * fy * fy))
    x = float(np.sum(weight * mz * fy)) / strength if strength > 0 else float("inf")
    x_sigma = strength ** -0.5 if strength > 0 else float("inf")
    history = ForceHistory(recording, body, starts + 0.5 * window, values[:n], fy, mz,
                           sigma[:n], spread_y, spread_m)
    return Wrenches(history, window, delta, 3 * n, x, x_sigma)
