"""Which run would tell explanations apart that these recordings cannot: tried by simulation.

Each manoeuvre is driven with either explanation in force. Where they differ most, the sheet numbers
are varied too: what the recordings leave open of them, and what either explanation asks of them, is
no separation. The rest, in units of what instruments and good models of one truck differ by, is
what the run would show.

Known limits: nuisances linear; an event that nobody can command does not happen in the new run, and
effects that begin at an instant and stay are not tried.
Validated with: test/diagnosis/test_next_test.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cholesky

from truck_blowout_sim.comparison.words import labels_for
from truck_blowout_sim.diagnosis.algebra.linear import Projector
from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.case.study import Study, instrument_columns
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.models import models_at, with_effects
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.prove.manoeuvres import manoeuvres

Floats = NDArray[np.float64]
Pair = tuple[Hypothesis, Hypothesis]
_MOST_PROJECTED = 3  # manoeuvres in which nuisances are varied: nearly all of the time
_CLEAR_SIGMA = 3.0
_GENTLE_MPS2, _HARDER = 2.0, 1.2
_ON_ITS_SIDE_RAD = 0.26  # 15 deg: no sprung body leans so far on its wheels


@dataclass(frozen=True)
class Separation:
    """What the best of the tried runs would show.

    Attributes:
        pair: the two explanations, the better one first.
        manoeuvre: in words; ``tried``: how many there were to choose from.
        channel: in words, the one that differs most, by ``sigma`` over the run.
    """

    pair: Pair
    manoeuvre: str
    channel: str
    sigma: float
    tried: int

    def __str__(self) -> str:
        if self.sigma < _CLEAR_SIGMA:
            return (f"None of {self.tried} simulated maneuvers would show a difference of more "
                    f"than {max(self.sigma, 0.1):.1f} sigma in a channel recorded here.")
        return (f"Of {self.tried} simulated maneuvers {self.manoeuvre} separates them best: "
                f"{self.channel} would differ by {self.sigma:.0f} sigma.")


def best_test(study: Study, rivals: Sequence[Ranked], named: Sequence[Hypothesis]
              ) -> Separation | None:
    """The run that best separates an effect from what explains as much.

    Args:
        rivals: an alias set, the accepted effect first; ``named``: all that was accepted.

    Returns:
        None where there is nothing to separate, or no manoeuvre could be tried.
    """
    pair = pair_of(rivals)
    if pair is None:
        return None
    others = [h for h in named if h.key not in {one.key for one in pair}]
    tried = [(run, change) for run in manoeuvres(study)
             if (change := _difference(study, run, pair, others)) is not None]
    tried.sort(key=lambda one: -float(one[1] @ one[1]))
    asked = _asked(study, pair, others)
    found = [_separation(study, run, change, pair, others, asked, len(tried))
             for run, change in tried[:_MOST_PROJECTED]]
    return max(found, key=lambda one: one.sigma, default=None)


def pair_of(rivals: Sequence[Ranked]) -> Pair | None:
    """The two explanations to separate, of different names if there are such."""
    if len(rivals) < 2:
        return None
    best = rivals[0].hypothesis
    other = next((r.hypothesis for r in rivals[1:]
                  if r.hypothesis.effect.name != best.effect.name), rivals[1].hypothesis)
    timings = [h.effect.timing for h in (best, other) if h.times]
    stays = "step" in timings or "ramp" in timings
    return None if stays or len(timings) == 2 else (best, other)


def _difference(study: Study, run: Run, pair: Pair, others: Sequence[Hypothesis]) -> Floats | None:
    """Whitened: second explanation less the first; None if no driver could drive it."""
    name = run.recording.name
    truck = with_effects(study.packed, others, name)
    first, second = study.simulate([(run, h.apply(truck, name)) for h in pair])
    if not all(drivable(run.channels, rows, hardest_mps2(study)) for rows in (first, second)):
        return None
    return run.change(second, first)


def hardest_mps2(study: Study) -> float:
    """Lateral acceleration that a test driver may be asked for.

    A fifth more than these recordings already hold, and 2 m/s2 in any case, half of the rollover
    threshold of a loaded truck (0.35 to 0.5 g: C. Winkler, Rollover of Heavy Commercial Vehicles,
    UMTRI Research Review 31-4, 2000).
    """
    seen = [float(np.nanpercentile(np.abs(run.recording[name].value), 99.0))
            for run in study.runs for name in ("tractor_ay_mps2",) if name in run.recording]
    return max([_GENTLE_MPS2, *(_HARDER * one for one in seen)])


def drivable(channels: Sequence[str], rows: Floats, hardest: float) -> bool:
    """Whether a simulated run is one that a driver can be asked to drive.

    Args:
        channels: of the rows' columns.
        rows: [n, m] bin means.
        hardest: lateral acceleration [m/s2] that may be asked for.
    """
    if not np.isfinite(rows).all():
        return False
    for k, name in enumerate(channels):
        largest = float(np.max(np.abs(rows[:, k]), initial=0.0))
        if name.endswith("_roll_rad") and largest > _ON_ITS_SIDE_RAD:
            return False
        if name.endswith("_ay_mps2") and largest > hardest:
            return False
    return True


def _asked(study: Study, pair: Pair, others: Sequence[Hypothesis]) -> Floats:
    """By how much the joint fits with the two explanations differ in each sheet number."""
    projector, at = study.projector([*others, *pair]), _sheet(study, pair, others)
    first, second = (projector.amounts(study.residual(models))
                     for models in models_at(study, pair, others))
    return np.asarray((second - first)[[k for k, _ in at]])


def _sheet(study: Study, pair: Pair, others: Sequence[Hypothesis]) -> list[tuple[int, str]]:
    """Position among the kept nuisances, and name, of each number of the sheet."""
    sheet = {n.name for n in study.settings.nuisances}
    return [(k, study.names[j]) for k, j in enumerate(study.kept([*others, *pair]))
            if study.names[j] in sheet]


def _separation(study: Study, run: Run, change: Floats, pair: Pair, others: Sequence[Hypothesis],
                asked: Floats, tried: int) -> Separation:
    """What is left of a difference, nuisances projected out, in the channel that shows it best."""
    at = [k for k, _ in _sheet(study, pair, others)]
    sheet = _sensitivities(study, run, [name for _, name in _sheet(study, pair, others)])
    known = study.projector([*others, *pair]).covariance()[np.ix_(at, at)]
    open_yet = sheet @ cholesky(known + 1e-12 * np.eye(len(at)), lower=True)
    columns = np.column_stack([open_yet, *instrument_columns(study, run)])
    left = change + sheet @ asked
    cells = np.arange(left.size).reshape(run.measured.shape)
    sums = [Projector.of(columns[rows]).chi2(left[rows]) for rows in cells.T]
    best = int(np.argmax(sums))
    label = labels_for(study.packed.vehicle).get(run.channels[best], run.channels[best])
    return Separation(pair, run.recording.name, label, float(np.sqrt(sums[best])), tried)


def _sensitivities(study: Study, run: Run, names: Sequence[str]) -> Floats:
    """[rows, k] whitened change of a run per prior sigma of each sheet number."""
    sheet = [n for n in study.settings.nuisances if n.name in set(names)]
    shown = [n for n in sheet if run.shows(n.only)]
    results = dict(zip((n.name for n in shown), study.simulate(
        [(run, study.packed.unchecked(n.values(study.packed, n.step))) for n in shown]),
        strict=True))
    return np.stack([run.change(results[n.name], run.measured) * (n.sigma / n.step)
                     if n.name in results else np.zeros(run.measured.size) for n in sheet], axis=1)
