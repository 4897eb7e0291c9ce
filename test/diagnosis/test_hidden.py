"""How long an event may have been there before it shows: leaks and losses of grip."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.answer.words import unseen_before
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.case.trust import asked_for_mps2, grip_mps2
from truck_blowout_sim.diagnosis.effects import friction_change, secondary_blowout
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.prove.hidden import (
    earliest_s,
    emptying,
    leak_shift_s,
    rim_pressure_pa,
)
from truck_blowout_sim.diagnosis.prove.intervals import time_intervals
from truck_blowout_sim.diagnosis.result.parts import Place
from truck_blowout_sim.physics.tires.gas import CHOKED, CRITICAL_RATIO, GAS_CONSTANT_JPKGK
from truck_blowout_sim.vehicle import Packed

Studies = Callable[..., Study]
TIRE = "steer_right"


def leak(truck: Packed, hole: float, start_s: float = 3.0, tire: str = TIRE) -> Hypothesis:
    place = next(p for p in secondary_blowout.EFFECT.places(truck.vehicle) if p.tire == tire)
    return Hypothesis(secondary_blowout.EFFECT, place, hole, {"run 1": (start_s, np.inf)})


def slippery(lost: float, start_s: float) -> Ranked:
    effect = friction_change.EFFECT
    return Ranked(Hypothesis(effect, Place(), -lost, {"run 1": (start_s, np.inf)}), 500.0, 0.02)


def test_a_tire_empties_exponentially_while_the_hole_is_choked(truck: Packed) -> None:
    """Closed form of an isothermal leak: p falls by 1/e in V / (CdA sqrt(R T) CHOKED)."""
    truck = truck.unchecked({f"tire.{TIRE}.polytropic": 1.0})
    gauge, times = emptying(truck, TIRE, 0.5)
    pressure = gauge + truck["world.air_pressure_pa"]
    speed = np.sqrt(GAS_CONSTANT_JPKGK * truck["world.air_temperature_k"])
    hole = 0.5 * truck[f"tire.{TIRE}.hole_area_m2"] * truck[f"tire.{TIRE}.hole_scale"]
    fall_s = truck[f"tire.{TIRE}.volume_m3"] / (hole * speed * CHOKED)
    choked = pressure > truck["world.air_pressure_pa"] / CRITICAL_RATIO
    assert times[choked] == pytest.approx(fall_s * np.log(pressure[0] / pressure[choked]), rel=1e-3)


@pytest.mark.parametrize("hole", [1.0, 0.2])
def test_both_forms_of_a_leak_change_the_forces_for_the_same_time(
    study_of: Studies, truck: Packed, hole: float
) -> None:
    """From the first moment on, or from the rim on: two sigmas apart, a hole of its own each."""
    later, sigma = leak_shift_s(study_of().runs[0], leak(truck, hole), truck)
    gauge, times = emptying(truck, TIRE, hole)
    valid = truck[f"tire.{TIRE}.pressure_valid"] * truck[f"tire.{TIRE}.reference_pressure_pa"]
    shows = np.interp(-valid, -gauge, times)
    assert later + sigma == pytest.approx(shows)  # at once
    rim = rim_pressure_pa(truck, TIRE)
    slower = hole * (times[-1] - np.interp(-rim, -gauge, times)) / (times[-1] - shows)
    gauge, times = emptying(truck, TIRE, slower)
    assert later - sigma == pytest.approx(shows - np.interp(-rim, -gauge, times))
    assert -2.0 * sigma < later < 0.0


def test_a_carcass_that_carries_the_load_without_air_hides_a_leak_while_it_empties(
    study_of: Studies, truck: Packed
) -> None:
    stiff = truck.unchecked({f"tire.{TIRE}.rim_contact_radius_m": 0.01})
    assert rim_pressure_pa(stiff, TIRE) < 0.01 * truck[f"tire.{TIRE}.pressure_pa"]
    later, sigma = leak_shift_s(study_of().runs[0], leak(truck, 0.2), stiff)
    assert 2.0 * sigma == pytest.approx(emptying(truck, TIRE, 0.2)[1][-1])
    assert np.isfinite(later)


def test_a_leak_that_a_gauge_reads_hides_nothing(study_of: Studies, truck: Packed) -> None:
    run = study_of().runs[0]
    assert f"tire_pressure_{TIRE}_pa" not in run.recording
    assert leak_shift_s(run, leak(truck, 0.2), truck)[1] > 0.5
    read = run.recording["tractor_vx_mps"]
    watched = run.recording.with_channels({f"tire_pressure_{TIRE}_pa": read})
    assert leak_shift_s(replace(run, recording=watched), leak(truck, 0.2), truck) == (0.0, 0.0)


def test_less_grip_may_have_begun_when_the_truck_last_used_more(
    study_of: Studies, truck: Packed
) -> None:
    """The shared drive turns from 1 s on and brakes from 4.8 s on."""
    study = study_of()
    study = replace(study, settings=replace(study.settings, form_share=0.0, forms={}))
    run, grip = study.runs[0], grip_mps2(truck)
    asked = asked_for_mps2(study, run)
    turn = float(np.max(asked[run.edges_s[1:] < 4.0]))
    assert 0.3 < turn < 0.6 * grip
    mild, icy = 1.0 - 1.2 * turn / grip, 0.95
    assert earliest_s(study, run, slippery(mild, 3.9), 3.5) == run.drive.initial.time_s
    since = earliest_s(study, run, slippery(icy, 3.9), 3.5)
    assert 1.0 < since <= 3.5
    used = asked[run.edges_s[1:] <= since]
    assert used[-1] > (1.0 - icy) * grip
    beyond = asked[(run.edges_s[1:] > since) & (run.edges_s[1:] <= 3.5)]
    assert (beyond <= (1.0 - icy + 0.05) * grip).all()


def test_an_interval_of_less_grip_reaches_back_to_there(study_of: Studies, truck: Packed) -> None:
    study = study_of()
    found = slippery(0.9, 5.5)
    low, high = time_intervals(study, found)["run 1"].onset_s
    since = earliest_s(study, study.runs[0], found, 5.0)
    assert since < 4.5
    assert low == since
    assert high - 5.5 < 1.7



def test_what_hid_before_the_run_hid_from_its_beginning(study_of: Studies, truck: Packed) -> None:
    study = study_of()
    run = study.runs[0]
    leaking = Ranked(leak(truck, 0.2), 500.0, 0.02)
    assert earliest_s(study, run, leaking, -1.0) == run.drive.initial.time_s
    assert earliest_s(study, run, leaking, -np.inf) == -np.inf
    assert earliest_s(study, run, leaking, 2.0) == 2.0


def test_an_event_that_may_have_begun_long_before_is_told_so() -> None:
    assert unseen_before(3.9, (1.05, 4.2)) == (
        " It may have begun as early as 1.05 s, because it need not show at once.")
    for known in ((3.6, 4.2), (-np.inf, np.inf), None):
        assert unseen_before(3.9, known) == ""
