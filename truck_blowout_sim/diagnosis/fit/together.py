"""Fit several hypotheses together: Gauss-Newton on all their amounts, nuisances projected out.

An amount found while another effect was still missing leans towards that effect; what predicts
unseen runs is the amounts that hold together. Instants stay as they are.

References: Gauss-Newton with shortened steps (Nocedal and Wright 2006, section 10.3).
Known limits: from where each stands alone; no other start.
Validated with: test/diagnosis/test_together.py (two amounts that were each fitted alone).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.algebra.linear import joint_score
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.models import models_of
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.fit.refit import chi2_of, difference_step

Floats = NDArray[np.float64]
_ROUNDS = 4
_ENOUGH = 0.05  # of a standard error: the amounts have converged


def fit_together(study: Study, named: Sequence[Ranked]) -> tuple[list[Ranked], float]:
    """The same hypotheses at the amounts that fit together, and the sum of squares left."""
    hypotheses = [one.hypothesis for one in named]
    projector = study.projector(hypotheses)
    models = models_of(study, [hypotheses])[0]
    least = chi2_of(study, projector, models)
    sigmas = np.array([one.sigma for one in named])
    for _ in range(_ROUNDS):
        columns = _columns(study, hypotheses, models)
        removed = projector.remove(study.residual(models))
        move, covariance = joint_score(projector, removed, columns)
        sigmas = np.sqrt(np.diag(covariance))
        # the whole way, part of it, or one amount alone: near a limit they do not move as one
        ways = [move, 0.5 * move, 0.2 * move, *np.diag(move)]
        trials = [_moved(hypotheses, way) for way in ways]
        found = models_of(study, trials)
        sums = [chi2_of(study, projector, one) for one in found]
        best = int(np.argmin(sums))
        if not sums[best] < least:
            break
        hypotheses, models, least = trials[best], found[best], sums[best]
        if np.max(np.abs(move) / sigmas) < _ENOUGH:
            break
    return [replace(one, hypothesis=h, sigma=float(s))
            for one, h, s in zip(named, hypotheses, sigmas, strict=True)], least


def _columns(study: Study, hypotheses: Sequence[Hypothesis], models: Mapping[int, Floats]
             ) -> Floats:
    """[rows, k] whitened change per unit of each amount."""
    steps = [difference_step(h.effect.amount, h.amount) for h in hypotheses]
    ahead = models_of(study, [[h.at(h.amount + step) if j == k else h
                               for j, h in enumerate(hypotheses)] for k, step in enumerate(steps)])
    return np.stack([study.stack({i: study.runs[i].change(one[i], models[i])
                                  for i in study.train}) / step
                     for one, step in zip(ahead, steps, strict=True)], axis=1)


def _moved(hypotheses: Sequence[Hypothesis], move: Floats) -> list[Hypothesis]:
    """The hypotheses at other amounts, inside their bounds."""
    return [h.at(float(np.clip(h.amount + by, h.effect.amount.low, h.effect.amount.high)))
            for h, by in zip(hypotheses, move, strict=True)]
