"""A hub that turns faster from an instant on shows where a tire lost its air."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.locate.sinking import sinking_hubs

HUB = "trailer_2_right"
ASKED = 12.0
Studies = Callable[..., Study]


def turned(study: Study, share: float, from_s: float, roles: Sequence[str] = ("train",)) -> Study:
    """The case with one hub faster from an instant on in runs of these roles."""
    runs = []
    for run in study.runs:
        measured = run.measured.copy()
        if run.role in roles:
            k = run.channels.index(f"hub_speed_{HUB}_radps")
            measured[run.edges_s[:-1] >= from_s, k] *= 1.0 + share
        runs.append(replace(run, measured=measured))
    return replace(study, runs=tuple(runs), _projectors={})


def hubs(study: Study) -> set[str]:
    return set(sinking_hubs(study, (), ASKED, study.packed.vehicle.hubs))


def test_a_hub_that_turns_faster_is_found_and_no_other(study_of: Studies) -> None:
    assert hubs(turned(study_of(baseline=True), 0.01, 2.6)) == {HUB}


def test_a_hub_that_turns_slower_has_not_sunk(study_of: Studies) -> None:
    assert hubs(turned(study_of(baseline=True), -0.01, 2.6)) == set()


def test_no_hub_of_a_sound_truck_sinks(study_of: Studies) -> None:
    assert hubs(study_of(baseline=True)) == set()


def test_a_gain_of_the_tachometer_is_no_sinking(study_of: Studies) -> None:
    study = study_of(baseline=True)
    assert hubs(turned(study, 0.002, -np.inf, ("train", "baseline"))) == set()
