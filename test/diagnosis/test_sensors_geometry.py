from __future__ import annotations

import pytest
from trial_drive import METADATA, make_run

from truck_blowout_sim import load_vehicle
from truck_blowout_sim.diagnosis.sensors import (
    Geometry,
    sensor_gate,
    stated_geometry,
    vehicle_geometry,
)
from truck_blowout_sim.recordings import Recording


def described(**metadata: str) -> Recording:
    return Recording("r", {}, (), metadata)


def test_positions_are_read_from_metadata() -> None:
    geometry = stated_geometry([described(**METADATA)])
    assert geometry.tractor_behind_steer_m == 2.42
    assert geometry.trailer_behind_kingpin_m == 5.6132
    assert (geometry.tractor_height_m, geometry.trailer_height_m) == (0.90, 1.20)
    assert geometry.tractor_to_hitch_m == pytest.approx((-3.08, 0.0, 0.30))
    assert geometry.trailer_to_hitch_m == pytest.approx((5.6132, 0.0, 0.0))


def test_the_first_recording_that_says_so_decides() -> None:
    second = described(tractor_base_link="9.9 m behind the steer axle")
    assert stated_geometry([described(), described(**METADATA), second]).tractor_behind_steer_m == (
        2.42
    )


def test_what_is_not_stated_is_not_assumed() -> None:
    geometry = stated_geometry([described()])
    assert not geometry.knows_hitch
    with pytest.raises(ValueError, match="not stated"):
        _ = geometry.tractor_to_hitch_m
    run = make_run(1, 8.0)
    silent = Recording(run.name, run.channels)
    result = sensor_gate([silent])
    assert not any("hitch" in residual.identity for residual in result.identities)
    assert any("hitch identities not asked" in note for note in result.notes)


def test_hubs_sit_half_a_track_from_the_middle() -> None:
    geometry = Geometry(track_m={"steer": 2.05})
    assert geometry.hub_left_m("steer_left") == pytest.approx(1.025)
    assert geometry.hub_left_m("steer_right") == pytest.approx(-1.025)
    assert geometry.hub_left_m("other_axle_right") < 0.0


def test_lengths_come_from_the_vehicle_file() -> None:
    geometry = vehicle_geometry(load_vehicle("international_9400i_trailmobile"))
    assert geometry.tractor_to_hitch_m == pytest.approx((-3.08, 0.0, 0.30))
    assert geometry.trailer_to_hitch_m[0] == pytest.approx(5.613)
    assert geometry.hub_left_m("steer_left") > 0.9
    assert stated_geometry([described(**METADATA)], geometry).trailer_behind_kingpin_m == 5.6132


@pytest.mark.parametrize(("vehicle", "driven", "rolling"), [
    ("international_9400i_trailmobile", "drive_2_left", "steer_left"),
    ("bmw_320i", "rear_left", "front_right")])
def test_driven_hubs_are_those_of_the_vehicle_file(vehicle: str, driven: str, rolling: str) -> None:
    geometry = vehicle_geometry(load_vehicle(vehicle))
    assert geometry.drives(driven)
    assert not geometry.drives(rolling)


def test_a_car_has_no_hitch() -> None:
    geometry = vehicle_geometry(load_vehicle("ferrari_250lm"))
    assert not geometry.knows_hitch
    assert geometry.tractor_behind_steer_m == pytest.approx(1.33)
