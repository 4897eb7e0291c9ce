"""Files that extend others."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.vehicle import Packed, Vehicle, load_vehicle, pack, write_vehicle

Extending = Callable[[str], Path]
Refusal = Callable[[Path], str]


def test_one_key_is_overridden_and_the_rest_stays(
    extending: Extending, default_vehicle: Vehicle
) -> None:
    mine = load_vehicle(extending("steering: {ratio: {value: 20, source: counted}}"))
    assert mine.spec.steering is not None
    assert default_vehicle.spec.steering is not None
    assert mine.spec.steering.ratio == 20.0
    assert mine.spec.steering.inertia_kgm2 == default_vehicle.spec.steering.inertia_kgm2
    assert mine.sources["steering.ratio"] == "counted"
    assert mine.spec.axles == default_vehicle.spec.axles
    assert mine.name == "mine"


def test_an_override_of_one_axle_leaves_its_twin_alone(extending: Extending) -> None:
    axles = load_vehicle(extending("axles: {drive_1: {mass_kg: 1100}}")).spec.axles
    assert (axles["drive_1"].mass_kg, axles["drive_2"].mass_kg) == (1100.0, 973.0)


def test_an_override_may_use_another_unit(extending: Extending) -> None:
    mine = load_vehicle(extending("units: {tractor: {body: {mass_lb: 12000}}}"))
    assert mine.spec.units.tractor.body.mass_kg == pytest.approx(5443.10844)


def test_files_extend_by_path_over_several_generations(write: Callable[..., Path]) -> None:
    write("extends: ferrari_250lm\ntitle: first\n", "first.yaml")
    second = write("extends: first.yaml\nsteering: {ratio: 2}\n", "second.yaml")
    mine = load_vehicle(second)
    assert mine.title == "first"
    assert mine.spec.steering is not None
    assert mine.spec.steering.ratio == 2.0


def test_a_circle_names_the_line_that_closes_it(write: Callable[..., Path]) -> None:
    write("extends: b.yaml\n", "a.yaml")
    path = write("# first\nextends: a.yaml\n", "b.yaml")
    with pytest.raises(InputError, match=r"a\.yaml.*line 1: extends: 'b.yaml' extends itself"):
        load_vehicle(path)


def test_an_empty_key_takes_out_what_the_base_has(extending: Extending) -> None:
    text = "units: {trailer: {payload: {front_block: }}}"
    payload = load_vehicle(extending(text)).unit_specs["trailer"].payload
    assert list(payload) == ["rear_blocks"]


def test_an_empty_key_without_base_is_refused(extending: Extending, refusal: Refusal) -> None:
    assert "steering.rato: is empty" in refusal(extending("steering: {rato: }"))


def test_effects_set_parameters_by_packed_name(extending: Extending, packed: Packed) -> None:
    text = "effects: {hub.trailer_2_left.brake_gain: {value: 0.35, source: diagnosed}}"
    vehicle = load_vehicle(extending(text))
    mine = pack(vehicle)
    assert mine["hub.trailer_2_left.brake_gain"] == 0.35
    assert vehicle.sources["effects.hub.trailer_2_left.brake_gain"] == "diagnosed"
    changed = [name for name in packed.index if mine[name] != packed[name]]
    assert changed == ["hub.trailer_2_left.brake_gain"]


def test_effects_add_up_over_generations(write: Callable[..., Path], extending: Extending) -> None:
    extending("effects: {axle.steer.misalignment_rad: 0.01}")
    child = write("extends: mine.yaml\neffects: {driveline.drag_extra_n: 400}\n", "child.yaml")
    mine = pack(load_vehicle(child))
    assert (mine["axle.steer.misalignment_rad"], mine["driveline.drag_extra_n"]) == (0.01, 400.0)


def test_an_effect_may_be_in_degrees(extending: Extending) -> None:
    mine = pack(load_vehicle(extending("effects: {axle.steer.misalignment_deg: 1}")))
    assert mine["axle.steer.misalignment_rad"] == pytest.approx(0.017453292519943295)


def test_a_single_tire_of_a_hub_can_be_another(extending: Extending) -> None:
    text = "tires: {trailer_2_left: drive_295_75r22_5, trailer_2_left_inner: trailer_11r22_5}"
    files = load_vehicle(extending(text)).tire_files
    assert files["trailer_2_left_outer"] == "drive_295_75r22_5"
    assert files["trailer_2_left_inner"] == "trailer_11r22_5"
    assert files["trailer_2_right_outer"] == "trailer_11r22_5"


@pytest.mark.parametrize("text", ["blowout: {extends: continuous, flat_rolling: 0.5}",
                                  "tires: {steer: {extends: steer_275_80r22_5, rolling_0: 0.01}}"])
def test_a_section_that_extends_a_file_loads_again(
    extending: Extending, tmp_path: Path, text: str
) -> None:
    path = extending(text)
    first, again = load_vehicle(path), load_vehicle(path)
    assert pack(first).params.tobytes() == pack(again).params.tobytes()
    written = write_vehicle(tmp_path / "written.yaml", again, {"driveline.drag_extra_n": 400.0})
    assert pack(written)["driveline.drag_extra_n"] == 400.0
