"""Instants of events found again, and tires that fail unasked."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.answer.words import fitted_with
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects import LIBRARY, Effect
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.begun import begun_everywhere
from truck_blowout_sim.diagnosis.fit.event_fit import fit_event
from truck_blowout_sim.diagnosis.fit.instants import delayed
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.fit.refit import refit
from truck_blowout_sim.diagnosis.fit.timed import refine_times, scan, simulated_starts
from truck_blowout_sim.diagnosis.name.candidates import failed_tires, unwatched_tires
from truck_blowout_sim.diagnosis.name.events import fitted_event
from truck_blowout_sim.diagnosis.prove.intervals import time_intervals
from truck_blowout_sim.diagnosis.result.parts import Place
from truck_blowout_sim.recordings import Series
from truck_blowout_sim.vehicle import Packed

Studies = Callable[..., Study]


def on_grid(study: Study, effect: Effect, place: Place) -> Ranked:
    """An event at its best instants of the grid."""
    begun, = begun_everywhere(study, [Hypothesis(effect, place, effect.amount.step)])
    return scan(study, study.projector(), effect, place, begun)


def located(study: Study, name: str) -> tuple[Ranked, Ranked]:
    """An event on the trailer: on the grid, and refined."""
    effect = next(e for e in LIBRARY if e.name == name)
    place = next(p for p in effect.places(study.packed.vehicle) if p.body == "trailer")
    projector = study.projector()
    chi2 = projector.chi2(study.residual())
    rough = on_grid(study, effect, place)
    fine = refine_times(study, refit(study, refine_times(study, rough, chi2), chi2), chi2)
    return rough, fine


def test_a_gust_is_found_with_its_interval(study_of: Studies, truck: Packed) -> None:
    effect = next(e for e in LIBRARY if e.name == "crosswind")
    place = next(p for p in effect.places(truck.vehicle) if p.body == "trailer")
    assert effect.timed is not None
    study = study_of({**effect.values(truck, place, 18.0),
                      **effect.timed(truck, place, 2.33, 4.21)})
    rough, fine = located(study, "crosswind")
    assert fine.delta >= rough.delta - 1e-6
    start, end = fine.hypothesis.times["run 1"]
    assert start == pytest.approx(2.33, abs=0.15)
    assert end == pytest.approx(4.21, abs=0.15)
    assert fine.hypothesis.amount == pytest.approx(18.0, rel=0.15)


@pytest.mark.parametrize("moves_for_s", [0.9, 2.5])
def test_a_shifting_load_is_found_with_its_instant_and_how_long_it_moves(
        study_of: Studies, truck: Packed, moves_for_s: float) -> None:
    effect = next(e for e in LIBRARY if e.name == "payload_shift")
    place, = effect.places(truck.vehicle)
    assert effect.timed is not None
    study = study_of({**effect.values(truck, place, -0.4),
                      **effect.timed(truck, place, 3.17, 3.17 + moves_for_s)})
    _, fine = located(study, "payload_shift")
    found = fit_event(study, fine, study.projector().chi2(study.residual()))
    start, end = found.hypothesis.times["run 1"]
    assert start == pytest.approx(3.17, abs=0.15)
    assert end - start == pytest.approx(moves_for_s, rel=0.15)
    assert found.hypothesis.amount == pytest.approx(-0.4, abs=0.04)
    low, high = time_intervals(study, found)["run 1"].onset_s
    assert low < start < high
    assert high - low < 1.0 + 2.0 * 1.645 * 0.3 * moves_for_s  # of which for another way to slide


def test_the_block_that_moved_explains_more_than_the_other(study_of: Studies, truck: Packed
                                                           ) -> None:
    foremost, rearmost = (e for e in LIBRARY if e.name == "payload_shift" and e.variant)
    place, = rearmost.places(truck.vehicle)
    assert rearmost.timed is not None
    study = study_of({**rearmost.values(truck, place, 0.3),
                      **rearmost.timed(truck, place, 2.5, 3.2)})
    front, rear = (on_grid(study, e, place) for e in (foremost, rearmost))
    assert rear.delta > 1.2 * front.delta
    assert rear.hypothesis.times["run 1"][0] == pytest.approx(2.5, abs=0.3)


def test_a_large_loss_of_grip_begins_where_simulations_have_it(study_of: Studies, truck: Packed
                                                              ) -> None:
    effect = next(e for e in LIBRARY if e.name == "friction_change")
    place, = effect.places(truck.vehicle)
    assert effect.timed is not None
    study = study_of({**effect.values(truck, place, -0.85),
                      **effect.timed(truck, place, 2.4, np.inf)})
    chi2 = study.projector().chi2(study.residual())
    away = Ranked(Hypothesis(effect, place, -0.2, {"run 1": (0.4, np.inf)}), 0.0, 1.0)
    begun = simulated_starts(study, away, chi2)[0]
    assert begun.hypothesis.amount == min(effect.amount.grid)
    assert begun.hypothesis.times["run 1"][0] == pytest.approx(2.4, abs=1.0)
    found = fit_event(study, refine_times(study, begun, chi2), chi2)
    assert found.hypothesis.amount == pytest.approx(-0.85, abs=0.03)
    assert found.delta > 0.9 * chi2


def test_numbers_of_an_event_settle_together(study_of: Studies, truck: Packed) -> None:
    effect = next(e for e in LIBRARY if e.name == "crosswind")
    place = next(p for p in effect.places(truck.vehicle) if p.body == "trailer")
    assert effect.timed is not None
    study = study_of({**effect.values(truck, place, 18.0),
                      **effect.timed(truck, place, 2.33, 4.21)})
    chi2 = study.projector().chi2(study.residual())
    away = Ranked(Hypothesis(effect, place, 14.0, {"run 1": (2.5, 4.0)}), 0.0, 1.0)
    found = fit_event(study, away, chi2)
    start, end = found.hypothesis.times["run 1"]
    assert start == pytest.approx(2.33, abs=0.06)
    assert end == pytest.approx(4.21, abs=0.06)
    assert found.hypothesis.amount == pytest.approx(18.0, abs=4.0 * found.sigma)
    assert found.delta > 0.0


def test_what_no_sheet_says_of_a_wind_is_fitted_with_it(study_of: Studies, truck: Packed) -> None:
    """A wind that pushes back and takes hold higher than the sheet has it."""
    effect = next(e for e in LIBRARY if e.name == "crosswind")
    place = next(p for p in effect.places(truck.vehicle) if p.body == "trailer")
    true = Hypothesis(effect, place, 25.0, {"run 1": (2.33, 4.21)}, (0.0, 1.5, 1.0))
    windy = true.apply(truck, "run 1")
    assert effect.timed is not None
    keys = [n.key.format(unit="trailer") for n in effect.form_numbers]
    study = study_of({key: windy[key] for key in [
        *effect.values(truck, place, 25.0), *effect.timed(truck, place, 2.33, 4.21), *keys]})
    chi2 = study.projector().chi2(study.residual())
    away = Ranked(replace(true, amount=20.0, times={"run 1": (2.5, 4.0)}, shape=()), 0.0, 1.0)
    without = fit_event(study, replace(away, hypothesis=replace(
        away.hypothesis, effect=replace(effect, form_numbers=()))), chi2)
    found = fit_event(study, away, chi2)
    assert found.delta > without.delta
    assert abs(found.hypothesis.amount - 25.0) < abs(without.hypothesis.amount - 25.0)
    assert found.hypothesis.shape[1] > 0.3
    assert found.hypothesis.shape[2] > 0.3
    numbers = found.hypothesis.law_numbers(truck)
    applied = found.hypothesis.apply(truck, "run 1")
    assert numbers == {key: applied[key] for key in keys}
    assert f"gust_drag_share = {applied[keys[2]]:.2g}" in fitted_with(numbers)


def test_a_small_hole_is_found_from_a_large_one(study_of: Studies, truck: Packed) -> None:
    """Sizes of holes differ by decades, and so must the differences by which one is fitted."""
    effect = next(e for e in LIBRARY if e.name == "secondary_blowout")
    place = next(p for p in effect.places(truck.vehicle) if p.tire == "steer_right")
    true = Hypothesis(effect, place, 0.03, {"run 1": (1.3, np.inf)})
    lost = true.apply(truck, "run 1")
    study = study_of({key: lost[key] for key in (
        "tire.steer_right.blow_hole_scale", "tire.steer_right.blow_time_s")})
    chi2 = study.projector().chi2(study.residual())
    away = Ranked(replace(true, amount=0.1, times={"run 1": (2.3, np.inf)}), 0.0, 1.0)
    found = fitted_event(study, away, chi2)
    assert found.hypothesis.amount == pytest.approx(0.03, rel=0.1)
    assert found.hypothesis.times["run 1"][0] == pytest.approx(1.3, abs=0.1)
    assert found.delta > 0.9 * chi2


def test_a_tire_is_unwatched_where_its_pressure_is_not_recorded(study_of: Studies) -> None:
    study = study_of()
    run = study.runs[0]
    everywhere = unwatched_tires(study)
    assert [p.hub for p in everywhere] == list(study.packed.vehicle.hubs)
    t = run.drive.times_s
    watched = replace(run.recording, channels={
        **run.recording.channels, "tire_pressure_steer_left_pa": Series(t, np.full(t.size, 7e5))})
    study.runs = (replace(run, recording=watched),)
    assert "steer_left" not in {p.tire for p in unwatched_tires(study)}
    assert len(unwatched_tires(study)) == len(everywhere) - 1


def test_no_event_is_worth_nothing(study_of: Studies) -> None:
    study = study_of()
    effect = next(e for e in LIBRARY if e.name == "crosswind")
    place = effect.places(study.packed.vehicle)[0]
    assert on_grid(study, effect, place).delta < 35.0  # the best of many instants


def test_a_tire_that_loses_its_air_unasked_is_a_candidate(study_of: Studies) -> None:
    study = study_of()
    run = study.runs[0]
    t = run.drive.times_s
    flat = Series(t, np.where(t < 3.0, 7e5, 7e5 * np.exp(-(t - 3.0))))
    sound = Series(t, np.full(t.size, 7e5) - 1e4 * t)
    recording = replace(run.recording, channels={
        **run.recording.channels, "tire_pressure_trailer_1_left_outer_pa": flat,
        "tire_pressure_steer_left_pa": sound})
    study.runs = (replace(run, recording=recording),)
    found = failed_tires(study, study.train)
    assert list(found) == ["trailer_1_left_outer"]
    assert found["trailer_1_left_outer"]["run 1"] == pytest.approx(3.0, abs=0.1)


@pytest.mark.parametrize("bins", [0, 3, 5, 8])
def test_what_comes_later_than_a_run_lasts_changes_nothing(bins: int) -> None:
    change = np.arange(1.0, 11.0).reshape(5, 2)
    moved = delayed(change, bins)
    assert not moved[:bins].any()
    np.testing.assert_array_equal(moved[bins:], change[:max(5 - bins, 0)])
