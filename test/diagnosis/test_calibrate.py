"""Calibration: sheet numbers from ordinary driving, with intervals; a file that drives the rest."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim.cli.calibrate import as_plain, lines
from truck_blowout_sim.cli.main import main
from truck_blowout_sim.diagnosis.calibrate import (
    Calibration,
    SheetNumber,
    calibrate,
    describe,
    write_calibrated_vehicle,
)
from truck_blowout_sim.diagnosis.settings import Settings, load_settings
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.simulation import simulate
from truck_blowout_sim.vehicle import Packed, load_vehicle, pack

Drives = Callable[..., Recording]
BASE = "international_9400i_trailmobile"
HEAVY = 1.03


@pytest.fixture(scope="module")
def found(truck: Packed, drive_it: Drives, few: Settings) -> Calibration:
    """A truck 3 % heavier in its trailer, with a tighter grip of its steer tires."""
    changes = {"unit.trailer.mass_kg": HEAVY * truck["unit.trailer.mass_kg"]}
    changes |= {name: 0.95 * truck[name] for name in truck.index
                if name.startswith("tire.steer_") and name.endswith(".cornering_scale")}
    runs = [drive_it(changes, seed=k, name=f"run {k}") for k in (1, 2)]
    unseen = drive_it(changes, seed=3, steer=0.7, name="unseen")
    return calibrate(runs, holdout=[unseen], vehicle=BASE, settings=few, step_s=0.0025)


def test_numbers_that_differ_are_found_within_their_intervals(found: Calibration) -> None:
    by_name = {n.name: n for n in found.numbers}
    for name, truth in (("trailer_mass", HEAVY - 1.0), ("steered_cornering", -0.05)):
        number = by_name[name]
        assert number.told
        low, high = number.ci90
        assert low - 0.5 * (high - low) < truth < high + 0.5 * (high - low)


def test_what_the_runs_cannot_tell_stays_at_the_sheet_and_is_named(found: Calibration) -> None:
    assert found.untold
    assert all(n.change == 0.0 for n in found.untold)
    said = "\n".join(lines(found, Path("x.yaml")))
    assert all(n.name.replace("_", " ") in said for n in found.untold)


def test_unseen_runs_are_predicted_better(found: Calibration) -> None:
    ratio = found.error_ratio(unseen=True)
    assert ratio is not None
    assert ratio < 0.8
    assert {c.recording for c in found.changes if c.unseen} == {"unseen"}


def test_the_file_is_the_calibrated_truck_with_a_source_for_each_value(
    found: Calibration, tmp_path: Path
) -> None:
    path = tmp_path / "my_truck.yaml"
    written = write_calibrated_vehicle(path, BASE, found)
    assert np.array_equal(pack(written).params, found.packed.params)
    text = path.read_text(encoding="utf-8")
    assert "calibrated on run 1, run 2: trailer mass" in " ".join(text.split())
    assert not [name for name in pack(load_vehicle(path)).vehicle.effects if "world." in name]


def test_a_number_reads_as_a_sentence(found: Calibration) -> None:
    number = next(n for n in found.told if n.name == "trailer_mass")
    assert describe(number).startswith("trailer mass +")
    assert "prior 2 %: judgement: weighing" in describe(number)


@pytest.mark.parametrize(("key", "words"), [
    ("steering.lag_s", "+90 ms"), ("steering.ratio_curve_prad2", "+0.09 1/rad²"),
    ("driveline.drag_n", "+0.09 N"),
])  # fmt: skip
def test_an_amount_has_the_unit_of_what_it_moves(key: str, words: str) -> None:
    number = SheetNumber("some_number", "add", 0.09, (0.05, 0.13), 0.03, "", {key: 0.09}, True,
                         False, False)  # fmt: skip
    assert describe(number).startswith(f"some number {words} (90 %")


def test_plain_data_is_json_and_holds_the_calibration(found: Calibration) -> None:
    plain = json.loads(json.dumps(as_plain(found, Path("x.yaml")), allow_nan=False))
    assert (plain["vehicle"], plain["base"]) == ("x.yaml", BASE)
    assert (plain["runs"], plain["holdout"]) == (["run 1", "run 2"], ["unseen"])
    (mass,) = [n for n in plain["numbers"] if n["name"] == "trailer_mass"]
    assert mass["told"]
    assert mass["ci90"][0] < mass["change"] < mass["ci90"][1]
    assert mass["values"]["unit.trailer.mass_kg"] == found.packed["unit.trailer.mass_kg"]
    assert {e["recording"] for e in plain["errors"] if e["unseen"]} == {"unseen"}
    assert plain["error_ratio"]["unseen"] < 0.8


def test_a_long_coast_down_is_followed_to_millimeters_a_second(ten_line_car: Path) -> None:
    """A car 3 % heavier and with 10 % more drag than its sheet: 0.2 m/s of error on the sheet."""
    car = load_vehicle(ten_line_car)
    sheet, settings = pack(car), load_settings(pack(car))
    more = {"unit.tractor.mass_kg": HEAVY, "driveline.drag_n": HEAVY,
            "unit.tractor.drag_area_m2": 1.1}  # fmt: skip
    heavy = sheet.with_values({name: factor * sheet[name] for name, factor in more.items()})
    few = [n for n in settings.nuisances if n.name in
           ("tractor_mass", "rolling_resistance", "driveline_loss", "drag_area")]
    found = calibrate([simulate(heavy, "coast_down")], vehicle=car,
                      settings=replace(settings, nuisances=tuple(few)))  # fmt: skip
    (speed,) = [c for c in found.changes if c.channel == "tractor_vx_mps"]
    assert speed.before > 0.15
    # mass and three drags can hardly be told apart: which of them move depends on rounding
    assert speed.after < 0.005


def test_bad_input_is_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(InputError, match="no recording"):
        calibrate([])
    assert main(["calibrate", str(tmp_path / "none.csv"), "-o", str(tmp_path / "v.yaml")]) == 2
    assert len(capsys.readouterr().err.strip().splitlines()) == 1
    assert not (tmp_path / "v.yaml").exists()


def test_a_person_is_told_why_nothing_is_proven_and_what_did_not_change(found: Calibration
                                                                        ) -> None:
    def said(**changes: object) -> list[str]:
        return list(lines(replace(found, **changes), Path("x.yaml")))  # type: ignore[arg-type]

    fitted = tuple(c for c in found.changes if not c.unseen)
    assert ("unseen runs: none given (--holdout), so nothing is proven on new driving"
            in said(changes=fitted, holdout=()))
    assert ("unseen runs: no channel of these runs could be compared, so nothing is proven on new "
            "driving" in said(changes=fitted))
    still = tuple(replace(c, after=c.before) for c in found.changes)
    assert ("fitted runs: errors are as large on average; no channel got worse"
            in said(changes=still))


@pytest.mark.parametrize("share", [0.5, 0.0])
def test_what_is_told_is_what_was_written(truck: Packed, drive_it: Drives, few: Settings,
                                          monkeypatch: pytest.MonkeyPatch, share: float) -> None:
    """Moved half of the way, numbers are at no end; with the sheet kept, none is told."""
    worse_then = iter([1.0, -1.0] if share else [1.0] * 3)
    monkeypatch.setattr(import_module("truck_blowout_sim.diagnosis.calibrate"), "_mean_log",
                        lambda changes: next(worse_then))
    far = {"unit.trailer.mass_kg": 1.3 * truck["unit.trailer.mass_kg"]}
    moved = calibrate([drive_it(far, seed=1, name="far")], vehicle=BASE, settings=few,
                      step_s=0.0025)  # fmt: skip
    mass = next(n for n in moved.numbers if n.name == "trailer_mass")
    said = list(lines(moved, Path("x.yaml")))
    assert moved.share == share
    assert mass.change == pytest.approx(3.0 * share * mass.prior_sigma)
    assert mass.values == {name: moved.packed[name] for name in mass.values}
    assert not mass.at_prior_end
    assert "trailer mass" in said[-2]
    assert "these runs ask for more than vehicles of one kind differ" in said[-2]
    if share:
        assert said[0].endswith("numbers are told by these runs:")
        assert "moved 50% of the way" in "\n".join(said)
    else:
        assert moved.told == ()
        assert said[0].startswith("nothing was calibrated, the sheet was kept: ")
        assert len(said) == 3
        assert json.loads(json.dumps(as_plain(moved, Path("x.yaml"))))["share"] == 0.0
