"""A hub that is held back is named, and by how much."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects import LIBRARY
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.models import models_at
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.fit.refit import refit
from truck_blowout_sim.diagnosis.fit.scatter import SCATTERS, Scatter
from truck_blowout_sim.diagnosis.locate.lagging import lagging_wheel
from truck_blowout_sim.vehicle import Packed

HUB = "trailer_2_left"
Studies = Callable[..., Study]
STILL = Scatter(np.eye(SCATTERS.size)[0])  # no amount scatters


def in_force(study: Study, amount: float = 0.0) -> Hypothesis:
    """A drag of the driveline: of so many newtons, or the best amount; the models have it."""
    effect = next(e for e in LIBRARY if e.name == "driveline_drag" and not e.variant)
    named = Hypothesis(effect, effect.places(study.packed.vehicle)[0], amount)
    if not amount:
        chi2 = study.projector().chi2(study.residual())
        named = refit(study, Ranked(named.at(1000.0), 0.0, 100.0), chi2).hypothesis
    for i, model in models_at(study, [named], ())[0].items():
        study.models[i] = model
    return named


def held_back(study_of: Studies, truck: Packed, baseline: bool = True,
              hubs: tuple[str, ...] = (HUB,)) -> Study:
    """One hub rolls as if its bearing seized: its tires resist fifteen times as much."""
    names = [f"tire.{tire}.rolling_0" for hub in hubs for tire in truck.vehicle.tires_of_hub(hub)]
    return study_of({name: 15.0 * truck[name] for name in names}, baseline=baseline)


def test_the_wheel_that_is_held_back_is_named_and_by_how_much(
    study_of: Studies, truck: Packed
) -> None:
    study = held_back(study_of, truck)
    lag = lagging_wheel(study, [in_force(study)], STILL)
    assert lag is not None
    assert lag.hub == HUB
    assert lag.slip > 5.0 * lag.sigma
    run, model = study.runs[study.train[0]], study.models[study.train[0]]
    hub, road = (run.channels.index(n) for n in (f"hub_speed_{HUB}_radps", "trailer_vx_mps"))
    rolled = run.measured[:, hub] / model[:, hub] / (run.measured[:, road] / model[:, road])
    seen = 1.0 - float(np.nanmean(rolled[run.edges_s[1:] < 4.5]))
    assert lag.slip == pytest.approx(seen, rel=0.3)
    assert HUB in lag.sentence


def test_what_both_wheels_of_an_axle_have_is_no_matter_of_one_wheel(
    study_of: Studies, truck: Packed
) -> None:
    study = held_back(study_of, truck, hubs=(HUB, "trailer_2_right"))
    assert lagging_wheel(study, [in_force(study)], STILL) is None


def test_a_drag_that_is_named_rightly_leaves_no_wheel_behind(study_of: Studies) -> None:
    study = study_of({"driveline.drag_extra_n": 3000.0}, baseline=True)
    assert lagging_wheel(study, [in_force(study, 3000.0)], STILL) is None


def test_without_a_drag_or_a_baseline_no_wheel_is_accused(
    study_of: Studies, truck: Packed
) -> None:
    assert lagging_wheel(held_back(study_of, truck), [], STILL) is None
    alone = held_back(study_of, truck, baseline=False)
    assert lagging_wheel(alone, [in_force(alone)], STILL) is None


def test_a_hub_that_something_named_holds_is_not_asked(study_of: Studies, truck: Packed) -> None:
    study = held_back(study_of, truck)
    brake = next(e for e in LIBRARY if e.name == "brake_imbalance")
    place = next(p for p in brake.places(truck.vehicle) if p.hub == HUB)
    drag = in_force(study)
    assert lagging_wheel(study, [drag, Hypothesis(brake, place, 0.0)], STILL) is None
