"""What no list names is found where it acts, said in words, and kept in the diagnosed truck."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.answer.unlisted import (
    Unlisted,
    listed,
    mostly_unlisted,
    unlisted,
)
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects import LIBRARY
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.name import candidates
from truck_blowout_sim.diagnosis.name.search import search
from truck_blowout_sim.simulation import InitialState, Inputs, Truck
from truck_blowout_sim.vehicle import Packed

Studies = Callable[..., Study]
HUB = "trailer_2_left"
SPEED_MPS = 20.0


def hypothesis(truck: Packed, name: str, where: str, variant: bool = False) -> Hypothesis:
    effect = next(e for e in LIBRARY if e.name == name and e.variant == variant)
    place = next(p for p in effect.places(truck.vehicle) if str(p) == where)
    return Hypothesis(effect, place, effect.neutral(truck))


def moved(truck: Packed, h: Hypothesis | None = None, amount: float = 0.0,
          time_s: float = 4.0) -> dict[str, float]:
    """What a straight coast changes."""
    truck = truck if h is None else h.apply(truck, "", amount)
    run = Truck(truck, initial=InitialState(speed_mps=SPEED_MPS))
    run.advance(Inputs(), round(time_s / run.step_s))
    now = run.outputs()
    return {name: now[name] for name in ("tractor_vx_mps", "trailer_yaw_rad")}


def total_mass_kg(truck: Packed) -> float:
    vehicle = truck.vehicle
    return (sum(truck[f"unit.{name}.mass_kg"] for name in vehicle.units)
            + sum(truck[f"axle.{name}.mass_kg"] for name in vehicle.axles))


def test_a_corner_that_drags_slows_by_its_area_and_turns_to_its_side(truck: Packed) -> None:
    """F = rho / 2 A v^2: and the trailer turns to that side."""
    area_m2, time_s = 8.0, 4.0
    free = moved(truck, time_s=time_s)
    left, right = (moved(truck, hypothesis(truck, "corner_drag", "trailer", side), area_m2, time_s)
                   for side in (False, True))
    mean_mps = 0.5 * (SPEED_MPS + free["tractor_vx_mps"])
    lost = 0.5 * truck["world.air_density_kgpm3"] * area_m2 * mean_mps**2 * time_s
    lost_mps = free["tractor_vx_mps"] - left["tractor_vx_mps"]
    assert lost_mps * total_mass_kg(truck) == pytest.approx(lost, rel=0.1)
    assert left["trailer_yaw_rad"] > free["trailer_yaw_rad"] > right["trailer_yaw_rad"]


def test_the_wheels_that_are_held_back_are_found_and_have_no_promised_name(
    study_of: Studies, truck: Packed, monkeypatch: pytest.MonkeyPatch
) -> None:
    few = {"wheel_drag", "corner_drag", "aerodynamic_drag", "driveline_drag", "brake_imbalance"}
    monkeypatch.setattr(candidates, "LIBRARY", tuple(e for e in LIBRARY if e.name in few))
    share = 15.0 * truck[f"tire.{truck.vehicle.tires_of_hub(HUB)[0]}.rolling_0"]
    held = {f"tire.{tire}.rolling_0": share for tire in truck.vehicle.tires_of_hub(HUB)}
    found = search(study_of(held, baseline=True), most=1)
    (named,) = found.named
    assert named.hypothesis.key == ("wheel_drag", HUB)
    assert named.hypothesis.amount == pytest.approx(14.0 / 15.0 * share, rel=0.25)
    assert unlisted(found.named) == found.named
    assert listed(found.named) == []
    said = Unlisted.of(named)
    assert HUB in said.sentence
    assert HUB in said.equation
    assert said.next_test.startswith("To confirm: ")
    assert "cannot tell" not in said.sentence


def test_names_that_explain_it_as_well_are_told(truck: Packed) -> None:
    outside, inside = (Ranked(hypothesis(truck, name, where), 100.0, 1.0) for name, where in (
        ("corner_drag", "trailer"), ("aerodynamic_drag", "tractor")))
    said = Unlisted.of(outside, (outside, inside, inside)).sentence
    assert said.endswith("These recordings cannot tell it from aerodynamic_drag.")


def test_what_explains_most_decides_whether_a_name_is_told(truck: Packed) -> None:
    outside = Ranked(hypothesis(truck, "wheel_drag", HUB), 100.0, 1.0)
    inside = Ranked(hypothesis(truck, "brake_imbalance", HUB), 50.0, 1.0)
    weaker = replace(outside, delta=20.0)
    assert not mostly_unlisted([])
    assert not mostly_unlisted([inside, weaker])
    assert mostly_unlisted([inside, outside])
    assert mostly_unlisted([weaker])
    assert np.isclose(sum(r.delta for r in listed([inside, outside])), 50.0)


@pytest.mark.parametrize(("roll", "parameter"), [
    (False, "unit.trailer.probe_mz_vr_kgm"), (True, "unit.trailer.probe_mz_roll_nmprad")])
def test_a_yaw_moment_has_the_leverage_that_it_says(
    truck: Packed, roll: bool, parameter: str
) -> None:
    """A tenth of the weight at half of the length, at 1 g of speed times yaw rate, or rolled."""
    gravity = truck["world.gravity_mps2"]
    state = 0.05 if roll else gravity
    changed = hypothesis(truck, "yaw_moment", "trailer", roll).apply(truck, "", 0.1)
    half_m = 0.5 * (truck["unit.trailer.origin_x_m"] - truck["axle.trailer_2.x_m"])
    weight_n = truck["unit.trailer.mass_kg"] * gravity
    assert changed[parameter] * state == pytest.approx(0.1 * weight_n * half_m)
    assert truck[parameter] == 0.0
