"""The whole comparison, on recordings whose difference from the model is known."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim.comparison import compare, encode_comparison, verdict, write_comparison
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Blowout, Recording, Series
from truck_blowout_sim.simulation.replay import simulate_inputs
from truck_blowout_sim.vehicle import Vehicle, load_vehicle

INPUTS = ("steering_wheel_angle_rad", "throttle", "brake_pressure_steer_pa",
          "brake_pressure_drive_pa", "brake_pressure_trailer_pa")  # fmt: skip
TIME = np.arange(0.0, 4.0, 0.01)


@pytest.fixture(scope="module")
def vehicle() -> Vehicle:
    return load_vehicle("international_9400i_trailmobile")


@pytest.fixture(scope="module")
def simulated(vehicle: Vehicle) -> Recording:
    """A run of the model itself: wheel turned a little, steer tire blown at 2 s."""
    values = dict.fromkeys(INPUTS, np.zeros(TIME.size))
    values["steering_wheel_angle_rad"] = 0.2 * np.sin(TIME)
    values["throttle"] = np.full(TIME.size, 0.3)
    channels = {name: Series(TIME, value) for name, value in values.items()}
    channels["tractor_vx_mps"] = Series(TIME, np.full(TIME.size, 22.0))
    inputs = Recording("made", channels, (Blowout(2.0, ("steer_left",)),))
    return simulate_inputs(vehicle, inputs)


def without(recording: Recording, *names: str) -> Recording:
    kept = {name: s for name, s in recording.channels.items() if name not in names}
    return replace(recording, channels=kept)


def offset(recording: Recording, name: str, by: float) -> Recording:
    series = recording[name]
    changed = {**recording.channels, name: Series(series.time_s, series.value + by)}
    return replace(recording, channels=changed)


def test_the_model_agrees_with_itself(vehicle: Vehicle, simulated: Recording) -> None:
    compared = compare(simulated, vehicle)
    # the initial state is estimated from noise-free channels, to a line through one second
    assert compared["tractor_vx_mps"].rms < 0.01
    assert compared["tractor_yaw_rate_radps"].rms < np.radians(0.1)
    assert compared["tire_pressure_steer_left_pa"].rms < 0.005 * 758e3
    assert not compared.speed_imposed
    assert compared.mean_rating is not None
    assert compared.mean_rating > 0.8


def test_a_known_offset_is_reported_as_such(vehicle: Vehicle, simulated: Recording) -> None:
    name = "trailer_roll_rad"
    plain = compare(simulated, vehicle)[name]
    moved = compare(offset(simulated, name, 0.01), vehicle)[name]
    assert moved.mean - plain.mean == pytest.approx(-0.01, abs=1e-9)
    assert moved.final - plain.final == pytest.approx(-0.01, abs=1e-9)


def test_speed_is_imposed_where_the_throttle_is_missing(
    vehicle: Vehicle, simulated: Recording
) -> None:
    compared = compare(without(simulated, "throttle"), vehicle)
    assert compared.speed_imposed
    assert compared["tractor_vx_mps"].imposed
    assert "imposed" in verdict(compared)
    assert not compare(without(simulated, "throttle"), vehicle, impose_speed=False).speed_imposed


def test_few_channels_weaken_the_comparison_but_do_not_break_it(
    vehicle: Vehicle, simulated: Recording
) -> None:
    names = [n for n in simulated.channels if n not in (*INPUTS, "tractor_yaw_rate_radps")]
    compared = compare(without(simulated, *names), vehicle)
    assert [channel.name for channel in compared.channels] == ["tractor_yaw_rate_radps"]
    assert "the tractor's yaw rate within" in verdict(compared)


def test_a_recording_without_outputs_or_steering_is_refused(
    vehicle: Vehicle, simulated: Recording
) -> None:
    names = [n for n in simulated.channels if n not in INPUTS]
    with pytest.raises(InputError, match="no output channel to compare"):
        compare(without(simulated, *names), vehicle)
    with pytest.raises(InputError, match="steering_wheel_angle_rad was not recorded"):
        compare(without(simulated, "steering_wheel_angle_rad"), vehicle)


def test_the_same_runs_give_the_same_bytes(
    vehicle: Vehicle, simulated: Recording, tmp_path: Path
) -> None:
    for name in ("a.json", "b.json"):
        write_comparison(compare(simulated, vehicle), tmp_path / name)
    assert (tmp_path / "a.json").read_bytes() == (tmp_path / "b.json").read_bytes()


def test_channels_of_parts_that_the_vehicle_lacks_are_told(
    vehicle: Vehicle, simulated: Recording
) -> None:
    wheel = Series(simulated["tractor_vx_mps"].time_s, simulated["tractor_vx_mps"].value)
    strange = simulated.with_channels({"hub_speed_front_left_radps": wheel})
    notes = compare(strange, vehicle).notes
    assert any("no such part: hub_speed_front_left_radps" in note for note in notes)


def test_json_carries_si_and_display_units(vehicle: Vehicle, simulated: Recording) -> None:
    compared = compare(offset(simulated, "tractor_vx_mps", 0.44704), vehicle)
    found = json.loads(json.dumps(encode_comparison(compared)))
    speed = found["channels"]["tractor_vx_mps"]
    assert speed["display"]["unit"] == "mph"
    assert speed["display"]["rms"] == pytest.approx(speed["rms"] / 0.44704)
    assert found["vehicle"] == "international_9400i_trailmobile"
    assert found["blowouts"] == [{"time_s": 2.0, "tires": ["steer_left"]}]
    assert found["channels"]["tractor_along_m"]["noise_sigma"] is None


def test_progress_only_grows_and_ends_at_one(vehicle: Vehicle, simulated: Recording) -> None:
    told: list[float] = []
    compare(simulated, vehicle, progress=lambda _, share: told.append(share))
    assert told == sorted(told)
    assert told[-1] == 1.0


def test_the_nominal_truck_stays_close(shared_recordings: Path, vehicle: Vehicle) -> None:
    """An individual of the same spec sheet, uncalibrated: masses, tires, brakes within 4 %."""
    folder = shared_recordings / "proving_ground" / "nominal"
    blowout = compare(folder / "blowout.csv", vehicle)
    for unit in ("tractor", "trailer"):
        assert blowout[f"{unit}_yaw_rate_radps"].rms < np.radians(0.15)
    coast = compare(folder / "coast_down.csv", vehicle)["tractor_vx_mps"]
    assert abs(coast.peak) < 0.01 * 26.4
