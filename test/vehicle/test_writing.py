"""Writing a changed vehicle and reading it back."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.vehicle import Packed, load_vehicle, pack, write_vehicle

DEFAULT = "international_9400i_trailmobile"
GAIN = "hub.trailer_2_left.brake_gain"


def test_a_written_vehicle_is_the_base_with_the_values(tmp_path: Path, packed: Packed) -> None:
    path = tmp_path / "vehicle.yaml"
    values = {GAIN: 0.35, "unit.trailer.gust_start_s": 12.5, "axle.steer.roll_steer_extra": -1e-5}
    write_vehicle(path, DEFAULT, values, {GAIN: "diagnosed, 0.33 to 0.37"})
    mine = pack(load_vehicle(path))
    assert {name: mine[name] for name in packed.index if mine[name] != packed[name]} == values
    assert mine.vehicle.sources[f"effects.{GAIN}"] == "diagnosed, 0.33 to 0.37"
    assert [file.name for file in tmp_path.iterdir()] == ["vehicle.yaml"]
    assert path.read_text().startswith(f"extends: {DEFAULT}\n")


def test_a_vehicle_of_ones_own_is_extended_by_path(
    tmp_path: Path, extending: Callable[[str], Path]
) -> None:
    base = load_vehicle(extending("effects: {driveline.drag_extra_n: 100}"))
    (tmp_path / "out").mkdir()
    written = write_vehicle(tmp_path / "out" / "vehicle.yaml", base, {GAIN: 0.5}, title="again")
    assert pack(written)["driveline.drag_extra_n"] == 100.0
    assert pack(written)[GAIN] == 0.5
    assert written.title == "again"


def test_the_base_may_be_a_path(tmp_path: Path, extending: Callable[[str], Path]) -> None:
    path = extending("steering: {ratio: 20}")
    written = write_vehicle(tmp_path / "vehicle.yaml", path, {GAIN: 0.5})
    assert pack(written)["steering.ratio"] == 20.0


def test_over_its_own_base_is_refused(extending: Callable[[str], Path]) -> None:
    path = extending("steering: {ratio: 20}")
    before = path.read_text()
    with pytest.raises(InputError, match="its own base"):
        write_vehicle(path, path, {GAIN: 0.5})
    assert path.read_text() == before


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"hub.trailer_2_left.brake_gian": 1.0}, "did you mean 'hub.trailer_2_left.brake_gain'"),
        ({GAIN: math.nan}, "NaN"),
        ({"unit.trailer.mass_kg": -1.0}, "out of bounds"),
        ({"hub.steer_left.toe_rad": math.inf}, "finite"),
    ],
)
def test_what_cannot_be_is_refused_and_leaves_nothing(
    tmp_path: Path, values: dict[str, float], words: str
) -> None:
    with pytest.raises(InputError, match=words):
        write_vehicle(tmp_path / "vehicle.yaml", DEFAULT, values)
    assert not list(tmp_path.iterdir())


def test_a_missing_folder_is_one_line(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="cannot be written"):
        write_vehicle(tmp_path / "no" / "vehicle.yaml", DEFAULT, {GAIN: 1.0})


@settings(max_examples=40, deadline=None)
@given(value=st.floats(-1e12, 1e12))
def test_values_come_back_to_the_last_bit(
    tmp_path_factory: pytest.TempPathFactory, value: float
) -> None:
    path = tmp_path_factory.mktemp("any") / "vehicle.yaml"
    written = write_vehicle(path, DEFAULT, {"steering.offset_rad": value})
    assert pack(written)["steering.offset_rad"] == value


@settings(max_examples=40, deadline=None)
@given(source=st.text())
def test_sources_come_back_in_one_line(
    tmp_path_factory: pytest.TempPathFactory, source: str
) -> None:
    path = tmp_path_factory.mktemp("any") / "vehicle.yaml"
    written = write_vehicle(path, DEFAULT, {GAIN: 1.0}, {GAIN: source})
    printable = "".join(c if c.isprintable() else " " for c in source)
    assert written.effects[GAIN].source.split() == printable.split()
    assert len(written.effects[GAIN].source.splitlines()) <= 1


def test_a_value_out_of_bounds_names_the_file_that_was_asked_for(tmp_path: Path) -> None:
    target = tmp_path / "vehicle.yaml"
    with pytest.raises(InputError, match=r"vehicle\.yaml, line") as refused:
        write_vehicle(target, DEFAULT, {"world.friction_scale": -1.0})
    assert refused.value.file == str(target)
    assert not list(tmp_path.iterdir())
