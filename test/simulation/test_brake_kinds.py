"""Air or hydraulic brakes: what control pressures a vehicle takes, and which of them it misses."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim.cli.reading import check_brakes
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import INPUT_NAMES, Recording, Series
from truck_blowout_sim.simulation.plausible import implausible
from truck_blowout_sim.simulation.replay import drive_from
from truck_blowout_sim.vehicle import Vehicle, load_vehicle, pack

TRUCK, CAR = "international_9400i_trailmobile", "bmw_320i"
TIME_S = 0.01 * np.arange(100)
SINGLE_TRACK = """\
single_track:
  kind: {kind}
  mass_kg: 1500
  wheelbase_m: 2.7
  cg_x_m: 1.25
  steering_ratio: 16
  tire: {tire}
"""


def braked(pressure_pa: float, *without: str) -> Recording:
    """A second at 20 m/s in which all brakes have a pressure."""
    values = {name: pressure_pa if name.startswith("brake") else 0.0 for name in INPUT_NAMES}
    values["tractor_vx_mps"] = 20.0
    channels = {name: Series(TIME_S, value + 0.0 * TIME_S) for name, value in values.items()}
    return Recording("braked", {n: s for n, s in channels.items() if n not in without})


@pytest.mark.parametrize(("name", "pressure_pa", "asked"), [
    (TRUCK, 0.8e6, False), (TRUCK, 6.0e6, True), (CAR, 6.0e6, False), (CAR, 3.0e7, True),
])  # fmt: skip
def test_a_pressure_is_asked_about_by_the_kind_of_brakes(
    name: str, pressure_pa: float, asked: bool
) -> None:
    vehicle, recording = load_vehicle(name), braked(pressure_pa)
    found = implausible(pack(vehicle), drive_from(recording, vehicle))
    assert any("control pressure" in clause for clause in found) == asked
    if asked:
        with pytest.raises(InputError, match=f"with {vehicle.spec.brakes} brakes"):
            check_brakes(vehicle, recording)
    else:
        check_brakes(vehicle, recording)


@pytest.mark.parametrize(("kind", "tire", "brakes"), [("car", "205/55R16", "hydraulic"),
                                                      ("truck", "11R22.5", "air")])  # fmt: skip
def test_a_single_track_vehicle_has_the_brakes_of_its_kind(
    tmp_path: Path, kind: str, tire: str, brakes: str
) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text(SINGLE_TRACK.format(kind=kind, tire=tire))
    assert load_vehicle(path).spec.brakes == brakes


@pytest.mark.parametrize(("name", "missing", "imposed"), [
    (CAR, "brake_pressure_trailer_pa", False), (CAR, "brake_pressure_drive_pa", True),
    (TRUCK, "brake_pressure_trailer_pa", True), (TRUCK, "throttle", True),
])  # fmt: skip
def test_a_circuit_without_a_brake_is_not_missed(name: str, missing: str, imposed: bool) -> None:
    vehicle: Vehicle = load_vehicle(name)
    drive = drive_from(braked(0.0, missing), vehicle)
    assert bool(drive.speed.size) == imposed


def test_a_run_without_a_heading_begins_along_its_path() -> None:
    along = braked(0.0)
    moved = {"tractor_x_m": Series(TIME_S, -12.0 * TIME_S),
             "tractor_y_m": Series(TIME_S, 16.0 * TIME_S)}  # fmt: skip
    drive = drive_from(along.with_channels(moved), load_vehicle(TRUCK))
    assert drive.initial.yaw_rad == pytest.approx(np.arctan2(16.0, -12.0))
    standing = drive_from(along, load_vehicle(TRUCK)).initial
    assert standing.yaw_rad == 0.0
