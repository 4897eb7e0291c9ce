"""The class inside the FMU, stepped by hand with a stand-in for pythonfmu3."""

from __future__ import annotations

import sys
from importlib import import_module
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest

SLAVE = "truck_blowout_sim.fmu.truck_slave"


class Base:
    """What pythonfmu3 gives a slave: resources, variables, a log."""

    def __init__(self, resources: Path) -> None:
        self.resources = resources
        self.logged: list[str] = []

    def register_variable(self, variable: object) -> None:
        """Known to the importing tool."""

    def log(self, words: str, *_: object) -> None:
        self.logged.append(words)


@pytest.fixture
def truck(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Any:  # noqa: ANN401
    anything = SimpleNamespace(
        independent=0, continuous=0, parameter=0, tunable=0, input=0, output=0, discard=2)
    package, experiment = ModuleType("pythonfmu3"), ModuleType("pythonfmu3.default_experiment")
    for name in ("Boolean", "Float64"):
        setattr(package, name, lambda *_, **__: None)
    for name in ("Fmi3Causality", "Fmi3Variability", "Fmi3Status"):
        setattr(package, name, anything)
    package.Fmi3Slave = Base  # type: ignore[attr-defined]
    experiment.DefaultExperiment = SimpleNamespace  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "pythonfmu3", package)
    monkeypatch.setitem(sys.modules, "pythonfmu3.default_experiment", experiment)
    monkeypatch.delitem(sys.modules, SLAVE, raising=False)
    (tmp_path / "vehicle.txt").write_text("international_9400i_trailmobile\n")
    yield import_module(SLAVE).Truck(resources=tmp_path)
    sys.modules.pop(SLAVE, None)


def test_a_truck_that_rolls_over_refuses_the_next_step_and_says_why_once(truck: Any) -> None:  # noqa: ANN401
    truck.initial_speed_mps = 27.0
    truck.exit_initialization_mode()
    truck.commands["steering_wheel_angle_rad"] = 4.7
    steps = [truck.do_step(0.1 * k, 0.1) for k in range(100)]
    assert steps[0], "it drove"
    assert not steps[-1], "it lies on its side"
    (said,) = truck.logged
    assert "rolled over" in said
    truck.commands["steering_wheel_angle_rad"] = 0.0
    truck.exit_initialization_mode()
    assert truck.do_step(0.0, 0.1), "begun again, it drives"
