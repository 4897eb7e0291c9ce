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

# Words: a folder, then the rooms. Leaves a file for each room, empty where all went well.
IMPORT_ROOMS = """
import contextlib, importlib, os, pkgutil, sys, traceback
sys.modules["rclpy"] = None
for name in ("matplotlib.pyplot", "numba", "pandas", "pyarrow", "scipy.optimize", "scipy.stats"):
    with contextlib.suppress(ImportError):
        importlib.import_module(name)
assert not [name for name in sys.modules if name.startswith("truck_blowout_sim.")]
folder, *rooms = sys.argv[1:]
for name in rooms:
    if os.fork():
        os.wait()
        continue
    try:
        room = importlib.import_module(f"truck_blowout_sim.{name}")
        for found in pkgutil.walk_packages(room.__path__, room.__name__ + "."):
            importlib.import_module(found.name)
        error = ""
    except BaseException:
        error = traceback.format_exc()
    with open(f"{folder}/{name}", "w", encoding="utf-8") as file:
        file.write(error)
    os._exit(0)
"""


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


@pytest.fixture(scope="module")
def import_errors(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """What went wrong when a room was imported with rclpy blocked; import-linter does not see
    imports made by name at run time.

    Each room has a process of its own. They are forked from one that has imported what is not ours:
    that takes most of the time.
    """
    folder = tmp_path_factory.mktemp("imported")
    subprocess.run([sys.executable, "-c", IMPORT_ROOMS, folder, *ROOMS], cwd=ROOT, check=True)
    return {path.name: path.read_text(encoding="utf-8") for path in folder.iterdir()}


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_below_the_nodes_imports_where_ros_is_missing(
    room: str, import_errors: dict[str, str]
) -> None:
    assert import_errors[room] == ""


def test_importing_the_package_costs_nothing() -> None:
    program = (
        "import sys\nbefore = set(sys.modules)\nimport truck_blowout_sim\n"
        "tops = {name.partition('.')[0] for name in set(sys.modules) - before}\n"
        "print(*tops - set(sys.stdlib_module_names))"
    )
    loaded = subprocess.run(
        [sys.executable, "-c", program], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert loaded.stdout.split() == ["truck_blowout_sim"]


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
