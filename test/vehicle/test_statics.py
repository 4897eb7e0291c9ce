"""Loads at rest."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from truck_blowout_sim.vehicle import Packed, Vehicle, load_vehicle
from truck_blowout_sim.vehicle.masses import unit_mass
from truck_blowout_sim.vehicle.statics import static_loads

G_MPS2 = 9.81
POUND_N = 0.45359237 * G_MPS2


@pytest.mark.parametrize(
    ("name", "expected_lb", "kingpin_kg"),
    [
        ("international_9400i_trailmobile", (11_925, 20_004, 20_070), 6284),
        ("international_9400i_trailmobile_thesis", (11_961, 23_633, 22_451), None),
    ],
)
def test_axle_loads_are_those_of_the_scales(
    name: str, expected_lb: tuple[int, int, int], kingpin_kg: float | None
) -> None:
    loads = static_loads(load_vehicle(name), G_MPS2)
    road = loads.road_n
    groups = (
        road["steer"],
        road["drive_1"] + road["drive_2"],
        road["trailer_1"] + road["trailer_2"],
    )
    assert [load / POUND_N for load in groups] == pytest.approx(expected_lb, rel=1e-3)
    if kingpin_kg:
        assert loads.hitch_n / G_MPS2 == pytest.approx(kingpin_kg, abs=1.0)


def test_a_tandem_shares_its_spring_load_equally(default_vehicle: Vehicle) -> None:
    spring = static_loads(default_vehicle, G_MPS2).spring_n
    assert spring["drive_1"] == spring["drive_2"]
    assert spring["trailer_1"] == spring["trailer_2"]


@pytest.mark.parametrize(
    "name", ["international_9400i_trailmobile", "rigid_truck", "ferrari_250lm"]
)
def test_loads_add_up_to_the_weight_and_its_moment(name: str) -> None:
    vehicle = load_vehicle(name)
    loads = static_loads(vehicle, G_MPS2)
    axles = vehicle.spec.axles
    bodies = {unit: unit_mass(spec) for unit, spec in vehicle.unit_specs.items()}
    mass = sum(body.mass_kg for body in bodies.values())
    mass += sum(axle.mass_kg for axle in axles.values())
    assert sum(loads.road_n.values()) == pytest.approx(mass * G_MPS2)
    front = bodies["tractor"]
    moment = front.mass_kg * G_MPS2 * front.x_m
    hitch = vehicle.unit_specs["tractor"].hitch
    moment += loads.hitch_n * (hitch.x_m if hitch else 0.0)
    carried = sum(loads.spring_n[n] * a.x_m for n, a in axles.items() if a.unit == "tractor")
    assert carried == pytest.approx(moment)


def test_the_packed_vehicle_is_preloaded_with_them(
    default_vehicle: Vehicle, packed: Packed
) -> None:
    loads = static_loads(default_vehicle, G_MPS2)
    for axle, load in loads.spring_n.items():
        assert packed[f"axle.{axle}.preload_n"] == pytest.approx(load / 2)
    assert packed["fifth_wheel.preload_z_n"] == pytest.approx(loads.hitch_n)


def test_wheel_centers_sink_by_what_the_tires_give(packed: Packed) -> None:
    load_n = 11_925 * POUND_N / 2
    stiffness = 83.7e3 + 8.04e3 * 110
    assert packed["axle.steer.center_height_m"] == pytest.approx(
        0.506 - load_n / stiffness, abs=1e-5
    )


@settings(deadline=None)
@given(x_m=st.floats(3.6, 12.5), mass_kg=st.floats(100.0, 20_000.0))
def test_moving_payload_rearward_unloads_the_kingpin(x_m: float, mass_kg: float) -> None:
    vehicle = load_vehicle("international_9400i_trailmobile")
    trailer = vehicle.unit_specs["trailer"]

    def kingpin(x: float) -> float:
        block = dataclasses.replace(trailer.payload["rear_blocks"], x_m=x, mass_kg=mass_kg)
        changed = dataclasses.replace(trailer, payload={"rear_blocks": block})
        units = dataclasses.replace(vehicle.spec.units, trailer=changed)
        spec = dataclasses.replace(vehicle.spec, units=units)
        return static_loads(dataclasses.replace(vehicle, spec=spec), G_MPS2).hitch_n

    lever = 11.2265
    slope = -mass_kg * G_MPS2 / lever
    assert kingpin(x_m + 1.0) - kingpin(x_m) == pytest.approx(slope, rel=1e-6)


def test_loads_follow_a_changed_file(
    extending: Callable[[str], Path], default_vehicle: Vehicle
) -> None:
    heavier = load_vehicle(extending("units: {trailer: {payload: {front_block: {mass_kg: 4978}}}}"))
    more = static_loads(heavier, G_MPS2).hitch_n - static_loads(default_vehicle, G_MPS2).hitch_n
    assert more == pytest.approx(1000 * G_MPS2 * (1 - 0.2 / 11.2265), rel=1e-6)
