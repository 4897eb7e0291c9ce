"""The next test: explanations that a run tells apart, and such as no run does."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.answer.words import next_test
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects import LIBRARY
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.name.judging import Found
from truck_blowout_sim.diagnosis.prove.manoeuvres import manoeuvres
from truck_blowout_sim.diagnosis.prove.next_test import Separation, best_test, pair_of
from truck_blowout_sim.diagnosis.sensors import GateResult
from truck_blowout_sim.vehicle import Packed

Studies = Callable[..., Study]


def explained(truck: Packed, name: str, amount: float, place: str = "", start_s: float = np.nan
              ) -> Ranked:
    effect = next(e for e in LIBRARY if e.name == name)
    where = next(p for p in effect.places(truck.vehicle) if place in ("", str(p)))
    times = {"run 1": (start_s, start_s + 2.0)} if np.isfinite(start_s) else {}
    return Ranked(Hypothesis(effect, where, amount, times), 500.0, 0.1, True, 500.0)


@pytest.fixture
def study(study_of: Studies) -> Study:
    return study_of()


def test_drag_and_grade_are_told_apart_by_a_forward_channel(study: Study, truck: Packed) -> None:
    rivals = (explained(truck, "aerodynamic_drag", 3.0), explained(truck, "road_grade", 0.006))
    found = best_test(study, rivals, [rivals[0].hypothesis])
    assert found is not None
    assert found.sigma > 3.0
    assert "separates them best" in str(found)
    assert f"{found.sigma:.0f} sigma" in str(found)
    assert best_test(study, rivals, [rivals[0].hypothesis]) == found


def test_a_stronger_difference_separates_more(study: Study, truck: Packed) -> None:
    sigmas = []
    for gain in (-0.2, -0.6):
        rivals = (explained(truck, "brake_imbalance", gain, "trailer_2_left"),
                  explained(truck, "brake_imbalance", -gain, "trailer_2_right"))
        found = best_test(study, rivals, [rivals[0].hypothesis])
        assert found is not None
        sigmas.append(found.sigma)
    assert sigmas[0] < sigmas[1]


def test_the_same_thing_twice_is_told_apart_by_nothing(study: Study, truck: Packed) -> None:
    one = explained(truck, "aerodynamic_drag", 3.0)
    found = best_test(study, (one, one), [one.hypothesis])
    assert found is not None
    assert found.sigma < 0.1
    assert str(found).startswith("None of ")


def test_what_cannot_be_commanded_is_not_tried(truck: Packed) -> None:
    gust, drag = (explained(truck, "crosswind", 12.0, "trailer", 2.0),
                  explained(truck, "aerodynamic_drag", 3.0))
    shift = explained(truck, "payload_shift", -0.4, start_s=3.0)
    again = replace(drag, hypothesis=drag.hypothesis.at(2.0))
    assert pair_of((drag,)) is None
    assert pair_of((gust, gust)) is None
    assert pair_of((shift, drag)) is None
    assert pair_of((gust, drag)) == (gust.hypothesis, drag.hypothesis)
    assert pair_of((drag, again, gust)) == (drag.hypothesis, gust.hypothesis)


def test_manoeuvres_are_on_the_channels_and_bins_of_the_recordings(study: Study) -> None:
    runs = list(manoeuvres(study))
    like = study.runs[0]
    assert len({run.recording.name for run in runs}) == len(runs) >= 5
    for run in runs:
        assert run.channels == like.channels
        assert run.measured.shape == (run.edges_s.size - 1, len(like.channels))
        assert np.diff(run.edges_s) == pytest.approx(study.settings.bin_s)
        assert (run.sigma > 0.0).all()
        assert run.edges_s[-1] <= 15.0 + 1e-9


def test_words_name_the_pair_and_its_places_where_names_are_the_same(truck: Packed) -> None:
    left, right = (explained(truck, "brake_imbalance", -0.3, f"trailer_2_{side}")
                   for side in ("left", "right"))
    found = Found(rivals=[(left, right)])
    gate = cast(GateResult, SimpleNamespace(findings=()))
    plain = next_test(found, gate)
    assert plain.startswith("To tell brake_imbalance at trailer_2_left from brake_imbalance at ")
    best = Separation((left.hypothesis, right.hypothesis), "brake_stop", "speed", 11.6, 7)
    assert next_test(found, gate, best) == (
        f"{plain} Of 7 simulated maneuvers brake_stop separates them best: "
        "speed would differ by 12 sigma.")
