"""The services of simulation_interfaces with stand-ins; test_real_messages.py has real ones."""

# ruff: noqa: ANN401 (stand-ins have whatever fields the adapter asks for)
from __future__ import annotations

import asyncio
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import pytest

from truck_blowout_sim.nodes.adapters import interfaces

MS = 1_000_000


class Simulator:
    """The parts of the node that the services use; time goes on by hand."""

    def __init__(self) -> None:
        self.plant = SimpleNamespace(elapsed_ns=7 * MS)
        self.paused = False
        self.done: list[str] = []

    def ready(self) -> tuple[bool, str]:
        return True, "ready"

    def step_by(self, periods: int) -> tuple[bool, str]:
        self.done += ["step"] * periods
        if self.paused:
            self.plant.elapsed_ns += 10 * MS * periods
        return self.paused, "step works while paused"

    def pause(self) -> tuple[bool, str]:
        self.paused = True
        return True, "paused"

    def resume(self) -> tuple[bool, str]:
        self.paused = False
        return True, "running"

    def reset(self) -> tuple[bool, str]:
        self.plant.elapsed_ns = 0
        self.done.append("reset")
        return True, "reset"

    def quit(self) -> tuple[bool, str]:
        self.done.append("quit")
        return True, "quit"


simulator = pytest.fixture(name="simulator")(lambda: Simulator())


class Goal:
    """A goal of the action, as rclpy hands it over."""

    def __init__(self, steps: int, cancel_after: int = 10**9) -> None:
        self.request = SimpleNamespace(steps=steps)
        self.told: list[tuple[int, int]] = []
        self.end = ""
        self._cancel_after = cancel_after

    @property
    def is_cancel_requested(self) -> bool:
        return len(self.told) >= self._cancel_after

    def publish_feedback(self, feedback: Any) -> None:
        self.told.append((feedback.completed_steps, feedback.remaining_steps))

    def __getattr__(self, name: str) -> Callable[[], None]:
        if name not in ("succeed", "abort", "canceled"):
            raise AttributeError(name)
        return lambda: setattr(self, "end", name)


@pytest.mark.parametrize(
    ("paused", "goal", "end", "steps"),
    [
        (True, Goal(3), "succeed", 3),
        (True, Goal(9, 2), "canceled", 2),
        (False, Goal(3), "abort", 0),
    ],
    ids=["done", "canceled", "not paused"],
)
def test_the_action_steps_with_feedback(
    simulator: Any, paused: bool, goal: Goal, end: str, steps: int
) -> None:
    simulator.paused = paused
    made = SimpleNamespace(
        Result=lambda: SimpleNamespace(result=SimpleNamespace(result=-1, error_message="")),
        Feedback=SimpleNamespace,
    )
    action = interfaces.StepsAction(
        simulator, SimpleNamespace(Result=Result), SimpleNamespace(SimulateSteps=made)
    )
    result = asyncio.run(action.execute(goal))
    assert goal.end == end
    wanted = goal.request.steps
    assert goal.told == [(n, wanted - n) for n in range(1, steps + 1)]
    assert (result.result.result == Result.RESULT_OK) == (end == "succeed")


class Result:
    RESULT_FEATURE_UNSUPPORTED, RESULT_OK, RESULT_NOT_FOUND = 0, 1, 2
    RESULT_INCORRECT_STATE, RESULT_OPERATION_FAILED = 3, 4


class State:
    STATE_STOPPED, STATE_PLAYING, STATE_PAUSED, STATE_QUITTING, STATE_NO_WORLD = range(5)


class Features:
    SIMULATION_RESET, SIMULATION_RESET_STATE = 20, 22
    SIMULATION_STATE_GETTING, SIMULATION_STATE_SETTING, SIMULATION_STATE_PAUSE = 24, 25, 26
    STEP_SIMULATION_SINGLE, STEP_SIMULATION_MULTIPLE, STEP_SIMULATION_ACTION = 31, 32, 33


def service(**members: dict[str, int]) -> Any:
    return SimpleNamespace(**{k: SimpleNamespace(**v) for k, v in members.items()})


@pytest.fixture
def served(monkeypatch: pytest.MonkeyPatch, install: Any, simulator: Any) -> Any:
    scopes = {"SCOPE_DEFAULT": 0, "SCOPE_TIME": 1, "SCOPE_STATE": 2, "SCOPE_ALL": 255}
    answers = {"ALREADY_IN_TARGET_STATE": 101, "INCORRECT_TRANSITION": 103}
    install(
        "simulation_interfaces",
        msg={"Result": Result, "SimulationState": State, "SimulatorFeatures": Features},
        srv={
            "GetSimulatorFeatures": service(), "GetSimulationState": service(),
            "SetSimulationState": service(Response=answers),
            "StepSimulation": service(), "ResetSimulation": service(Request=scopes),
        },
        action={"SimulateSteps": object},
    )  # fmt: skip
    monkeypatch.setattr(interfaces, "ActionServer", lambda *_, **__: None)
    services: dict[str, Callable[[Any, Any], Any]] = {}
    node = SimpleNamespace(create_service=lambda _, name, act: services.update({name: act}))
    assert interfaces.attach(node, simulator)  # type: ignore[arg-type]

    def call(name: str, **request: Any) -> Any:
        empty = SimpleNamespace(
            result=SimpleNamespace(result=-1, error_message=""),
            state=SimpleNamespace(state=-1), features=SimpleNamespace(features=[], custom_info=""),
        )  # fmt: skip
        return services[name](SimpleNamespace(**request), empty)

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


@pytest.mark.parametrize("how", ["resume and pause", "step"])
def test_a_stopped_simulator_that_went_on_is_not_stopped(
    served: Any, simulator: Any, how: str
) -> None:
    set_state(served, State.STATE_STOPPED)
    if how == "step":
        assert served("step_simulation", steps=1).result.result == Result.RESULT_OK
    else:
        simulator.resume()
        simulator.plant.elapsed_ns += MS
        simulator.pause()
    assert served("get_simulation_state").state.state == State.STATE_PAUSED
    simulator.done.clear()
    assert set_state(served, State.STATE_STOPPED) == Result.RESULT_OK
    assert simulator.done == ["reset"], "stopped means the initial state"


def test_a_refused_stop_stops_nothing(
    served: Any, simulator: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    simulator.pause()
    with monkeypatch.context() as compiling:
        compiling.setattr(simulator, "ready", lambda: (False, "being compiled"))
        assert set_state(served, State.STATE_STOPPED) == Result.RESULT_OPERATION_FAILED
    assert served("get_simulation_state").state.state == State.STATE_PAUSED


def test_interfaces_step_and_reset(served: Any, simulator: Any) -> None:
    assert served("step_simulation", steps=1).result.result == Result.RESULT_OPERATION_FAILED
    simulator.pause()
    simulator.done.clear()
    assert served("step_simulation", steps=3).result.result == Result.RESULT_OK
    assert simulator.done == ["step"] * 3
    assert served("reset_simulation", scope=0).result.result == Result.RESULT_OK
    unsupported = served("reset_simulation", scope=1).result
    assert unsupported.result == Result.RESULT_FEATURE_UNSUPPORTED
    assert "time goes on" in unsupported.error_message


def test_interfaces_list_what_they_support(served: Any) -> None:
    assert 26 in served("get_simulator_features").features.features
