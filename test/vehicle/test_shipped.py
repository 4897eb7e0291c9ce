"""The files that ship: sourced throughout, quick to load."""

from __future__ import annotations

import pickle
from pathlib import Path

import pytest

from truck_blowout_sim.resources import config_dir
from truck_blowout_sim.vehicle import document, load_road, load_vehicle, pack
from truck_blowout_sim.vehicle.document import Branch, Leaf, parse
from truck_blowout_sim.vehicle.reading import to_number

FILES = sorted(
    path
    for kind in ("vehicles", "tires", "blowout", "roads")
    for path in (config_dir() / kind).glob("*.yaml")
)
VEHICLES = [path.stem for path in FILES if path.parent.name == "vehicles"]
ROADS = [path.stem for path in FILES if path.parent.name == "roads"]


def numbers_without_source(tree: Branch) -> list[str]:
    found = []
    for entry in tree.entries.values():
        if isinstance(entry, Branch):
            found += numbers_without_source(entry)
        elif not entry.source and is_number(entry):
            found.append(entry.place.key)
    return found


def is_number(leaf: Leaf) -> bool:
    return isinstance(leaf.value, (int, float, list)) and not isinstance(leaf.value, bool)


@pytest.mark.parametrize("path", FILES, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_every_number_has_a_source(path: Path) -> None:
    assert not numbers_without_source(parse(path))


@pytest.mark.parametrize("path", FILES, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_numbers_are_written_as_numbers(path: Path) -> None:
    """YAML 1.1 takes `3e6` for a text; this package reads it, other readers of our files do not."""

    def walk(tree: Branch) -> None:
        for entry in tree.entries.values():
            if isinstance(entry, Branch):
                walk(entry)
            elif isinstance(entry.value, str):
                with pytest.raises(Exception, match="not a number"):
                    to_number(entry.value, entry.place)

    walk(parse(path))


@pytest.mark.parametrize("name", VEHICLES)
def test_loading_reads_few_files(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    read: list[Path] = []
    real = Path.read_text

    def counting(path: Path, encoding: str | None = None) -> str:
        read.append(path)
        return real(path, encoding=encoding)

    monkeypatch.setattr(Path, "read_text", counting)
    document._parsed.cache_clear()
    pack(load_vehicle(name))
    yaml = [path for path in read if path.suffix == ".yaml"]
    assert 0 < len(yaml) < 20, [path.name for path in yaml]
    read.clear()
    load_vehicle(name)
    assert not read  # what has not changed is parsed once


@pytest.mark.parametrize("name", VEHICLES)
def test_every_value_of_a_loaded_vehicle_is_traced(name: str) -> None:
    vehicle = load_vehicle(name)
    for tire in set(vehicle.tire_files.values()):
        assert f"tires.{tire}.cornering_peak" in vehicle.sources
    for key in ("units.tractor.body.mass_kg", "driveline.drag_n", "road.gravity_mps2"):
        assert vehicle.sources[key]
    assert vehicle.sources["blowout.flat_cornering"]


@pytest.mark.parametrize("name", ROADS)
def test_roads_load(name: str) -> None:
    assert load_road(name).gravity_mps2 == 9.81


def test_a_vehicle_is_unchanged_by_one_that_extends_it(tmp_path: Path) -> None:
    before = load_vehicle("rigid_truck").spec
    path = tmp_path / "mine.yaml"
    path.write_text("extends: rigid_truck\nsteering: {ratio: 31}\n", encoding="utf-8")
    assert load_vehicle(path).spec != before
    assert load_vehicle("rigid_truck").spec == before


def test_the_thesis_vehicle_is_what_the_thesis_prints() -> None:
    packed = pack(load_vehicle("international_9400i_trailmobile_thesis"))
    printed = {
        "axle.steer.mass_kg": 527,
        "axle.drive_1.ixx_kgm2": 579,
        "axle.drive_2.izz_kgm2": 584,
        "axle.trailer_2.ixx_kgm2": 593,
        "axle.trailer_1.damping_nspm": 30e3,
        "unit.tractor.mass_kg": 6483,
        "unit.tractor.iyy_kgm2": 21711,
        "unit.trailer.mass_kg": 5927 + 3978 + 5967,
        "unit.trailer.payload_kg": 9945,
        "tire.drive_1_left_outer.stiffness_npm": 980e3,
        "tire.drive_1_left_outer.law": 1,
        "tire.drive_1_left_outer.model": 1,
        "abs.mode": 1,
        "abs.slip_off": 0.08,
        "abs.slip_on": 0.06,
        "steering.ratio": 25,
        "steering.compliance_on": 0,
    }
    assert {name: packed[name] for name in printed} == pytest.approx(printed)
    for tire, radius in (("steer_left", 0.491), ("drive_2_right_inner", 0.481)):
        rolling = packed[f"tire.{tire}.unloaded_radius_m"] + packed[f"tire.{tire}.radius_offset_m"]
        assert rolling == pytest.approx(radius)
        assert packed[f"tire.{tire}.radius_fraction"] == 0.0


# but where a table says how stiff the tire is at each step
@pytest.mark.parametrize("name", [n for n in VEHICLES if load_vehicle(n).blowout.law != "steps"])
def test_a_tire_without_gas_is_soft(name: str) -> None:
    vehicle = load_vehicle(name)
    for tire in vehicle.tire_specs.values():
        inflated = tire.stiffness_npm + tire.stiffness_npmppa * tire.pressure_pa
        assert tire.stiffness_npm < 0.2 * inflated


@pytest.mark.parametrize("name", VEHICLES)
def test_a_packed_vehicle_crosses_to_another_process(name: str) -> None:
    packed = pack(load_vehicle(name))
    copy = pickle.loads(pickle.dumps(packed))
    assert (copy.params == packed.params).all()
    assert copy.names == packed.names
