"""What the holdout speaks against alone is named with what makes it hold, and not without."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects import LIBRARY, Effect
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.fit.refit import refit
from truck_blowout_sim.diagnosis.fit.scatter import Chance, Scatter
from truck_blowout_sim.diagnosis.fit.shown import SCATTERS
from truck_blowout_sim.diagnosis.name.judging import Found
from truck_blowout_sim.diagnosis.name.pairing import masked_pair, pair_with, settled
from truck_blowout_sim.diagnosis.prove.holdout import predict
from truck_blowout_sim.vehicle import Packed

TRUE = {"driveline_drag": 2500.0, "axle_misalignment": 0.006}
Studies = Callable[..., Study]
CHANCE = Chance(Scatter(np.eye(SCATTERS.size)[0]), 20.0, 0.02)  # runs of a model of the same form


def changes(truck: Packed) -> dict[str, float]:
    every: dict[str, float] = {}
    for name, amount in TRUE.items():
        effect = effect_of(name)
        every |= dict(effect.values(truck, effect.places(truck.vehicle)[0], amount))
    return every


def effect_of(name: str) -> Effect:
    return next(e for e in LIBRARY if e.name == name and not e.variant)


def begun(study: Study) -> Found:
    """A search that has named nothing."""
    residual = study.residual()
    chi2 = study.projector().chi2(residual)
    before = predict(study, residual, ())
    return Found(chi2_null=chi2, chi2_after=chi2, models_null=list(study.models), before=before,
                 after=before)


def alone(study: Study, truck: Packed, name: str) -> Ranked:
    effect = effect_of(name)
    start = Hypothesis(effect, effect.places(truck.vehicle)[0], 0.0)
    one = refit(study, Ranked(start, 0.0, 100.0), study.projector().chi2(study.residual()))
    return replace(one, support=one.delta)


def drag_alone(study: Study, truck: Packed) -> Ranked:
    return alone(study, truck, "driveline_drag")


@pytest.fixture
def both(study_of: Studies, truck: Packed) -> Study:
    return study_of(changes(truck), holdout=changes(truck), baseline=True)


def test_it_is_named_with_what_makes_it_hold(both: Study, truck: Packed) -> None:
    found, models = begun(both), list(both.models)
    pair = pair_with(both, found, [drag_alone(both, truck)], CHANCE, 3, None)
    assert pair is not None
    named = {one.hypothesis.effect.name: one.hypothesis.amount for one in pair.named}
    assert set(named) == set(TRUE)
    assert named["driveline_drag"] == pytest.approx(2500.0, rel=0.1)
    assert sum(p.chi2 for p in pair.after) < sum(p.chi2 for p in found.before)
    assert pair.chi2 < found.chi2_null
    # nothing is named yet: that is for the search to do
    assert all((a == b).all() for a, b in zip(both.models, models, strict=True))
    assert found.named == []


def test_what_little_speaks_for_is_no_half_of_a_pair(both: Study, truck: Packed) -> None:
    weak = replace(drag_alone(both, truck), support=1.5 * CHANCE.asked)
    assert pair_with(both, begun(both), [weak], CHANCE, 3, None) is None
    assert pair_with(both, begun(both), [], CHANCE, 3, None) is None


def test_no_pair_where_only_one_may_be_named(both: Study, truck: Packed) -> None:
    assert pair_with(both, begun(both), [drag_alone(both, truck)], CHANCE, 1, None) is None


def test_no_pair_that_unseen_runs_speak_against(study_of: Studies, truck: Packed) -> None:
    study = study_of(changes(truck), holdout={}, baseline=True)  # there, nothing is missing
    assert pair_with(study, begun(study), [drag_alone(study, truck)], CHANCE, 3, None) is None


def test_what_is_named_alone_is_left_as_it_is(both: Study, truck: Packed) -> None:
    found = begun(both)
    found.named = [drag_alone(both, truck)]
    before = (list(found.named), found.chi2_after, found.after)
    settled(both, found)
    assert (found.named, found.chi2_after, found.after) == before


def weakly(study: Study, truck: Packed) -> list[Ranked]:
    """Both, each a little less supported than is asked."""
    return [replace(alone(study, truck, name), support=0.9 * CHANCE.asked) for name in TRUE]


def test_two_that_hide_each_other_are_named_together(both: Study, truck: Packed) -> None:
    found, weak = begun(both), weakly(both, truck)
    pair = masked_pair(both, found, weak, CHANCE)
    assert pair is not None
    for one in pair.named:
        assert one.hypothesis.amount == pytest.approx(TRUE[one.hypothesis.effect.name], rel=0.1)
        assert one.support > CHANCE.asked
    assert found.named == []
    assert masked_pair(both, found, weak[:1], CHANCE) is None
    faint = [replace(one, support=0.2 * CHANCE.asked) for one in weak]
    assert masked_pair(both, found, faint, CHANCE) is None


def test_what_hides_nothing_is_no_half_of_a_pair(study_of: Studies, truck: Packed) -> None:
    effect = effect_of("driveline_drag")
    only = dict(effect.values(truck, effect.places(truck.vehicle)[0], TRUE["driveline_drag"]))
    study = study_of(only, holdout=only, baseline=True)
    assert masked_pair(study, begun(study), weakly(study, truck), CHANCE) is None
