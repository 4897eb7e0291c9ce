"""A car and a rigid truck are diagnosed with the default settings, as the combination is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest

from truck_blowout_sim.diagnosis import USUAL, Diagnosis, diagnose
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.vehicle import load_vehicle, pack

Drives = Callable[..., Recording]
# hand wheel [rad] and brake pressure [Pa] of a gentle lane change that ends in braking
GENTLE = {"bmw_320i": (0.25, 0.8e6), "rigid_truck": (0.9, 1.5e5)}


def told(drive_of: Drives, vehicle: str, weak: str | None, slip_stiffness: float = 1.0
         ) -> Diagnosis:
    """The answer for a vehicle, the brake of one hub weak in training and on the unseen run.

    ``slip_stiffness``: of all its tires in all runs, times that of its sheet.
    """
    truck = pack(load_vehicle(vehicle))
    wheel, brake_pa = GENTLE[vehicle]
    own = tuple((f"tire.{tire}.{name}", slip_stiffness * truck[f"tire.{tire}.{name}"])
                for tire in truck.vehicle.tires
                for name in ("slip_stiffness", "slip_stiffness_load"))
    changes = own if weak is None else (
        *own, (f"hub.{weak}.brake_gain", 0.3 * truck[f"hub.{weak}.brake_gain"]))
    return diagnose([drive_of(truck, changes, 1, wheel, "train", brake_pa)],
                    baseline=[drive_of(truck, own, 2, -wheel, "baseline", 0.8 * brake_pa)],
                    holdout=[drive_of(truck, changes, 3, -0.8 * wheel, "holdout",
                                      0.9 * brake_pa)],
                    vehicle=vehicle, effort=replace(USUAL, next_run=False))[0]


@pytest.mark.parametrize("vehicle", sorted(GENTLE))
def test_nothing_is_named_of_a_vehicle_that_is_as_modelled(
    drive_of: Drives, vehicle: str
) -> None:
    answer = told(drive_of, vehicle, None)
    assert answer.verdict in ("consistent", "miscalibrated")
    assert answer.effects == ()


@pytest.mark.parametrize(("vehicle", "hub"), [("bmw_320i", "rear_left"),
                                              ("rigid_truck", "drive_1_right")])
def test_a_weak_brake_is_named_at_its_wheel(drive_of: Drives, vehicle: str, hub: str) -> None:
    answer = told(drive_of, vehicle, hub)
    assert answer.verdict == "missing_physics"
    effect, = answer.effects
    assert (effect.name, effect.where.hub) == ("brake_imbalance", hub)


@pytest.mark.parametrize("vehicle", sorted(GENTLE))
def test_soft_tires_are_numbers_of_the_sheet_and_nothing_is_named(
    drive_of: Drives, vehicle: str
) -> None:
    answer = told(drive_of, vehicle, None, slip_stiffness=0.3)
    assert answer.effects == ()
    pulled = {one["name"] for one in answer.as_json()["pulled"]}
    assert pulled == {"steered_slip_stiffness", "driven_slip_stiffness"}
