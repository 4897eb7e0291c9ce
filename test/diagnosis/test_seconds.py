"""What each second of each run shows of an event, unseen runs too."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects import LIBRARY, Effect
from truck_blowout_sim.diagnosis.effects.base import Timing
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.begun import begun_everywhere
from truck_blowout_sim.diagnosis.fit.beside import Beside
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.fit.seconds import _best_event
from truck_blowout_sim.diagnosis.fit.timed import scan
from truck_blowout_sim.diagnosis.result.parts import Place
from truck_blowout_sim.vehicle import Packed

Studies = Callable[..., Study]


@pytest.mark.parametrize(("timing", "parts"), [
    ("pulse", [0.0, 0.0, 3.0, 3.0, 3.0, 0.0]),
    ("step", [0.0, 0.0, 3.0, 3.0, 3.0, 3.0]),
    ("ramp", [0.0, 1.0, 2.0, 3.0, 3.0, 3.0]),
])
def test_the_best_stretch_and_amount_of_a_run_are_found(timing: Timing, parts: list[float]) -> None:
    seconds = np.random.default_rng(3).standard_normal((400, 6))
    event = seconds @ np.array(parts)
    noise = 0.1 * np.random.default_rng(4).standard_normal(400)
    assert _best_event(timing, seconds, event + noise) == pytest.approx(event, abs=0.15)


def wind(truck: Packed) -> tuple[Effect, Place, dict[str, float]]:
    """A gust on the trailer, and what it sets."""
    effect = next(e for e in LIBRARY if e.name == "crosswind")
    place = next(p for p in effect.places(truck.vehicle) if p.body == "trailer")
    assert effect.timed is not None
    return effect, place, {**effect.values(truck, place, 15.0),
                           **effect.timed(truck, place, 2.2, 3.6)}


def scanned(study: Study, effect: Effect, place: Place) -> Ranked:
    beside = Beside.of(study, (), study.models)
    begun, = begun_everywhere(study, [Hypothesis(effect, place, effect.amount.step)])
    return scan(study, study.projector(), effect, place, begun, beside)


def test_unseen_runs_with_the_wind_of_training_add_support_and_calm_ones_cost_little(
    study_of: Studies, truck: Packed
) -> None:
    effect, place, blows = wind(truck)
    windy, calm, untold = (scanned(study_of(blows, holdout=held, baseline=True), effect, place)
                           for held in (blows, {}, None))
    assert untold.unseen == 0.0
    assert windy.unseen > 10.0
    assert -2.0 * np.log(4.0) < calm.unseen < 3.0
    # beyond what a search asks, though one training run may err by itself
    assert windy.support > calm.support > 14.0


def test_a_run_that_no_event_explains_adds_little(study_of: Studies, truck: Packed) -> None:
    """On ice, the wind's responses are those of a truck that holds the road."""
    effect, place, _ = wind(truck)
    ice = study_of({"world.friction_scale": 0.15}, baseline=True)
    found = scanned(ice, effect, place)
    assert found.delta > 1000.0
    assert found.support < 0.05 * found.delta
