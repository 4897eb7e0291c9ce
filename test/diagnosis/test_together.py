"""Amounts that were each found while the other effect was still missing."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects import LIBRARY
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.fit.refit import refit
from truck_blowout_sim.diagnosis.fit.together import fit_together
from truck_blowout_sim.vehicle import Packed

TRUE = {"aerodynamic_drag": 4.0, "driveline_drag": 2500.0}


@pytest.fixture(scope="module")
def study(study_of: Callable[..., Study], truck: Packed) -> Study:
    changes: dict[str, float] = {}
    for one in hypotheses(truck):
        changes |= dict(one.effect.values(truck, one.place, TRUE[one.effect.name]))
    return study_of(changes, baseline=True)


def hypotheses(truck: Packed) -> list[Hypothesis]:
    """Two drags, which only the way they grow with speed tells apart."""
    effects = [next(e for e in LIBRARY if e.name == name and not e.variant) for name in TRUE]
    return [Hypothesis(e, e.places(truck.vehicle)[0], 0.0) for e in effects]


def alone(study: Study, one: Hypothesis) -> Ranked:
    chi2 = study.projector().chi2(study.residual())
    return refit(study, Ranked(one, 0.0, 100.0), chi2)


def test_together_they_find_the_amounts_that_neither_finds_alone(
    study: Study, truck: Packed
) -> None:
    one_by_one = [alone(study, one) for one in hypotheses(truck)]
    fitted, chi2 = fit_together(study, one_by_one)
    for before, after in zip(one_by_one, fitted, strict=True):
        true = TRUE[after.hypothesis.effect.name]
        assert abs(before.hypothesis.amount - true) > 3.0 * before.sigma
        assert abs(after.hypothesis.amount - true) < 3.0 * after.sigma
        assert after.sigma > before.sigma  # what the other one does not settle stays open
    assert chi2 < study.projector([r.hypothesis for r in fitted]).chi2(study.residual())


def test_amounts_that_hold_together_stay(study: Study, truck: Packed) -> None:
    fitted, chi2 = fit_together(study, [alone(study, one) for one in hypotheses(truck)])
    again, same = fit_together(study, fitted)
    assert same <= chi2
    for before, after in zip(fitted, again, strict=True):
        assert after.hypothesis.amount == pytest.approx(before.hypothesis.amount,
                                                        abs=0.2 * before.sigma)


def test_amounts_stay_inside_their_bounds(study: Study, truck: Packed) -> None:
    far = [Ranked(one.at(one.effect.amount.high), 0.0, 1.0) for one in hypotheses(truck)]
    fitted, chi2 = fit_together(study, far)
    assert np.isfinite(chi2)
    for one in fitted:
        amount = one.hypothesis.effect.amount
        assert amount.low <= one.hypothesis.amount <= amount.high
