"""Launch files: arguments explain themselves, nodes and parameters exist.

launch and launch_ros are not on PyPI: without them, stand-ins keep what the files ask for.
"""

# ruff: noqa: ANN401 (stand-ins take whatever the launch files give them)
from __future__ import annotations

import runpy
import sys
from pathlib import Path
from types import ModuleType
from typing import Any, ClassVar

import pytest
import yaml

from truck_blowout_sim.nodes import lane_keeper_node as lane_keeper
from truck_blowout_sim.nodes import player_parameters, simulator_parameters

ROOT = Path(__file__).resolve().parents[2]
FILES = ("simulator", "replay", "closed_loop", "autoware")
PARAMETERS = {
    "simulator": {spec.name for spec in simulator_parameters.SPECS} | {"use_sim_time"},
    "player": {spec.name for spec in player_parameters.SPECS} | {"use_sim_time"},
    "lane_keeper": {spec.name for spec in lane_keeper.SPECS} | {"use_sim_time"},
}


class Asked:
    """A stand-in for anything of launch: keeps its arguments."""

    def __init__(self, *words: Any, **options: Any) -> None:
        self.words, self.options = words, options


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> dict[str, list[Asked]]:
    """What the launch files construct, by class name."""
    made: dict[str, list[Asked]] = {}

    class Module(ModuleType):
        __path__: ClassVar[list[str]] = []

        def __getattr__(self, name: str) -> type[Asked]:
            if name.startswith("__"):
                raise AttributeError(name)

            class Kept(Asked):
                def __init__(self, *words: Any, **options: Any) -> None:
                    super().__init__(*words, **options)
                    made.setdefault(name, []).append(self)

            return Kept

    names = (
        "launch", "launch.actions", "launch.conditions", "launch.events", "launch.event_handlers",
        "launch.launch_description_sources", "launch.substitutions", "launch_ros",
        "launch_ros.actions", "launch_ros.parameter_descriptions", "launch_ros.substitutions",
    )  # fmt: skip
    for name in names:
        monkeypatch.setitem(sys.modules, name, Module(name))
    return made


def load(name: str) -> None:
    path = ROOT / "launch" / f"{name}.launch.py"
    runpy.run_path(str(path))["generate_launch_description"]()


@pytest.mark.parametrize("name", FILES)
def test_every_argument_has_a_default_and_is_explained(
    asked: dict[str, list[Asked]], name: str
) -> None:
    load(name)
    arguments = asked["DeclareLaunchArgument"]
    assert arguments
    for argument in arguments:
        assert "default_value" in argument.options
        assert argument.options["description"].endswith((".", "]."))


@pytest.mark.parametrize("name", FILES)
def test_every_argument_that_is_used_is_declared(asked: dict[str, list[Asked]], name: str) -> None:
    load(name)
    declared = {argument.words[0] for argument in asked["DeclareLaunchArgument"]}
    used = {one.words[0] for one in asked["LaunchConfiguration"]}
    assert used == declared


@pytest.mark.parametrize("name", FILES)
def test_nodes_and_their_parameters_exist(asked: dict[str, list[Asked]], name: str) -> None:
    load(name)
    ours = [n for n in asked["Node"] if n.options["package"] == "truck_blowout_sim"]
    assert ours or name == "autoware"  # which starts its own by including
    for node in ours:
        known = PARAMETERS[node.options["executable"]]
        for group in node.options["parameters"]:
            if isinstance(group, dict):
                assert set(group) <= known


@pytest.mark.parametrize("name", FILES)
def test_headless_unless_asked(asked: dict[str, list[Asked]], name: str) -> None:
    load(name)
    (rviz,) = (a for a in asked["DeclareLaunchArgument"] if a.words[0] == "rviz")
    assert rviz.options["default_value"] == "false"


def test_included_files_declare_the_arguments_they_are_given(
    asked: dict[str, list[Asked]],
) -> None:
    load("simulator")
    declared = {argument.words[0] for argument in asked["DeclareLaunchArgument"]}
    for name in ("replay", "closed_loop", "autoware"):
        load(name)
    given = [{key for key, _ in include.options["launch_arguments"]}
             for include in asked["IncludeLaunchDescription"]]
    assert len(given) == 3
    assert all(given)
    assert set().union(*given) <= declared


@pytest.mark.parametrize("path", sorted((ROOT / "config" / "nodes").glob("*.yaml")), ids=str)
def test_shipped_parameter_files_name_parameters_that_exist(path: Path) -> None:
    tree = yaml.safe_load(path.read_text())["/**"]["ros__parameters"]

    def names(branch: dict[str, Any], prefix: str = "") -> set[str]:
        found: set[str] = set()
        for key, value in branch.items():
            if key == "qos_overrides":
                continue
            found |= names(value, f"{prefix}{key}.") if isinstance(value, dict) else {prefix + key}
        return found

    assert names(tree) <= PARAMETERS["simulator"]
