"""Whether the anti-lock control of the sheet is at work, on braked drives over ice."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim.diagnosis import USUAL, diagnose
from truck_blowout_sim.diagnosis.calibrate import calibrate, write_calibrated_vehicle
from truck_blowout_sim.diagnosis.case.antilock import MODE, as_braked, lockups, sensed_axles
from truck_blowout_sim.diagnosis.settings import Settings
from truck_blowout_sim.recordings import Blowout, Recording, Series
from truck_blowout_sim.vehicle import Packed, pack, write_vehicle

Drives = Callable[..., Recording]
ICE, NO_CONTROL = ("world.friction_scale", 0.15), (MODE, 0.0)
HARD_PA, BRAKED_FROM_S = 4e5, 4.8  # in every drive of these tests


@pytest.fixture(scope="module")
def locked(truck: Packed, drive_of: Drives) -> Recording:
    """A truck without anti-lock control brakes hard on ice."""
    return drive_of(truck, (NO_CONTROL, ICE), 1, 0.0, "ice", HARD_PA)


def changed(recording: Recording, name: str, value: Callable[[np.ndarray], np.ndarray]
            ) -> Recording:
    series = recording[name]
    return replace(recording, channels={**recording.channels,
                                        name: Series(series.time_s, value(series.value))})


def test_wheels_that_stand_show_that_no_control_works(truck: Packed, locked: Recording) -> None:
    without, seen = as_braked(truck, [locked])
    assert truck[MODE] != 0.0
    assert without[MODE] == 0.0
    assert seen is not None
    assert seen.start_s > BRAKED_FROM_S
    assert seen.end_s - seen.start_s > 1.0
    assert f"does not work: in ice, wheel {seen.hub} stood" in seen.sentence


def test_control_that_works_is_left_alone(truck: Packed, drive_of: Drives) -> None:
    icy = drive_of(truck, (ICE,), 1, 0.0, "ice", HARD_PA)
    assert as_braked(truck, [icy]) == (truck, None)


def test_wheels_that_turn_on_dry_asphalt_tell_nothing(truck: Packed, drive_of: Drives) -> None:
    dry = drive_of(truck, (NO_CONTROL,), 1, 0.0, "dry", 1.5e5)
    assert as_braked(truck, [dry]) == (truck, None)


def test_a_truck_without_control_has_none_to_lose(truck: Packed, locked: Recording) -> None:
    plain = truck.with_values(dict([NO_CONTROL]))
    assert as_braked(plain, [locked]) == (plain, None)


def test_only_wheels_with_sensors_tell(truck: Packed, locked: Recording) -> None:
    axles = sensed_axles(truck.vehicle, each=False)
    assert axles == ["steer", "drive_1", "trailer_2"]
    assert sensed_axles(truck.vehicle, each=True) == list(truck.vehicle.axles)
    assert {truck.vehicle.axle_of_hub(one.hub) for one in lockups(truck, locked)} <= set(axles)


def test_a_dead_sensor_is_no_wheel_that_stands(truck: Packed, locked: Recording) -> None:
    dead = locked
    for hub in truck.vehicle.hubs:
        dead = changed(dead, f"hub_speed_{hub}_radps", np.zeros_like)
    assert not list(lockups(truck, dead))


def test_a_wheel_that_stands_unbraked_is_no_lockup(truck: Packed, locked: Recording) -> None:
    free = locked
    for circuit in ("steer", "drive", "trailer"):
        free = changed(free, f"brake_pressure_{circuit}_pa", np.zeros_like)
    assert not list(lockups(truck, free))


def test_a_lost_tire_may_hold_its_wheel(truck: Packed, locked: Recording) -> None:
    lost = tuple(truck.vehicle.tires_of_hub(hub)[0] for hub in truck.vehicle.hubs)
    assert not list(lockups(truck, replace(locked, blowouts=(Blowout(1.0, lost),))))


def test_without_hub_speeds_the_sheet_is_believed(truck: Packed, locked: Recording) -> None:
    few = replace(locked, channels={name: series for name, series in locked.channels.items()
                                    if not name.startswith("hub_speed")})
    assert as_braked(truck, [few]) == (truck, None)


def test_nothing_else_is_wrong_with_a_truck_that_slides_as_its_model_does(
    truck: Packed, locked: Recording, drive_of: Drives, tmp_path: Path
) -> None:
    on_ice = write_vehicle(tmp_path / "on_ice.yaml", truck.vehicle, dict([ICE]))
    gentle = drive_of(pack(on_ice), (NO_CONTROL,), 2, 0.0, "gentle", 3e4)
    answer, values = diagnose([locked], baseline=[gentle], vehicle=on_ice, workers=1,
                              effort=replace(USUAL, next_run=False))
    assert answer.verdict == "miscalibrated"
    assert not answer.effects
    assert "The anti-lock control does not work" in answer.sentence
    assert values[MODE] == 0.0
    assert "stood for" in dict(answer.evidence.sources)[MODE]


def test_a_calibrated_truck_goes_without_it_too(truck: Packed, locked: Recording, few: Settings,
                                                tmp_path: Path) -> None:
    found = calibrate([locked], vehicle=truck.vehicle, settings=few, workers=1)
    assert found.lockup is not None
    assert found.notes[0] == found.lockup.sentence
    written = pack(write_calibrated_vehicle(tmp_path / "mine.yaml", truck.vehicle, found))
    assert written[MODE] == 0.0
