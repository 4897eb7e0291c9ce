"""`truck-blowout vehicle` as a user runs it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from truck_blowout_sim.cli.main import main

CAR = """title: my car
single_track:
  {kind: car, mass_kg: 1500, wheelbase_m: 2.7, cg_x_m: 1.2, steering_ratio: 15, tire: 205/55R16}
"""


@pytest.fixture
def car(tmp_path: Path) -> str:
    path = tmp_path / "car.yaml"
    path.write_text(CAR)
    return str(path)


def test_it_says_what_was_filled_in_and_from_where(
    car: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["vehicle", car]) == 0
    said = capsys.readouterr().out
    assert "front: 833 kg" in said
    assert "understeer gradient" in said
    assert "units.tractor.body.izz_kgm2" in said
    assert "dynamic index 1" in said


def test_json_holds_the_same_numbers(car: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["vehicle", car, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["mass_kg"]["tractor"] == pytest.approx(1500)
    filled = {one["key"]: one for one in told["filled_in"]}
    assert filled["units.tractor.body.izz_kgm2"]["spread"] > 0.0


def test_a_shipped_vehicle_has_nothing_filled_in(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["vehicle", "international_9400i_trailmobile"]) == 0
    said = capsys.readouterr().out
    assert "11,925 lb" in said
    assert "filled in" not in said


def test_rig_plots_are_drawn_for_the_tires_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "rig"
    assert main(["vehicle", "rigid_truck", "--tire", "steer", "-o", str(folder)]) == 0
    assert (folder / "rig_steer_left.png").stat().st_size > 10_000
    assert "rig_steer_left.png" in capsys.readouterr().out
    assert main(["vehicle", "rigid_truck", "--tire", "steer", "-o", str(folder)]) == 2
    assert "--force" in capsys.readouterr().err


def test_an_unknown_tire_is_refused_with_the_nearest(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["vehicle", "rigid_truck", "--tire", "ster_left"]) == 2
    assert "expected steer_left" in capsys.readouterr().err
