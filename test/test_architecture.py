"""The walls of the house: who may import whom, and how large a file may grow."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = ROOT / "truck_blowout_sim"
DOORS = {"cli", "nodes", "fmu"}
ROOMS = sorted({init.parent.name for init in PACKAGE.glob("*/__init__.py")} - DOORS)
LONGEST_FILE = 400
LONGEST_FUNCTION = 60
SOURCES = ("truck_blowout_sim", "proving_ground", "benchmarks", "launch", "scripts", "test")


def source_files() -> list[Path]:
    return sorted(path for folder in SOURCES for path in (ROOT / folder).rglob("*.py"))


def functions(path: Path) -> Iterator[tuple[str, int]]:
    """Each function's name and its number of lines."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            assert node.end_lineno is not None
            yield node.name, node.end_lineno - node.lineno + 1


def test_imports_run_one_way() -> None:
    """The contracts stand in pyproject.toml under [tool.importlinter]."""
    linter = Path(sys.executable).with_name("lint-imports")
    if not linter.is_file():
        pytest.skip("import-linter is not installed")
    done = subprocess.run(
        [linter, "--config", "pyproject.toml", "--no-cache"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_below_the_nodes_imports_where_ros_is_missing(room: str) -> None:
    """Import with rclpy blocked: import-linter does not see imports made by name at run time."""
    program = (
        "import pkgutil, sys, importlib; sys.modules['rclpy'] = None\n"
        f"room = importlib.import_module('truck_blowout_sim.{room}')\n"
        "for found in pkgutil.walk_packages(room.__path__, room.__name__ + '.'):\n"
        "    importlib.import_module(found.name)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr


def test_importing_the_package_costs_nothing() -> None:
    program = (
        "import sys, truck_blowout_sim\n"
        "assert not {'numpy', 'numba', 'matplotlib', 'rclpy'} & set(sys.modules)"
    )
    subprocess.run([sys.executable, "-c", program], cwd=ROOT, check=True)


def test_every_public_name_is_there_and_listed() -> None:
    import truck_blowout_sim

    missing = [n for n in truck_blowout_sim.__all__ if not hasattr(truck_blowout_sim, n)]
    assert not missing
    assert set(truck_blowout_sim.__all__) <= set(dir(truck_blowout_sim))
    with pytest.raises(AttributeError, match="no_such_name"):
        _ = truck_blowout_sim.no_such_name


def test_no_file_outgrows_its_reader() -> None:
    sizes = {path: path.read_text(encoding="utf-8").count("\n") for path in source_files()}
    too_long = [f"{p.relative_to(ROOT)} {n}" for p, n in sizes.items() if n > LONGEST_FILE]
    assert not too_long, f"more than {LONGEST_FILE} lines: {too_long}"


def test_no_function_outgrows_a_page() -> None:
    too_long = [
        f"{path.relative_to(ROOT)} {name} {size}"
        for path in source_files()
        for name, size in functions(path)
        if size > LONGEST_FUNCTION
    ]
    assert not too_long, f"more than {LONGEST_FUNCTION} lines: {too_long}"
