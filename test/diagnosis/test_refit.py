"""Amounts found again in data that the model made itself."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import pytest

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects import LIBRARY, Effect
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.fit.refit import (
    chi2_of,
    chi2_with_each,
    difference_step,
    least_step,
    refit,
)
from truck_blowout_sim.diagnosis.fit.steady import rank_steady
from truck_blowout_sim.vehicle import Packed

Studies = Callable[..., Study]
CLEAR = 25.0  # fall of the sum of squares that noise alone does not reach
HUB = "trailer_2_left"


def fitted(study: Study, name: str, hub: str | None = None) -> tuple[Ranked, Ranked]:
    """Linear and nonlinear answer to one effect at its first place, or at a hub."""
    effect = next(e for e in LIBRARY if e.name == name)
    place = next(p for p in effect.places(study.packed.vehicle) if p.hub == hub)
    linear, = rank_steady(study, [Hypothesis(effect, place)]).ranked
    return linear, refit(study, linear, study.projector().chi2(study.residual()))


def weak_brake(truck: Packed, factor: float) -> Mapping[str, float]:
    return {f"hub.{HUB}.brake_gain": factor * truck[f"hub.{HUB}.brake_gain"]}


def test_half_a_brake_is_found_as_half(study_of: Studies, truck: Packed) -> None:
    study = study_of(weak_brake(truck, 0.5))
    _, found = fitted(study, "brake_imbalance", HUB)
    assert found.refitted
    assert found.hypothesis.amount == pytest.approx(-0.5, abs=3.0 * found.sigma)
    assert found.hypothesis.amount == pytest.approx(-0.5, abs=0.08)
    assert found.sigma < 0.08
    # its own lining is a nuisance that explains much of it: that is held against the sheet
    assert found.evidence > found.delta
    assert found.evidence > CLEAR


def test_a_brake_within_its_tolerance_is_no_evidence(study_of: Studies, truck: Packed) -> None:
    study = study_of(weak_brake(truck, 0.95))
    _, found = fitted(study, "brake_imbalance", HUB)
    assert found.hypothesis.amount == pytest.approx(-0.05, abs=3.0 * found.sigma)
    assert found.evidence < CLEAR


def test_a_soft_steering_is_found_with_its_factor(study_of: Studies, truck: Packed) -> None:
    study = study_of({"steering.stiffness_gain": truck["steering.stiffness_gain"] / 3.0})
    _, found = fitted(study, "steering_compliance")
    value = found.hypothesis.effect.amount.report(found.hypothesis.amount)
    assert value == pytest.approx(3.0, rel=0.15)
    assert found.evidence > CLEAR


def test_nothing_missing_gives_no_amount(study_of: Studies) -> None:
    study = study_of()
    for name in ("steering_compliance", "driveline_drag", "road_bank"):
        _, found = fitted(study, name)
        assert abs(found.hypothesis.amount) < 4.0 * found.sigma
        assert found.evidence < CLEAR


def test_what_a_nuisance_imitates_is_promising_for_what_it_buys_without_it(
    study_of: Studies, truck: Packed
) -> None:
    study = study_of(weak_brake(truck, 0.8))
    linear, _ = fitted(study, "brake_imbalance", HUB)
    assert linear.promise > linear.delta + 10.0


def test_beside_baseline_runs_an_effect_is_what_training_has_beyond_them(
    study_of: Studies, truck: Packed
) -> None:
    softer = {"steering.stiffness_gain": truck["steering.stiffness_gain"] / 1.5}
    study = study_of(softer, baseline=True)
    effect = next(e for e in LIBRARY if e.name == "steering_compliance")
    hypothesis = Hypothesis(effect, effect.places(truck.vehicle)[0])
    assert hypothesis.meaning(truck.vehicle) in study.known
    assert study.meaning(hypothesis) == ""
    _, found = fitted(study, "steering_compliance")
    assert found.hypothesis.amount == pytest.approx(0.5, abs=max(3.0 * found.sigma, 0.05))
    assert found.evidence == pytest.approx(found.delta)
    assert found.evidence > CLEAR


def test_each_law_of_an_effect_has_a_column_of_its_own(study_of: Studies) -> None:
    """A ratio that is wrong and one that bends, at one place: ranked together as each alone."""
    study = study_of({"steering.ratio": 22.0}, baseline=True)
    laws = [Hypothesis(effect, effect.places(study.packed.vehicle)[0]) for effect in LIBRARY
            if effect.name == "steering_ratio"]
    assert len({law.form for law in laws}) == 2
    assert len({law.key for law in laws}) == 1
    alone = {law.form: rank_steady(study, [law]).ranked[0] for law in laws}
    for one in rank_steady(study, laws).ranked:
        own = alone[one.hypothesis.form]
        assert one.hypothesis.amount == pytest.approx(own.hypothesis.amount)
        assert one.promise == pytest.approx(own.promise)


def test_a_tire_that_levels_off_early_is_seen_before_it_is_fitted(
    study_of: Studies, truck: Packed
) -> None:
    """A peak that is a third lower acts near the limit only: the slope at nothing missing is small,
    but ranking asks for large amounts, too."""
    lower = {"axle.steer.peak_scale": 0.35 * truck["axle.steer.peak_scale"]}
    study = study_of(lower)
    effect = next(e for e in LIBRARY if e.name == "tire_saturation" and not e.variant)
    hypothesis = Hypothesis(effect, effect.places(truck.vehicle)[0])
    far, = rank_steady(study, [hypothesis]).ranked
    near, = rank_steady(study, [replace(hypothesis, effect=replace(
        effect, amount=replace(effect.amount, grid=())))]).ranked
    assert far.promise > 1.5 * near.promise
    assert far.hypothesis.amount < -0.3


def test_models_of_one_run_are_weighed_together_as_they_are_one_by_one(
        study_of: Studies, truck: Packed) -> None:
    study = study_of(weak_brake(truck, 0.5))
    projector, i = study.projector(), study.train[0]
    trials = [study.models[i], 1.02 * study.models[i], 0.97 * study.models[i]]
    together = chi2_with_each(study, projector, {}, i, trials)
    assert together == pytest.approx([chi2_of(study, projector, {i: t}) for t in trials], rel=1e-9)
    assert together[0] < together[1:].min()


@pytest.mark.parametrize("effect", [pytest.param(effect, id=effect.name) for effect in LIBRARY])
def test_a_finite_difference_is_never_nothing_and_stays_inside_the_bounds(effect: Effect) -> None:
    amount = effect.amount
    middle = 0.5 * (amount.low + amount.high)
    for value in (amount.low, *amount.grid, middle, amount.high):
        assert least_step(amount, value) > 0.0
        step = difference_step(amount, value)
        assert abs(step) >= least_step(amount, value)
        assert amount.low <= value + step <= amount.high
