"""Intervals of onset and duration: they hold the truth, widen with doubt, and may be open."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects import LIBRARY
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.prove.intervals import _SHAPE, Timing, time_intervals
from truck_blowout_sim.vehicle import Packed

Studies = Callable[..., Study]
START_S, END_S = 2.33, 4.21


def event(truck: Packed, name: str, amount: float, start_s: float, end_s: float) -> Ranked:
    """The effect on the trailer during an interval, as found."""
    effect = next(e for e in LIBRARY if e.name == name)
    place = next(p for p in effect.places(truck.vehicle) if p.body == "trailer")
    return Ranked(Hypothesis(effect, place, amount, {"run 1": (start_s, end_s)}), 500.0, 0.1)


def bank(truck: Packed, amount: float, start_s: float) -> Ranked:
    """A road that is banked from an instant on, all at once as other events that stay."""
    effect = replace(
        next(e for e in LIBRARY if e.name == "road_bank" and e.timed), timing="step",
        timed=lambda packed, place, start, end: {"world.bank_change_time_s": start})
    place, = effect.places(truck.vehicle)
    return Ranked(Hypothesis(effect, place, amount, {"run 1": (start_s, np.inf)}), 500.0, 0.1)


def timing(study: Study, found: Ranked) -> Timing:
    found_in: Mapping[str, Timing] = time_intervals(study, found)
    assert list(found_in) == ["run 1"]
    return found_in["run 1"]


def width(interval: tuple[float, float]) -> float:
    return interval[1] - interval[0]


def test_a_weaker_gust_is_known_less_well(study_of: Studies, truck: Packed) -> None:
    study = study_of()
    strong, weak = (timing(study, event(truck, "crosswind", wind_mps, START_S, END_S))
                    for wind_mps in (18.0, 8.0))
    assert strong.duration_s is not None
    assert weak.duration_s is not None
    assert np.mean(strong.onset_s) == pytest.approx(START_S)
    assert np.mean(strong.duration_s) == pytest.approx(END_S - START_S)
    shape = 2.0 * 1.645 * np.hypot(0.3, _SHAPE * (END_S - START_S))  # of another kind of gust
    assert shape < width(strong.onset_s) < width(weak.onset_s) < shape + 0.5
    assert 0.05 < width(strong.duration_s) < width(weak.duration_s)


def test_another_shape_of_the_same_force_middle_and_width_begins_within_the_interval() -> None:
    """Closed form: (1 - cos) beside on-off, a load that slides ever faster beside an even one."""
    t = np.linspace(0.0, 1.0, 20001)
    for rate in (1.0 - np.cos(2.0 * np.pi * t), 2.0 * t):
        middle = np.average(t, weights=rate)
        even = np.sqrt(12.0 * np.average((t - middle) ** 2, weights=rate))
        earlier = (middle - 0.5 * even) / even
        assert 0.25 < earlier < 0.35
        assert earlier < 1.645 * _SHAPE


def test_an_end_that_no_recording_shows_is_open(study_of: Studies, truck: Packed) -> None:
    found = timing(study_of(), event(truck, "crosswind", 18.0, 5.0, 30.0))
    assert found.duration_s is not None
    assert not np.isfinite(found.duration_s[1])
    assert np.isfinite(found.onset_s).all()


def test_what_stays_has_an_onset_and_no_duration(study_of: Studies, truck: Packed) -> None:
    found = timing(study_of(), bank(truck, 0.02, 3.17))
    assert found.duration_s is None
    assert width(found.onset_s) < 1.75  # of which 1.65 for another form of onset


def test_the_sum_of_squares_rises_by_what_an_interval_says(
    study_of: Studies, truck: Packed
) -> None:
    """Onset and amount moved together along the valley: the parabola is the real one."""
    found = bank(truck, 0.02, 3.17)
    effect, place = found.hypothesis.effect, found.hypothesis.place
    assert effect.timed is not None
    study = study_of({**effect.values(truck, place, 0.02), **effect.timed(truck, place, 3.17, 9e9)})
    study = replace(study, settings=replace(study.settings, form_share=0.0, forms={}))
    low, high = timing(study, found).onset_s
    projector, run = study.projector([found.hypothesis]), study.runs[0]

    def least(start_s: float) -> float:
        """Sum of squares at this onset, the amount refitted."""
        trials = np.array([0.018, 0.02, 0.022])
        sums = [projector.chi2(study.residual({0: study.simulate([(run, bank(
            truck, a, start_s).hypothesis.apply(study.packed, "run 1"))])[0]})) for a in trials]
        a, b, c = np.polyfit(trials, sums, 2)
        return float(c - b * b / (4.0 * a))

    # the interval also holds where the descent stops, and what another form of the event does
    sigma = np.sqrt((0.5 * (high - low) / 1.645) ** 2 - 0.02**2 - effect.onset_form_s**2)
    away = 0.1
    rise = 0.5 * (least(3.17 - away) + least(3.17 + away)) - least(3.17)
    assert rise == pytest.approx((away / sigma) ** 2, rel=0.15)


def test_another_law_of_a_leak_moves_its_onset(study_of: Studies, truck: Packed) -> None:
    """The amount is 10 % uncertain for its form, and the onset moves with it."""
    study = study_of()
    plain = replace(study, settings=replace(study.settings, form_share=0.0, forms={}))
    found = event(truck, "payload_shift", 0.4, 2.5, 3.1)
    assert width(timing(study, found).onset_s) > width(timing(plain, found).onset_s)
