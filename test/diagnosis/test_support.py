"""A hypothesis is supported by runs that show it alike, and by those that do without."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects import LIBRARY
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.beside import Beside
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.fit.scatter import Chance, Scatter
from truck_blowout_sim.diagnosis.fit.shown import SCATTERS
from truck_blowout_sim.diagnosis.fit.support import support_of_unseen, supported
from truck_blowout_sim.recordings import Blowout
from truck_blowout_sim.vehicle import Packed

Studies = Callable[..., Study]
HUB = "trailer_2_left"
CHANCE = Chance(Scatter(np.eye(SCATTERS.size)[0]), 20.0, 0.02)  # runs of a model of the same form


def weak_brake(truck: Packed) -> Mapping[str, float]:
    return {f"hub.{HUB}.brake_gain": 0.5 * truck[f"hub.{HUB}.brake_gain"]}


def hypothesis(study: Study, name: str, amount: float, hub: str | None = None,
               times: Mapping[str, tuple[float, float]] | None = None) -> Ranked:
    effect = next(e for e in LIBRARY if e.name == name)
    place = next(p for p in effect.places(study.packed.vehicle) if p.hub == hub)
    return Ranked(Hypothesis(effect, place, amount, times or {}), 0.0, 0.1)


def support_of(study: Study, name: str, amount: float, hub: str | None = None,
               times: Mapping[str, tuple[float, float]] | None = None) -> float:
    one = hypothesis(study, name, amount, hub, times)
    return supported(study, one, Beside.of(study, (), study.models), CHANCE).support


def test_half_a_brake_is_supported_and_a_sound_one_is_not(
    study_of: Studies, truck: Packed
) -> None:
    weak, sound = study_of(weak_brake(truck), baseline=True), study_of(baseline=True)
    assert support_of(weak, "brake_imbalance", -0.5, HUB) > CHANCE.asked
    assert support_of(sound, "brake_imbalance", -0.5, HUB) < CHANCE.asked


def test_unseen_runs_speak_for_it_or_against(study_of: Studies, truck: Packed) -> None:
    """The amount is not fitted to them; they say whether it holds there."""
    alone = study_of(weak_brake(truck))
    joined = study_of(weak_brake(truck), holdout=weak_brake(truck))
    without = study_of(weak_brake(truck), holdout={})
    found = [support_of(study, "brake_imbalance", -0.5, HUB) for study in (without, alone, joined)]
    assert found[0] < found[1] < found[2]


def test_what_unseen_runs_add_is_told_apart(study_of: Studies, truck: Packed) -> None:
    """Where they show it, its support grows by them; where they do without, it falls."""
    alone = support_of(study_of(weak_brake(truck)), "brake_imbalance", -0.5, HUB)
    for holdout, sign in ((weak_brake(truck), 1.0), ({}, -1.0)):
        study = study_of(weak_brake(truck), holdout=holdout)
        beside = Beside.of(study, (), study.models)
        one = hypothesis(study, "brake_imbalance", -0.5, HUB)
        one = supported(study, one, beside, CHANCE)
        added = support_of_unseen(study, one, beside, CHANCE)
        assert sign * added > 0.0
        assert one.support - added == pytest.approx(alone)


@pytest.mark.parametrize("shown", [True, False])
def test_beside_an_event_unseen_runs_are_asked_where_it_is_placed_in_them(
    study_of: Studies, truck: Packed, shown: bool
) -> None:
    """A breath of wind is named; whether the brake is weak, unseen runs tell as well."""
    study = study_of(weak_brake(truck), holdout=weak_brake(truck) if shown else {})
    one, (unseen,) = hypothesis(study, "brake_imbalance", -0.5, HUB), study.holdout
    wind = hypothesis(study, "crosswind", 1e-3, times={
        study.runs[i].recording.name: (3.0, 5.0) for i in study.train}).hypothesis
    there = replace(wind, times={unseen.recording.name: (4.0, 6.0)})
    open_, placed = (Beside.of(study, (wind,), study.models, known) for known in ((), ((there,),)))
    assert not open_.unseen
    assert len(placed.unseen) == 1
    alone, told = (supported(study, one, beside, CHANCE).support for beside in (open_, placed))
    assert (told > alone) is shown


def test_no_amount_has_no_support(study_of: Studies) -> None:
    assert support_of(study_of(), "road_bank", 0.0) == 0.0


def test_a_free_instant_costs(study_of: Studies) -> None:
    """A gust that nothing calls for: the search for its instant is paid for."""
    study = study_of()
    times = {study.runs[i].recording.name: (3.0, 5.0) for i in study.train}
    assert support_of(study, "crosswind", 3.0, times=times) < 0.0


@pytest.mark.parametrize("name", ["road_bank", "driveline_drag"])
def test_what_is_true_is_supported_most_at_its_amount(
    study_of: Studies, truck: Packed, name: str
) -> None:
    effect = next(e for e in LIBRARY if e.name == name and not e.variant)
    size = 16.0 * effect.strays(truck)[0]
    study = study_of(effect.values(truck, effect.places(truck.vehicle)[0], size), baseline=True)
    assert support_of(study, name, size) > CHANCE.asked


def test_a_tire_that_only_training_lost_tells_nothing_of_its_axle(
    study_of: Studies, truck: Packed
) -> None:
    """The brake is applied at 4.8 s, after a tire of its axle is lost, or one of another axle."""
    study = study_of(weak_brake(truck), baseline=True)

    def lost(tire: str, time_s: float, *roles: str) -> Study:
        return replace(study, runs=tuple(
            replace(run, recording=replace(run.recording, blowouts=(Blowout(time_s, (tire,)),)))
            if run.role in roles else run for run in study.runs))

    own, other = "trailer_2_right_outer", "steer_left"
    whole = support_of(study, "brake_imbalance", -0.5, HUB)
    assert support_of(lost(own, 4.0, "train"), "brake_imbalance", -0.5, HUB) < 0.1 * whole
    for told in (lost(other, 4.0, "train"), lost(own, 6.9, "train"),
                 lost(own, 4.0, "train", "baseline")):
        assert support_of(told, "brake_imbalance", -0.5, HUB) > CHANCE.asked


def test_an_unseen_run_that_nothing_explains_does_not_set_the_numbers_of_the_sheet(
    study_of: Studies, truck: Packed
) -> None:
    """Its instruments swing by hundreds of their widths: the other runs still tell of the brake."""
    joined = study_of(weak_brake(truck), holdout=weak_brake(truck), baseline=True)
    spoiled = []
    for run in joined.holdout:
        swing = np.sin(np.arange(run.measured.shape[0]) / 5.0)[:, None]
        spoiled.append(replace(run, measured=run.measured + 300.0 * run.sigma * swing))
    found = support_of(replace(joined, holdout=tuple(spoiled)), "brake_imbalance", -0.5, HUB)
    assert found > CHANCE.asked
    assert found > 0.5 * support_of(study_of(weak_brake(truck), baseline=True),
                                    "brake_imbalance", -0.5, HUB)


def test_what_shows_only_while_a_load_moves_is_not_supported_beside_it(
    study_of: Studies, truck: Packed
) -> None:
    """The weak brake is applied at 4.8 s, while the load moves or seconds after it came to rest."""
    study = study_of(weak_brake(truck), baseline=True)
    effect = next(e for e in LIBRARY if e.name == "payload_shift" and not e.variant)
    place = next(p for p in effect.places(truck.vehicle) if p.body == "trailer")
    one = hypothesis(study, "brake_imbalance", -0.5, HUB)
    alone = supported(study, one, Beside.of(study, (), study.models), CHANCE).support

    def beside(start_s: float, end_s: float) -> float:
        load = Hypothesis(effect, place, 1e-6, {"run 1": (start_s, end_s)})
        return supported(study, one, Beside.of(study, (load,), study.models), CHANCE).support

    assert beside(4.5, 7.0) < 0.1 * alone
    assert CHANCE.asked < beside(0.6, 1.2) <= alone + 1e-6
