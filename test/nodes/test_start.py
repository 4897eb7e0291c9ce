"""Starting: the doors, what is there while the model is being compiled, early signals."""

# ruff: noqa: ANN401 (fixtures come from rclpy's tests, which have no types)
from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from std_msgs.msg import String
from std_srvs.srv import Trigger

from truck_blowout_sim import load_vehicle
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.nodes import blow_schedule
from truck_blowout_sim.nodes.blow_schedule import BlowSchedule
from truck_blowout_sim.nodes.clock import NS
from truck_blowout_sim.nodes.inputs import InputBank
from truck_blowout_sim.nodes.plant import Plant
from truck_blowout_sim.nodes.signals import CAUGHT, Interrupted
from truck_blowout_sim.nodes.simulator_parameters import (
    DEFAULT_VEHICLE,
    SPECS,
    flat_of,
    inputs_of,
)
from truck_blowout_sim.nodes.steering_gear import _gear
from truck_blowout_sim.simulation import InitialState

ROOT = Path(__file__).resolve().parents[2]

# A compiler that takes its time, without keeping the machine busy.
SLOW = """
import time
from truck_blowout_sim.nodes import door, plant
build = plant.Plant.build
plant.Plant.build = lambda self: (time.sleep({seconds}), build(self))
raise SystemExit(door.open_node("simulator"))
"""


def test_topics_and_services_exist_while_the_model_is_compiled(
    start: Any, client: Any, tmp_path: Path
) -> None:
    (tmp_path / "slow.py").write_text(SLOW.format(seconds=4))
    node = start.program(sys.executable, tmp_path / "slow.py", "--blow", "steer_left@0.5")
    refused = client.call(Trigger, "/truck/blowout/steer_left")
    assert not refused.success
    assert "being compiled" in refused.message
    assert not client.call(Trigger, "/truck/ready").success
    assert "ready" not in node.output.split("loading")[1].split("(")[0]
    state = client.first(DiagnosticArray, "/diagnostics").status[0]
    assert "being compiled" in state.message
    node.wait_for("; ready")
    assert client.call(Trigger, "/truck/ready").success
    # counted from readiness, in simulated time
    assert client.first(String, "/truck/blowout", client.latched).data == "steer_left"
    node.wait_for("steer_left blown at 0.500 s", 10.0)
    assert node.stop() == 0


def test_a_signal_ends_a_node_that_is_still_compiling(start: Any, tmp_path: Path) -> None:
    (tmp_path / "slow.py").write_text(SLOW.format(seconds=60))
    node = start.program(sys.executable, tmp_path / "slow.py")
    node.wait_for("loading")
    began_s = time.monotonic()
    assert node.stop(signal.SIGTERM) == 0
    assert time.monotonic() - began_s < 10
    assert "Traceback" not in node.output


@pytest.mark.parametrize("after_s", [0.3, 0.8])
def test_ctrl_c_in_the_first_second_leaves_no_traceback(start: Any, after_s: float) -> None:
    node = start("simulator")
    time.sleep(after_s)
    status = node.stop(signal.SIGINT)
    assert "Traceback" not in node.output
    assert status in (0, -signal.SIGINT)  # the latter before Python itself is up


def test_an_interruption_that_an_import_wraps_in_an_error_is_still_one(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from truck_blowout_sim.nodes import door

    def wrap(_: str) -> None:
        # as Python 3.11 does with what is raised in __set_name__
        try:
            signal.raise_signal(signal.SIGINT)
        except Interrupted as error:
            raise RuntimeError("Error calling __set_name__") from error

    handlers = {number: signal.getsignal(number) for number in CAUGHT}
    monkeypatch.setattr(door, "import_module", wrap)
    try:
        assert door.open_node("player", []) == 0
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)
    assert capsys.readouterr().err == "player: SIGINT while starting\n"


@pytest.mark.parametrize("name", ["simulator", "player"])
def test_the_verb_starts_the_node_and_keeps_to_this_machine(name: str) -> None:
    program = Path(sys.executable).with_name("truck-blowout")
    environment = {k: v for k, v in os.environ.items() if k != "ROS_AUTOMATIC_DISCOVERY_RANGE"}
    shown = subprocess.run(
        [program, name, "--help"], env=environment, capture_output=True, text=True, check=False
    )
    assert shown.returncode == 0, shown.stderr
    assert "--ros-args -p name:=value" in shown.stdout
    unknown = subprocess.run(
        [program, name, "--ros-args", "-p", "rate"], capture_output=True, text=True, check=False
    )
    assert unknown.returncode == 2
    assert unknown.stderr.strip().splitlines()[-1].startswith(f"{name}: ")
    assert "Traceback" not in unknown.stderr


def test_doors_restrict_discovery_unless_the_environment_says_more(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    from truck_blowout_sim.nodes import door

    opened: list[str] = []
    monkeypatch.setattr(door, "open_node", lambda name, _: opened.append(name) or 0)
    monkeypatch.delenv(door.DISCOVERY, raising=False)
    assert door.player() == 0
    assert os.environ[door.DISCOVERY] == "LOCALHOST"
    monkeypatch.setenv(door.DISCOVERY, "SUBNET")
    assert door.simulator() == 0
    assert os.environ[door.DISCOVERY] == "SUBNET"
    assert opened == ["player", "simulator"]


def test_a_schedule_gives_each_blowout_once_a_run() -> None:
    plan = blow_schedule.parse("b@2.5, a@1", {"a", "b"})
    schedule = BlowSchedule(plan)
    assert list(schedule.due(999_999_999)) == []
    assert list(schedule.due(3_000_000_000)) == ["a", "b"]
    assert list(schedule.due(9_000_000_000)) == []
    schedule.restart()
    schedule.replace(plan, 1_500_000_000)
    assert list(schedule.due(9_000_000_000)) == ["b"]


@pytest.mark.parametrize("text", ["a", "a@", "a@-1", "a@nan", "c@1", "a@inf", "a@1e300"])
def test_a_schedule_that_cannot_be_is_refused(text: str) -> None:
    with pytest.raises(InputError, match=f"'{text}' is no blowout of this vehicle"):
        blow_schedule.parse(text, {"a", "b"})


@pytest.mark.parametrize("text", ["steer_left@-1", "steer_left@1e300", "steer_left@nan"])
def test_a_tire_that_cannot_have_burst_before_is_refused(text: str) -> None:
    with pytest.raises(InputError, match=f"^parameter, initial_flat: '{text}'"):
        flat_of(text)


def test_a_flat_start_stays_before_a_followed_clock_that_begins_late() -> None:
    bank = InputBank(inputs_of({spec.name: spec.default for spec in SPECS}))
    flat = InitialState(flat=(("steer_left", 2.0),))
    plant = Plant(load_vehicle(DEFAULT_VEHICLE), 0.001, flat, bank)
    plant.move_to(1_000_000 * NS)
    assert plant.blown_ns == {"steer_left": 999_998 * NS}


@pytest.mark.parametrize("curve", [0.0, 0.6, -0.6])
def test_the_steering_gear_turns_around(curve: float) -> None:
    for road_rad in (-0.4, -0.01, 0.0, 0.3):
        gear = _gear(road_rad, curve)
        assert gear * (1 + curve * gear**2) == pytest.approx(road_rad, abs=1e-12)
