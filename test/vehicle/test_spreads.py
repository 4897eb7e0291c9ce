"""What a vehicle file says about its numbers' spread reaches the packed parameters."""

from __future__ import annotations

from pathlib import Path

import pytest

from truck_blowout_sim.vehicle import Packed, load_vehicle, pack
from truck_blowout_sim.vehicle.packing import packed_spreads

STATED = """\
extends: international_9400i_trailmobile
units:
  tractor:
    body:
      izz_kgm2: {value: 20000, spread: 1500, source: swung}
steering:
  ratio: {value: 20, spread: 0.4, source: counted}
axles:
  drive_1:
    track_m: {value: 1.84, spread: 0.03, source: taped}
    brake:
      linear_nmppa: {value: 0.02, spread: 0.002, source: rolled}
circuits:
  trailer:
    delay_s: {value: 0.15, spread: 0.02, source: timed}
"""


@pytest.fixture
def stated(tmp_path: Path) -> Packed:
    path = tmp_path / "stated.yaml"
    path.write_text(STATED, encoding="utf-8")
    return pack(load_vehicle(path))


def test_a_spread_has_the_unit_of_the_packed_number(stated: Packed) -> None:
    """Inertia, ratio and delay as they stand; a brake's slope as a share of its gain."""
    found = packed_spreads(stated)
    assert found["unit.tractor.izz_kgm2"] == pytest.approx(1500.0)
    assert found["steering.ratio"] == pytest.approx(0.4)
    assert found["circuit.trailer.delay_s"] == pytest.approx(0.02)
    assert found["hub.drive_1_left.brake_gain"] == pytest.approx(0.1)
    assert "hub.drive_2_left.brake_gain" not in found


def test_a_hub_lies_half_a_track_from_the_middle(stated: Packed) -> None:
    found = packed_spreads(stated)
    assert found["hub.drive_1_left.y_m"] == found["hub.drive_1_right.y_m"] == pytest.approx(0.015)
    assert "hub.drive_2_left.y_m" not in found


@pytest.mark.parametrize("name", ["international_9400i_trailmobile", "bmw_320i"])
def test_what_states_no_spread_has_none(name: str) -> None:
    assert packed_spreads(pack(load_vehicle(name))) == {}


def test_every_packed_name_exists(tmp_path: Path) -> None:
    """A vehicle in ten lines: the rules of thumb state a spread of what they fill in."""
    path = tmp_path / "ten_lines.yaml"
    path.write_text(
        "single_track:\n  kind: car\n  mass_kg: {value: 1500, spread: 30}\n  wheelbase_m: 2.7\n"
        "  cg_x_m: 1.3\n  yaw_inertia_kgm2: 2500\n  steering_ratio: 16\n  tire: 205/55R16\n",
        encoding="utf-8")
    truck = pack(load_vehicle(path))
    found = packed_spreads(truck)
    assert len(found) > 40
    assert set(found) <= set(truck.index)
    assert all(spread > 0.0 for spread in found.values())
    assert found["unit.tractor.mass_kg"] == pytest.approx(30.0)
