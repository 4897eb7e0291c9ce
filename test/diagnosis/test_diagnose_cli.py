"""`truck-blowout diagnose`: files, keys, the same bytes, a better fit, refusals."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
import yaml

from truck_blowout_sim.cli.main import main
from truck_blowout_sim.comparison import compare
from truck_blowout_sim.diagnosis import QUICK, diagnose, write_diagnosis
from truck_blowout_sim.diagnosis.sensors import channel_noise
from truck_blowout_sim.recordings import Recording, read_recording, write_recording
from truck_blowout_sim.resources import config_file
from truck_blowout_sim.simulation import simulate_inputs
from truck_blowout_sim.vehicle import Packed, load_vehicle, pack

Drives = Callable[..., Recording]
NAME = "international_9400i_trailmobile"
FEW = {"mass": "towed_units", "cornering": "towed", "steering_zero": "steering",
       "rolling_resistance": "truck", "brake_gain": "hubs"}


@dataclass(frozen=True)
class Case:
    """A diagnosed case: its recordings and what was written."""

    train: Path
    holdout: Path
    settings: Path
    folder: Path
    answer: dict


@pytest.fixture(scope="module")
def case(tmp_path_factory: pytest.TempPathFactory, drive_it: Drives, truck: Packed) -> Case:
    """A weak trailer brake, asked on the command line."""
    folder = tmp_path_factory.mktemp("case")
    hub = "hub.trailer_2_left.brake_gain"
    weak = {hub: 0.2 * truck[hub]}
    write_recording(drive_it(weak, name="train"), folder / "train.csv")
    write_recording(drive_it(weak, seed=3, steer=-0.9, name="holdout"), folder / "holdout.csv")
    tree = yaml.safe_load(config_file("diagnosis", "default").read_text(encoding="utf-8"))
    tree["sheet"] = {name: {**tree["sheet"][name], "for": {role: tree["sheet"][name]["for"][role]}}
                     for name, role in FEW.items()}
    (folder / "few.yaml").write_text(yaml.safe_dump(tree), encoding="utf-8")
    status = main(["diagnose", str(folder / "train.csv"), "--holdout", str(folder / "holdout.csv"),
                   "--settings", str(folder / "few.yaml"), "--quick", "-o", str(folder / "out")])
    assert status == 0
    answer = json.loads((folder / "out" / "diagnosis.json").read_text(encoding="utf-8"))
    return Case(folder / "train.csv", folder / "holdout.csv", folder / "few.yaml",
                folder / "out", answer)


def test_the_weak_brake_is_the_answer(case: Case) -> None:
    assert case.answer["verdict"] == "missing_physics"
    effect, = case.answer["effects"]
    assert effect["name"] == "brake_imbalance"
    assert effect["where"]["hub"] == "trailer_2_left"
    ratio = effect["parameters"]["torque_ratio"]
    assert ratio["ci90"][0] < ratio["value"] < ratio["ci90"][1]
    assert ratio["value"] == pytest.approx(0.2, abs=0.15)
    assert case.answer["alias_sets"][0][0] == "brake_imbalance"


def test_the_file_has_the_promised_keys(case: Case) -> None:
    answer = case.answer
    assert list(answer) == ["verdict", "effects", "alias_sets", "location", "fit", "null_p_value",
                            "next_test", "summary", "pulled", "would_show"]
    assert set(answer["effects"][0]) == {"name", "kind", "where", "onset_s", "onset_ci90_s",
                                         "parameters", "equation", "sentence"}
    assert set(answer["location"]) == {"channels", "interval_s", "body", "line_of_action_x_m",
                                       "line_of_action_ci90_m", "wrench"}
    assert set(answer["fit"]) == {"train", "holdout"}
    assert 0.0 < answer["null_p_value"] < 0.02
    assert len(answer["alias_sets"]) == len(answer["effects"])
    assert answer["next_test"]


def test_the_same_inputs_give_the_same_bytes(case: Case, tmp_path: Path) -> None:
    vehicle = load_vehicle(NAME)
    train, holdout = (read_recording(p, hubs=vehicle.hubs, tires=vehicle.tires)
                      for p in (case.train, case.holdout))
    again, _ = diagnose([train], holdout=[holdout], settings=str(case.settings), effort=QUICK,
                        workers=1)
    write_diagnosis(again, tmp_path / "again.json")
    assert (tmp_path / "again.json").read_bytes() == (case.folder / "diagnosis.json").read_bytes()


def test_the_vehicle_file_drives_and_fits_a_run_never_fitted(case: Case) -> None:
    given, found = (load_vehicle(v) for v in (NAME, str(case.folder / "vehicle.yaml")))
    hub = "hub.trailer_2_left.brake_gain"
    assert pack(found)[hub] < 0.6 * pack(given)[hub]
    measured = read_recording(case.holdout, hubs=given.hubs, tires=given.tires)
    name = "tractor_vx_mps"
    times = np.arange(5.0, 6.8, 0.05)
    before, after = (np.sqrt(np.mean((measured.at(name, times) - simulate_inputs(
        v, measured, step_s=0.0025).at(name, times)) ** 2)) for v in (given, found))
    assert after < 0.6 * before


def test_compare_gives_the_figures_of_the_answer_on_unseen_runs(case: Case) -> None:
    vehicle = load_vehicle(str(case.folder / "vehicle.yaml"))
    compared = compare(case.holdout, vehicle)
    noise = channel_noise(compared.recording)
    told = case.answer["fit"]["holdout"]["after"]
    assert len(told) > 5
    for channel, figure in told.items():
        found = compared[channel].rms / noise[channel].sigma
        assert found == pytest.approx(figure, rel=1e-3), channel


def test_each_value_has_a_source_of_its_own_and_none_is_of_the_place(case: Case) -> None:
    effects = load_vehicle(str(case.folder / "vehicle.yaml")).effects
    text = " ".join((case.folder / "vehicle.yaml").read_text(encoding="utf-8").split())
    assert "diagnosed: brake_imbalance trailer_2_left" in text
    assert "sheet number" in text
    assert not [name for name in effects if name.startswith("world.")]


def test_the_page_is_written_and_says_the_verdict(case: Case) -> None:
    page = (case.folder / "report.html").read_text(encoding="utf-8")
    assert case.answer["effects"][0]["sentence"] in page


def refused(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    assert main(["diagnose", *words]) == 2
    line, = [text for text in capsys.readouterr().err.splitlines() if text.strip()]
    return line


def test_bad_input_is_one_line_and_status_2(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, drive_it: Drives
) -> None:
    out = ("-o", str(tmp_path / "out"))
    good = drive_it()
    write_recording(good, tmp_path / "good.csv")
    blind = Recording("blind", {n: s for n, s in good.channels.items() if "steering" not in n})
    write_recording(blind, tmp_path / "blind.csv")
    path = str(tmp_path / "good.csv")
    assert "nowhere.csv" in refused(capsys, str(tmp_path / "nowhere.csv"), *out)
    assert "steering_wheel_angle_rad" in refused(capsys, str(tmp_path / "blind.csv"), *out)
    assert "no_truck" in refused(capsys, path, "--vehicle", "no_truck", *out)
    assert "no_file" in refused(capsys, path, "--settings", "no_file", *out)
    assert "no effect is called 'wind'" in refused(capsys, path, "--without", "wind", *out)
    assert "--output" in refused(capsys, path)
    assert not (tmp_path / "out" / "diagnosis.json").exists()


def test_thorough_says_how_long_and_follows_the_likelihood(
    case: Case, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    assert main(["diagnose", str(case.train), "--holdout", str(case.holdout), "--settings",
                 str(case.settings), "--thorough", "-o", str(tmp_path / "out")]) == 0
    shown = capsys.readouterr()
    assert "finding four effects would take about" in shown.err
    answer = json.loads((tmp_path / "out" / "diagnosis.json").read_text(encoding="utf-8"))
    assert f"how sure: {answer['summary']['sure']}" in shown.out.splitlines()  # a pipe: unbroken
    ratio, quick = (a["effects"][0]["parameters"]["torque_ratio"] for a in (answer, case.answer))
    assert answer["effects"][0]["name"] == "brake_imbalance"
    assert ratio["ci90"][0] < 0.3 < ratio["ci90"][1]
    assert ratio["ci90"] != quick["ci90"]
    assert ratio["ci90"] == pytest.approx(quick["ci90"], abs=0.05)


def test_help_names_every_option(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["diagnose", "--help"]) == 0
    text = capsys.readouterr().out
    for option in ("--baseline", "--holdout", "--vehicle", "--output", "--settings",
                   "--without", "--quick", "--thorough"):
        assert option in text
