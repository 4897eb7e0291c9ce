"""A rollover is a result with its instant; a run that leaves the model's range is an error."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim.cli.main import main
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.physics.layout import INPUT, N_INPUTS
from truck_blowout_sim.recordings import INPUT_NAMES, Recording, Series
from truck_blowout_sim.simulation import (
    InitialState,
    Inputs,
    Truck,
    drive_from,
    load_scenario,
    simulate,
)
from truck_blowout_sim.simulation.drive import Drive
from truck_blowout_sim.simulation.ending import ROLLED_OVER, rolled_over_rad
from truck_blowout_sim.simulation.plausible import DivergedError, implausible
from truck_blowout_sim.simulation.run import prepare
from truck_blowout_sim.simulation.summary import summarize
from truck_blowout_sim.vehicle import Packed, load_vehicle, pack

TURN = """\
title: a turn that is too fast for this load
end_s: 8
start: {{speed_mph: {mph}}}
steering:
  table: {{time_s: [1.0, 1.5], angle_deg: [0, {wheel}]}}
throttle: {{time_s: [0.0], opening: [0.0]}}
"""
Write = Callable[[str], Path]


@pytest.fixture(scope="module")
def tipped(truck: Packed, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("turn") / "turn.yaml"
    path.write_text(TURN.format(mph=60, wheel=270), encoding="utf-8")
    return path


def test_a_run_ends_where_a_unit_rolls_over(truck: Packed, tipped: Path) -> None:
    run = simulate(truck, load_scenario(tipped))
    instant = float(run.metadata["rolled_over_s"])
    assert 1.5 < instant < 8.0
    assert run.end_s == pytest.approx(instant, abs=0.011)
    unit = run.metadata["rolled_over_unit"]
    assert abs(run[f"{unit}_roll_rad"].value[-1]) == pytest.approx(math.radians(45.0), abs=0.05)
    assert f"the {unit} rolled over to the right" in run.notes[0]
    assert f"the {unit} rolled over at {instant:.2f} s" in summarize(run)


def test_run_says_so_and_exits_with_0(tipped: Path, tmp_path: Path,
                                      capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", str(tipped), "-o", str(tmp_path / "bag"), "--json"]) == 0
    measures = json.loads(capsys.readouterr().out)["measures"]
    assert measures["rolled_over"] is True
    assert measures["rolled_over_s"] == measures["ended_s"]


def test_a_truck_on_too_steep_a_bank_tips_and_says_when(truck: Packed) -> None:
    held = Truck(truck.unchecked({"world.road_bank_rad": 0.76}),
                 initial=InitialState(speed_mps=15.0))
    while held.ending is None and held.time_s < 6.0:
        held.advance(Inputs(), 100)
    assert held.ending is not None
    assert held.ending.kind >= ROLLED_OVER
    assert 3.0 < held.ending.time_s < 5.0
    assert "to the right" in held.ending.words
    held.reset()
    assert held.ending is None


def test_a_wide_low_car_must_turn_farther(truck: Packed) -> None:
    low = rolled_over_rad(pack(load_vehicle("ferrari_250lm")))
    assert low[0] > math.radians(50.0)
    assert (rolled_over_rad(truck) == math.radians(45.0)).sum() >= 1


def test_a_diverged_run_is_an_error_with_instant_and_cause(truck: Packed) -> None:
    stiff = truck.with_values({"tire.steer_left.stiffness_npm": 1e9})
    with pytest.raises(DivergedError, match=r"left the range of the model at \d+\.\d+ s: .*"
                       r"likeliest cause: axle steer swings on its tires at \d+ Hz"):
        simulate(stiff, "fishhook")


def test_every_verb_ends_with_2_where_the_run_diverges(tmp_path: Path,
                                                       capsys: pytest.CaptureFixture[str]) -> None:
    words = ["--set", "tire.steer_left.stiffness_npm=1e9", "-o", str(tmp_path / "bag")]
    assert main(["run", "fishhook", *words]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "left the range of the model" in line
    assert not (tmp_path / "bag").exists()


@pytest.mark.parametrize("change", ["tire.steer_left.stiffness_npm=1e10",
                                    "unit.trailer.mass_kg=1e7"])
def test_a_truck_that_finds_no_equilibrium_is_an_error(
    change: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Not a rollover before the first step, which the state it settles to would read as."""
    assert main(["run", "fishhook", "--set", change, "-o", str(tmp_path / "bag")]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "found no equilibrium to start from; likeliest cause" in line
    assert not (tmp_path / "bag").exists()


def test_a_model_that_diverges_explains_nothing(tmp_path: Path,
                                                capsys: pytest.CaptureFixture[str]) -> None:
    """On the coarse step of trials it finds no equilibrium, on the fine one it leaves its range."""
    path, log = tmp_path / "bad.yaml", tmp_path / "fishhook.csv"
    path.write_text("extends: international_9400i_trailmobile\neffects:\n  tire.steer_left."
                    "stiffness_npm: {value: 1.0e9, source: none}\n", encoding="utf-8")
    assert main(["run", "fishhook", "--format", "csv", "-o", str(log)]) == 0
    capsys.readouterr()
    assert main(["diagnose", str(log), "--vehicle", str(path), "--quick", "-o",
                 str(tmp_path / "out")]) == 2
    assert "left the range of the model" in capsys.readouterr().err.splitlines()[-1]


def test_what_no_truck_does_is_refused_unless_one_insists(
    truck: Packed, write: Write, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = write(TURN.format(mph=197, wheel=6600))
    packed, drive, _ = prepare(truck, load_scenario(path))
    said = "; ".join(implausible(packed, drive))
    assert "a start speed of 88 m/s" in said
    assert "turns the road wheels by 300 deg" in said
    assert main(["run", str(path), "-o", str(tmp_path / "bag")]) == 2
    assert "--yes" in capsys.readouterr().err
    status = main(["run", str(path), "-o", str(tmp_path / "bag"), "--yes"])
    assert "no vehicle of this kind does this" not in capsys.readouterr().err
    assert (tmp_path / "bag").exists() == (status == 0)


def test_shipped_scenarios_are_plausible(truck: Packed) -> None:
    packed, drive, _ = prepare(truck, load_scenario("steer_axle_blowout"))
    assert implausible(packed, drive) == ()
    assert np.isfinite(drive.inputs).all()


def test_a_recording_of_one_instant_is_refused(tmp_path: Path,
                                               capsys: pytest.CaptureFixture[str]) -> None:
    log = tmp_path / "one.csv"
    log.write_text("time_s,steering_wheel_angle_rad,tractor_vx_mps\n0.0,0.0,20.0\n")
    assert main(["compare", str(log), "-o", str(tmp_path / "out")]) == 2
    line = capsys.readouterr().err.splitlines()[-1]
    assert "lasts 0 s; expected inputs over" in line


def test_the_error_survives_another_process() -> None:
    import pickle

    again = pickle.loads(pickle.dumps(DivergedError("left", file="run", expected="less")))
    assert isinstance(again, InputError)
    assert str(again) == "run: left; expected less"


@pytest.mark.parametrize("verb", ["compare", "diagnose", "calibrate"])
def test_an_implausible_recording_is_asked_about(verb: str, tmp_path: Path,
                                                 capsys: pytest.CaptureFixture[str]) -> None:
    log = tmp_path / "fast.csv"
    rows = [f"{0.05 * k:.2f},{0.3 * k},88.0,0.0" for k in range(20)]
    log.write_text("time_s,steering_wheel_angle_rad,tractor_vx_mps,tractor_yaw_rate_radps\n"
                   + "\n".join(rows) + "\n")
    out = tmp_path / ("out.yaml" if verb == "calibrate" else "out")
    assert main([verb, str(log), "-o", str(out)]) == 2
    line = capsys.readouterr().err
    assert "no vehicle of this kind does this: " in line
    assert "a start speed of 88 m/s" in line


def test_a_car_may_be_faster_than_any_truck() -> None:
    """61 m/s on a circuit is nothing to ask about; of a truck it is."""
    drive = Drive(InitialState(speed_mps=61.0), 0.001, 10, np.zeros((10, N_INPUTS)), np.zeros(0),
                  np.zeros(0, dtype=np.int64), np.zeros(0, dtype=np.int64))
    assert implausible(pack(load_vehicle("ferrari_250lm")), drive) == ()
    assert implausible(pack(load_vehicle("international_9400i_trailmobile")), drive)


def throttled(opening: float) -> Recording:
    """A second at 20 m/s with one throttle, all else zero."""
    time_s = 0.01 * np.arange(100)
    values = dict.fromkeys(INPUT_NAMES, 0.0) | {"throttle": opening, "tractor_vx_mps": 20.0}
    return Recording("log", {n: Series(time_s, v + 0.0 * time_s) for n, v in values.items()})


@pytest.mark.parametrize("opening", [50.0, 1.2, -0.2])
def test_a_throttle_that_is_none_is_refused(truck: Packed, opening: float) -> None:
    """Beyond 1 the engine's drag would push, times a hundred if it is in per cent."""
    with pytest.raises(InputError, match=r"^log: throttle is .*; expected 0 to 1.*per cent"):
        drive_from(throttled(opening), truck.vehicle)
    with pytest.raises(InputError, match="throttle is"):
        Truck(truck).advance(Inputs(throttle=opening))
    drive = drive_from(throttled(0.0), truck.vehicle)
    drive.inputs[5, INPUT.throttle] = opening
    assert any(f"a throttle of {opening:g}" in clause for clause in implausible(truck, drive))


@pytest.mark.parametrize(("read", "meant"), [(1.03, 1.0), (-0.02, 0.0)])
def test_a_pedal_sensor_may_read_a_little_beyond_its_ends(truck: Packed, read: float, meant: float
                                                          ) -> None:
    drive = drive_from(throttled(read), truck.vehicle)
    assert (drive.inputs[:, INPUT.throttle] == meant).all()
    assert drive.initial.inputs.throttle == meant
    ends = []
    for opening in (read, meant):
        run = Truck(truck, initial=InitialState(speed_mps=20.0))
        run.advance(Inputs(throttle=opening), 20)
        ends.append(run.state)
    assert np.array_equal(ends[0], ends[1], equal_nan=True)
