"""How well an amount is known where a parabola will not do: profile likelihood, block jackknife.

The profile follows the sum of squares away from its least, the truck simulated at each amount and
the nuisances fitted anew, until it has risen by 2.7 (90 %); a side on which it never does before
the bound of what is physical is open. The jackknife leaves out two seconds of a run at a time: how
far the amount then moves shows misfits that last longer than the weights assume.

References: A. Raue et al., Bioinformatics 25 (2009) 1923 (profile likelihood); H. R. Kuensch, Ann.
Statist. 17 (1989) 1217 (jackknife and bootstrap by blocks).
Known limits: other effects are held, and instants by the profile; the jackknife is linear, and a
few blocks say little.
Validated with: test/diagnosis/test_profile.py (both against the closed form of a Gaussian model).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from truck_blowout_sim.diagnosis.algebra.quantiles import NINETY
from truck_blowout_sim.diagnosis.case.study import Study, row_ranges
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.event_fit import amount_column, event_columns
from truck_blowout_sim.diagnosis.fit.models import models_at
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.fit.refit import chi2_of

_RISE = NINETY**2
_DOUBLINGS, _ROUNDS = 5, 4
_CLOSE = 0.02  # of the rise sought
_BLOCK_S = 2.0


@dataclass(frozen=True)
class Arms:
    """Distances from an amount to the ends of its 90 % interval, in the amount's own unit.

    Attributes:
        below, above: by profile likelihood; infinite where the recordings set no bound.
        block_sigma: standard error by leaving out blocks.
    """

    below: float
    above: float
    block_sigma: float

    def wider(self, form: float) -> tuple[float, float]:
        """Both arms with the blocks' scatter and 1 sigma of another form of law."""
        least, other = NINETY * self.block_sigma, NINETY * form
        return (float(np.hypot(max(self.below, least), other)),
                float(np.hypot(max(self.above, least), other)))


def arms_of(study: Study, found: Ranked, others: Sequence[Hypothesis] = ()) -> Arms:
    """The arms of one accepted effect, ``others`` in force."""
    h = found.hypothesis
    projector = study.projector([*others, h])

    def sum_at(amount: float) -> float:
        return chi2_of(study, projector, models_at(study, [h.at(amount)], others)[0])

    least, bounds = sum_at(h.amount), (h.effect.amount.low, h.effect.amount.high)
    below, above = (abs(_crossing(lambda a: sum_at(a) - least, h.amount, bound, found.sigma)
                        - h.amount) for bound in bounds)
    return Arms(below, above, block_sigma(study, found, others))


def _crossing(rise: Callable[[float], float], value: float, bound: float, sigma: float) -> float:
    """Where the sum of squares has risen enough on the side of ``bound``; infinite if nowhere."""
    side = np.sign(bound - value)
    if not side:
        return np.inf
    inside, beyond, root_inside, reach = value, value, 0.0, NINETY * sigma
    for _ in range(_DOUBLINGS):
        beyond = float(min(abs(bound - value), reach) * side + value)
        risen = rise(beyond)
        if risen >= _RISE:
            break
        inside, root_inside = beyond, float(np.sqrt(max(risen, 0.0)))
        if beyond == bound:
            return float(side * np.inf)
        reach *= 2.0
    else:
        return float(side * np.inf)
    for _ in range(_ROUNDS):  # the root of the rise is nearly linear in the distance
        share = (NINETY - root_inside) / (float(np.sqrt(risen)) - root_inside)
        trial = inside + share * (beyond - inside)
        here = rise(trial)
        if abs(here - _RISE) < _CLOSE * _RISE:
            return trial
        if here >= _RISE:
            beyond, risen = trial, here
        else:
            inside, root_inside = trial, float(np.sqrt(max(here, 0.0)))
    return beyond


def block_sigma(study: Study, found: Ranked, others: Sequence[Hypothesis] = (),
                block_s: float = _BLOCK_S) -> float:
    """Scatter of the amount when one block of the runs after the other is left out.

    The instants of an event move with it.
    """
    h = found.hypothesis
    columns, ranges = (event_columns(study, h, others) if h.times
                       else (amount_column(study, h, others, study.train)[:, None],
                             np.array([np.inf])))
    nuisances = study.columns[:, study.kept([*others, h])]
    design = np.column_stack([nuisances, columns])
    residual = study.residual(models_at(study, [h], others)[0])
    prior = np.concatenate([np.ones(nuisances.shape[1]), np.square(1.0 / ranges)])
    information, gradient = np.diag(prior) + design.T @ design, design.T @ residual
    amounts = []
    for rows in _blocks(study, block_s):
        part, left = design[rows], residual[rows]
        amounts.append(np.linalg.solve(information - part.T @ part, gradient - part.T @ left)
                       [nuisances.shape[1]])
    return float(np.sqrt((len(amounts) - 1) * np.var(amounts)))


def _blocks(study: Study, block_s: float) -> list[slice]:
    """Rows of each block, in which all channels are left out together."""
    bins = max(round(block_s / study.settings.bin_s), 1)
    found = []
    for run, rows in zip(study.runs, row_ranges(study), strict=True):
        channels = len(run.channels)
        found += [slice(first, min(first + bins * channels, rows.stop))
                  for first in range(rows.start, rows.stop, bins * channels)]
    return found
