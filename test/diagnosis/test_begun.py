"""What a freely chosen instant costs, and instants of several runs found together."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects import LIBRARY
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.begun import begun_everywhere, choices, log_choices
from truck_blowout_sim.diagnosis.fit.instants import grid_of
from truck_blowout_sim.diagnosis.fit.timed import at_best_instants
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.vehicle import Packed

Studies = Callable[..., Study]
Drives = Callable[..., Recording]
GRIP = next(e for e in LIBRARY if e.name == "friction_change")


def icy(truck: Packed, start_s: float, lost: float = -0.85) -> dict[str, float]:
    """Grip lost from an instant on, in one run or in all."""
    assert GRIP.timed is not None
    place, = GRIP.places(truck.vehicle)
    return {**GRIP.values(truck, place, lost), **GRIP.timed(truck, place, start_s, np.inf)}


def test_choices_between_one_instant_and_all_alike() -> None:
    sharp = np.array([900.0, 500.0, 10.0, 600.0])
    assert choices(sharp, 8.0, 2, 1.0) == pytest.approx(np.log(4.0))
    assert choices(np.full(4, 8.0), 8.0, 1, 1.0) == pytest.approx(0.0)
    # two that do as well are half as many choices; so are any where widths are far too small
    assert choices(np.array([8.0, 900.0, 10.0, 600.0]), 8.0, 2, 1.0) == pytest.approx(np.log(2.0))
    assert choices(sharp, 8.0, 2, 1e-9) == pytest.approx(0.0, abs=1e-5)
    # a mean over instants is never more than the best of them
    assert choices(np.array([1.0, 900.0, 10.0]), 8.0, 2, 1.0) == pytest.approx(
        np.log(3.0) - np.log1p(np.exp(-3.5)))


def test_instants_of_hundreds_of_runs_are_paid_for(study_of: Studies, truck: Packed) -> None:
    """So many combinations that no float holds their number."""
    study = study_of()
    run, effect = study.runs[0], next(e for e in LIBRARY if e.name == "crosswind")
    gust = Hypothesis(effect, effect.places(truck.vehicle)[0], 5.0, {
        f"run {k}": (1.0, 2.0) for k in range(400)})
    one, many = (log_choices(SimpleNamespace(train=range(count), runs=[  # type: ignore[arg-type]
        replace(run, recording=replace(run.recording, name=f"run {k}")) for k in range(count)]),
        gust) for count in (1, 400))
    assert one == pytest.approx(effect.edges * np.log(grid_of(run, effect).size))
    assert many == pytest.approx(400.0 * one)


def test_grip_lost_before_it_is_asked_for_was_hardly_chosen(
    case_of: Studies, drive_it: Drives, truck: Packed
) -> None:
    """Straight ahead, brakes from 4.8 s on: until then one instant is as good as any."""
    place, = GRIP.places(truck.vehicle)
    found = {}
    for start_s in (2.4, 5.4):
        study = case_of(drive_it(icy(truck, start_s), steer=0.0))
        found[start_s] = log_choices(study, Hypothesis(GRIP, place, -0.85, {
            "run 1": (start_s, np.inf)}))
    instants = grid_of(study.runs[0], GRIP)
    before = np.sum(instants < 4.8)
    assert found[2.4] == pytest.approx(np.log(instants.size / before), abs=0.3)
    assert found[5.4] > found[2.4] + 0.5


def test_instants_of_runs_are_found_together(case_of: Studies, drive_it: Drives, truck: Packed
                                             ) -> None:
    """What is missing in one run moves the sheet, and hides what begins in the other."""
    study = case_of(drive_it(icy(truck, 2.4), seed=1), drive_it(icy(truck, 3.4), seed=2))
    place, = GRIP.places(truck.vehicle)
    event = Hypothesis(GRIP, place, -0.85)
    together, = at_best_instants(study, [event])
    starts = [together.times[f"run {k}"][0] for k in (1, 2)]
    assert starts == pytest.approx([2.4, 3.4], abs=0.6)


def test_an_event_that_a_run_contradicts_never_begins_in_it(case_of: Studies, drive_it: Drives,
                                                            truck: Packed) -> None:
    study = case_of(drive_it(icy(truck, 2.4), seed=1), drive_it({}, seed=2))
    place, = GRIP.places(truck.vehicle)
    together, = at_best_instants(study, [Hypothesis(GRIP, place, -0.85)])
    assert set(together.times) == {"run 1"}
    begun, = begun_everywhere(study, [together])
    assert {i for i, _ in begun} == set(study.train)
