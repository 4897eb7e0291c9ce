"""Installed by pip and built by colcon, the package brings its programs and its data along."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import zipfile
from configparser import ConfigParser
from pathlib import Path

import pytest

from truck_blowout_sim.cli.main import VERBS

ROOT = Path(__file__).resolve().parents[1]
PRESENT = {v for v, (m, _) in VERBS.items() if (ROOT / f"truck_blowout_sim/cli/{m}.py").is_file()}
PROGRAMS = {*PRESENT, "simulator", "player", "lane_keeper", "urdf", "truck-blowout"}


@pytest.fixture(scope="module")
def copy_of_source(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The source tree without what builds, tests and environments left in it."""
    source = tmp_path_factory.mktemp("workspace") / "src" / "truck_blowout_sim"
    left_behind = shutil.ignore_patterns(
        ".*", "__pycache__", "build", "install", "log", "out", "dist", "*.egg-info"
    )
    shutil.copytree(ROOT, source, ignore=left_behind)
    return source


@pytest.fixture(scope="module")
def wheel(copy_of_source: Path, tmp_path_factory: pytest.TempPathFactory) -> zipfile.ZipFile:
    folder = tmp_path_factory.mktemp("wheel")
    build = [sys.executable, "-m", "pip", "wheel", "--no-deps", "--no-build-isolation"]
    done = run([*build, "--wheel-dir", str(folder), str(copy_of_source)], cwd=folder)
    assert done.returncode == 0, done.stderr
    (path,) = folder.glob("*.whl")
    return zipfile.ZipFile(path)


@pytest.fixture(scope="module")
def workspace(copy_of_source: Path) -> Path:
    """A colcon workspace with the package built in it."""
    colcon = Path(sys.executable).with_name("colcon")
    if not colcon.is_file():
        pytest.skip("colcon is not installed")
    folder = copy_of_source.parents[1]
    done = run([str(colcon), "build"], cwd=folder)
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


def run(words: list[str], cwd: Path) -> subprocess.CompletedProcess[str]:
    environment = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "COLUMNS")}
    environment["AMENT_PREFIX_PATH"] = sys.prefix
    return subprocess.run(
        words, cwd=cwd, env=environment, capture_output=True, text=True, check=False
    )


def source_files(folder: str) -> set[str]:
    return {
        str(path.relative_to(ROOT))
        for path in (ROOT / folder).rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }


def test_the_wheel_puts_only_its_own_names_on_the_path(wheel: zipfile.ZipFile) -> None:
    (entry_points,) = (name for name in wheel.namelist() if name.endswith("entry_points.txt"))
    programs = ConfigParser()
    programs.read_string(wheel.read(entry_points).decode())
    assert sorted(programs["console_scripts"]) == [
        "truck-blowout", "truck-blowout-lane-keeper", "truck-blowout-player",
        "truck-blowout-simulator",
    ]  # fmt: skip


@pytest.mark.parametrize("folder", ["config", "launch"])
def test_the_wheel_holds_every_data_file(wheel: zipfile.ZipFile, folder: str) -> None:
    marker = ".data/data/share/truck_blowout_sim/"
    held = {name.split(marker)[1] for name in wheel.namelist() if marker in name}
    assert source_files(folder) <= held


def test_the_wheel_holds_every_module_and_what_stands_beside_it(wheel: zipfile.ZipFile) -> None:
    for package in ("truck_blowout_sim", "proving_ground"):
        assert source_files(package) <= set(wheel.namelist())


def test_ros2_run_finds_every_program(workspace: Path) -> None:
    folder = workspace / "install/truck_blowout_sim/lib/truck_blowout_sim"
    found = {path.name for path in folder.iterdir() if os.access(path, os.X_OK)}
    assert found == PROGRAMS


def test_ros2_run_finds_the_package(workspace: Path) -> None:
    share = workspace / "install/truck_blowout_sim/share"
    assert (share / "ament_index/resource_index/packages/truck_blowout_sim").is_file()
    assert (share / "truck_blowout_sim/package.xml").is_file()


def test_a_program_of_the_workspace_runs_and_finds_its_data(workspace: Path) -> None:
    program = "import truck_blowout_sim.resources as r; print(r.config_dir())"
    script = (
        ". install/setup.sh && cd / && "
        f"{workspace}/install/truck_blowout_sim/lib/truck_blowout_sim/compare --help && "
        f"{sys.executable} -c '{program}'"
    )
    done = run(["bash", "-c", script], cwd=workspace)
    assert done.returncode == 0, done.stderr
    assert "ros2 run truck_blowout_sim compare" in done.stdout
    expected = workspace / "install/truck_blowout_sim/share/truck_blowout_sim/config"
    assert done.stdout.splitlines()[-1] == str(expected)


def test_colcon_test_runs_the_tests_of_the_package(workspace: Path) -> None:
    colcon = str(Path(sys.executable).with_name("colcon"))
    done = run([colcon, "test", "--pytest-args", "test/physics/test_trig.py"], cwd=workspace)
    assert done.returncode == 0, done.stdout + done.stderr
    told = run([colcon, "test-result"], cwd=workspace)
    assert "0 errors, 0 failures, 0 skipped" in told.stdout
    assert "Summary: 0 tests" not in told.stdout


def test_metadata_agree(copy_of_source: Path) -> None:
    import truck_blowout_sim

    version = truck_blowout_sim.__version__
    assert f"<version>{version}</version>" in (copy_of_source / "package.xml").read_text()
    done = run([sys.executable, "setup.py", "--version"], cwd=copy_of_source)
    assert done.stdout.split()[-1] == version
