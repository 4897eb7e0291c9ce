"""Adapters, with stand-in messages: the packages of the real ones are not on PyPI."""

# ruff: noqa: ANN401 (stand-ins have whatever fields the adapter asks for)
from __future__ import annotations

import sys
from collections.abc import Callable
from types import ModuleType, SimpleNamespace
from typing import Any

import numpy as np
import pytest

from truck_blowout_sim import InitialState, load_vehicle
from truck_blowout_sim.nodes.adapters import ackermann, attach_all, autoware, interfaces
from truck_blowout_sim.nodes.inputs import InputBank
from truck_blowout_sim.nodes.plant import Plant
from truck_blowout_sim.nodes.simulator_parameters import SPECS, inputs_of

RATIO = 22.0
DEFAULTS: dict[str, Any] = {spec.name: spec.default for spec in SPECS}


class Topic:
    """Takes commands as `CommandTopic` does, without a subscription."""

    def __init__(self, guarded: Any) -> None:
        self.guarded = guarded

    def take(self, value: float) -> None:
        assert self.guarded.offer(value, 0) == ""


class Simulator:
    """The parts of the node that adapters use."""

    def __init__(self) -> None:
        vehicle = load_vehicle("international_9400i_trailmobile")
        bank = InputBank(inputs_of(DEFAULTS))
        self.plant = Plant(vehicle, 0.001, InitialState(speed_mps=20.0), bank)
        self.commands = [Topic(one) for one in bank.inputs]
        self.reports: list[Callable[[int], None]] = []
        self.outputs = SimpleNamespace(also=self.reports.append)
        self.paused = False
        self.done: list[str] = []

    def __getattr__(self, name: str) -> Callable[[], tuple[bool, str]]:
        if name not in ("step", "reset", "quit"):
            raise AttributeError(name)

        def act() -> tuple[bool, str]:
            self.done.append(name)
            return True, name

        return act

    def pause(self) -> tuple[bool, str]:
        self.paused = True
        return True, "paused"

    def resume(self) -> tuple[bool, str]:
        self.paused = False
        return True, "running"

    @property
    def applied(self) -> dict[str, float]:
        bank = self.plant.bank
        return {i.name: v for i, v in zip(bank.inputs, bank.applied(0), strict=True)}


class Node:
    """Keeps what is created, so that the test can play the other side."""

    def __init__(self) -> None:
        self.taken: dict[str, Callable[[Any], None]] = {}
        self.sent: dict[str, list[Any]] = {}
        self.served: dict[str, Callable[[Any, Any], Any]] = {}

    def resolve_topic_name(self, topic: str) -> str:
        return topic

    def create_subscription(self, _: type, topic: str, callback: Any, *__: Any, **___: Any) -> None:
        self.taken[topic] = callback

    def create_publisher(self, _: type, topic: str, *__: Any, **___: Any) -> SimpleNamespace:
        return SimpleNamespace(publish=self.sent.setdefault(topic, []).append)

    def create_service(self, _: type, name: str, callback: Any) -> None:
        self.served[name] = callback


def install(monkeypatch: pytest.MonkeyPatch, package: str, **modules: dict[str, Any]) -> None:
    top = ModuleType(package)
    monkeypatch.setitem(sys.modules, package, top)
    for name, members in modules.items():
        module = ModuleType(f"{package}.{name}")
        for key, value in members.items():
            setattr(module, key, value)
        setattr(top, name, module)
        monkeypatch.setitem(sys.modules, f"{package}.{name}", module)


simulator = pytest.fixture(name="simulator")(lambda: Simulator())
node = pytest.fixture(name="node")(lambda: Node())


def test_nothing_is_active_without_the_packages(node: Any, simulator: Any) -> None:
    assert attach_all(node, simulator) == ()
    assert not node.taken
    assert not node.served


def test_ackermann_steers_by_the_ratio_and_accelerates(
    monkeypatch: pytest.MonkeyPatch, node: Any, simulator: Any
) -> None:
    install(monkeypatch, "ackermann_msgs", msg={"AckermannDriveStamped": object})
    assert ackermann.attach(node, simulator)
    drive = SimpleNamespace(steering_angle=0.05, speed=22.0, acceleration=0.0)
    node.taken["ackermann_cmd"](SimpleNamespace(drive=drive))
    applied = simulator.applied
    assert applied["steering_wheel_angle_rad"] == pytest.approx(0.05 * RATIO)
    assert 0.5 < applied["throttle"] <= 1.0
    assert applied["brake_pressure_trailer_pa"] == 0.0


def test_ackermann_brakes_all_circuits_to_slow_down(
    monkeypatch: pytest.MonkeyPatch, node: Any, simulator: Any
) -> None:
    install(monkeypatch, "ackermann_msgs", msg={"AckermannDriveStamped": object})
    ackermann.attach(node, simulator)
    drive = SimpleNamespace(steering_angle=0.0, speed=15.0, acceleration=-1.0)
    node.taken["ackermann_cmd"](SimpleNamespace(drive=drive))
    applied = simulator.applied
    assert applied["throttle"] == 0.0
    pressures = {v for name, v in applied.items() if name.startswith("brake")}
    assert len(pressures) == 1
    assert 1e5 < pressures.pop() < 1e6


class Report(SimpleNamespace):
    """A message whose header and stamp can be set."""

    def __init__(self) -> None:
        super().__init__(
            header=SimpleNamespace(frame_id="", stamp=SimpleNamespace(sec=0, nanosec=0)),
            stamp=SimpleNamespace(sec=0, nanosec=0),
        )


def test_autoware_takes_control_and_gives_reports(
    monkeypatch: pytest.MonkeyPatch, node: Any, simulator: Any
) -> None:
    install(monkeypatch, "autoware_control_msgs", msg={"Control": object})
    install(
        monkeypatch, "autoware_vehicle_msgs",
        msg={"SteeringReport": Report, "VelocityReport": Report},
    )  # fmt: skip
    assert autoware.attach(node, simulator)
    along = SimpleNamespace(velocity=20.0, acceleration=5.0, is_defined_acceleration=False)
    node.taken["/control/command/control_cmd"](
        SimpleNamespace(lateral=SimpleNamespace(steering_tire_angle=-0.02), longitudinal=along)
    )
    applied = simulator.applied
    assert applied["steering_wheel_angle_rad"] == pytest.approx(-0.02 * RATIO)
    # an acceleration that is not defined is none
    assert applied["throttle"] < 0.6
    simulator.reports[0](1_500_000_000)
    (speed,) = node.sent["/vehicle/status/velocity_status"]
    assert speed.longitudinal_velocity == pytest.approx(20.0, abs=0.01)
    assert (speed.header.stamp.sec, speed.header.stamp.nanosec) == (1, 500_000_000)
    (steer,) = node.sent["/vehicle/status/steering_status"]
    assert abs(steer.steering_tire_angle) < 0.01
    assert np.isfinite(speed.heading_rate)


class Result:
    RESULT_FEATURE_UNSUPPORTED, RESULT_OK, RESULT_NOT_FOUND = 0, 1, 2
    RESULT_INCORRECT_STATE, RESULT_OPERATION_FAILED = 3, 4


class State:
    STATE_STOPPED, STATE_PLAYING, STATE_PAUSED, STATE_QUITTING, STATE_NO_WORLD = range(5)


class Features:
    SIMULATION_RESET, SIMULATION_RESET_STATE = 20, 22
    SIMULATION_STATE_GETTING, SIMULATION_STATE_SETTING, SIMULATION_STATE_PAUSE = 24, 25, 26
    STEP_SIMULATION_SINGLE, STEP_SIMULATION_MULTIPLE = 31, 32


def service(**members: dict[str, int]) -> Any:
    return SimpleNamespace(**{k: SimpleNamespace(**v) for k, v in members.items()})


@pytest.fixture
def served(monkeypatch: pytest.MonkeyPatch, node: Any, simulator: Any) -> Any:
    scopes = {"SCOPE_DEFAULT": 0, "SCOPE_TIME": 1, "SCOPE_STATE": 2, "SCOPE_ALL": 255}
    answers = {"ALREADY_IN_TARGET_STATE": 101, "INCORRECT_TRANSITION": 103}
    install(
        monkeypatch, "simulation_interfaces",
        msg={"Result": Result, "SimulationState": State, "SimulatorFeatures": Features},
        srv={
            "GetSimulatorFeatures": service(), "GetSimulationState": service(),
            "SetSimulationState": service(Response=answers),
            "StepSimulation": service(), "ResetSimulation": service(Request=scopes),
        },
    )  # fmt: skip
    assert interfaces.attach(node, simulator)

    def call(name: str, **request: Any) -> Any:
        empty = SimpleNamespace(
            result=SimpleNamespace(result=-1, error_message=""),
            state=SimpleNamespace(state=-1), features=SimpleNamespace(features=[], custom_info=""),
        )  # fmt: skip
        return node.served[name](SimpleNamespace(**request), empty)

    return call


def set_state(served: Any, state: int) -> int:
    return int(served("set_simulation_state", state=SimpleNamespace(state=state)).result.result)


def test_interfaces_play_pause_and_stop(served: Any, simulator: Any) -> None:
    assert served("get_simulation_state").state.state == State.STATE_PLAYING
    assert set_state(served, State.STATE_PLAYING) == 101
    assert set_state(served, State.STATE_PAUSED) == Result.RESULT_OK
    assert served("get_simulation_state").state.state == State.STATE_PAUSED
    assert set_state(served, State.STATE_STOPPED) == Result.RESULT_OK
    assert simulator.done == ["reset"]
    assert served("get_simulation_state").state.state == State.STATE_STOPPED
    assert set_state(served, State.STATE_PAUSED) == 103
    assert set_state(served, State.STATE_PLAYING) == Result.RESULT_OK
    assert not simulator.paused
    assert set_state(served, State.STATE_NO_WORLD) == Result.RESULT_FEATURE_UNSUPPORTED
    assert set_state(served, State.STATE_QUITTING) == Result.RESULT_OK
    assert simulator.done == ["reset", "quit"]


def test_interfaces_step_and_reset(served: Any, simulator: Any) -> None:
    assert served("step_simulation", steps=3).result.result == Result.RESULT_OK
    assert simulator.done == ["step"] * 3
    assert served("reset_simulation", scope=0).result.result == Result.RESULT_OK
    unsupported = served("reset_simulation", scope=1).result
    assert unsupported.result == Result.RESULT_FEATURE_UNSUPPORTED
    assert "time goes on" in unsupported.error_message


def test_interfaces_list_what_they_support(served: Any) -> None:
    assert 26 in served("get_simulator_features").features.features
