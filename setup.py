"""Packaging for pip and for colcon (ament_python) from one description."""

import os
import sys
from pathlib import Path

from setuptools import find_packages, setup

PACKAGE = "truck_blowout_sim"
ROOT = Path(__file__).resolve().parent
VERBS = (
    "run", "inspect", "import", "export", "compare", "diagnose", "prove", "recover", "validate",
    "vehicle", "view", "plot", "sweep", "calibrate",
)
NODES = ("simulator", "player", "lane_keeper", "urdf")


def present(verb: str) -> bool:
    """Whether the verb's module is there; `import` stands in import_.py."""
    return any((ROOT / PACKAGE / "cli" / f"{verb}{end}.py").is_file() for end in ("", "_"))


# `ros2 run` finds programs in lib/truck_blowout_sim, where setup.cfg sends them when colcon calls
# `install` or `develop`. pip puts programs on everybody's PATH, where `run` or `import` would hide
# others, so it gets the one command that holds all verbs.
for_colcon = bool({"install", "develop"} & set(sys.argv))
programs = ["truck-blowout = truck_blowout_sim.cli.start:main"]
DOORS = "truck_blowout_sim.nodes.door"
if not for_colcon:
    programs += [
        f"truck-blowout-{node.replace('_', '-')} = {DOORS}:{node}"
        for node in ("simulator", "player", "lane_keeper")
    ]
if for_colcon:
    programs += [
        f"{verb} = truck_blowout_sim.cli.main:ros2_verb" for verb in VERBS if present(verb)
    ]
    programs += [f"{node} = truck_blowout_sim.nodes.{node}:main" for node in NODES]


def shared(folder: str) -> list[tuple[str, list[str]]]:
    """Every file below a folder of the source tree, kept in its place under share/<package>."""
    found = []
    for path, folders, names in os.walk(ROOT / folder):
        folders[:] = sorted(name for name in folders if name != "__pycache__")
        place = Path(path).relative_to(ROOT)
        files = [str(place / name) for name in sorted(names) if not name.endswith(".pyc")]
        if files:
            found.append((f"share/{PACKAGE}/{place}", files))
    return found


setup(
    name=PACKAGE,
    version="0.1.0",
    description="Tire blowouts of a tractor-semitrailer: simulate, compare, diagnose; with ROS 2",
    long_description=(ROOT / "README.md").read_text(encoding="utf-8"),
    long_description_content_type="text/markdown",
    license="Apache-2.0",
    maintainer="truck_blowout_sim contributors",
    maintainer_email="truck-blowout-sim@users.noreply.github.com",
    python_requires=">=3.10",
    packages=find_packages(include=[PACKAGE, f"{PACKAGE}.*", "proving_ground", "proving_ground.*"]),
    package_data={
        PACKAGE: ["py.typed", "*/templates/*", "report/viewer/assets/*", "report/viewer/vendor/*"],
        "proving_ground": ["*.yaml", "sealed/*"],
    },
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml"]),
        *shared("config"),
        *shared("launch"),
    ],
    entry_points={
        "console_scripts": programs,
        # the verbs `truck-blowout simulator` and `player` find the nodes here, not by import
        "truck_blowout_sim.nodes": [f"{node} = {DOORS}:{node}" for node in ("simulator", "player")],
    },
    install_requires=[
        "jinja2>=3.0",
        "matplotlib>=3.5",
        "mcap>=1.1",
        "numba>=0.57",
        "threadpoolctl>=3.1",
        "numpy>=1.22",
        "pyarrow>=12",
        "pyyaml>=5.4",
        "rich>=12",
        "rosbags>=0.10",
        "scipy>=1.8",
        "typer>=0.9",
        "zstandard>=0.21",
        "lz4>=4.0",
    ],
    extras_require={
        "ros": [
            "catkin-pkg",
            "ros-rclpy[fastrtps]",
            "ros-ament-index-python",
            "ros-builtin-interfaces",
            "ros-diagnostic-msgs",
            "ros-geometry-msgs",
            "ros-nav-msgs",
            "ros-rosgraph-msgs",
            "ros-sensor-msgs",
            "ros-std-msgs",
            "ros-std-srvs",
            "ros-visualization-msgs",
        ],
        "mdf": ["asammdf>=7.4"],
        "mat73": ["h5py>=3.6"],
        "frames": ["pandas>=1.5", "xarray>=2022.6"],
        "logs": ["asammdf>=7.4", "h5py>=3.6", "pandas>=1.5", "xarray>=2022.6"],
        "fmu": ["pythonfmu3>=0.3"],
        "prove": ["commonroad-vehicle-models>=3.0", "mujoco>=3.1", "pysindy>=2.0"],
        "dask": ["distributed>=2023.1"],
        "test": [
            "asammdf>=7.4",
            "h5py>=3.6",
            "xarray>=2022.6",
            "distributed>=2023.1",
            "hypothesis",
            "import-linter",
            "mcap-ros2-support",
            "mypy",
            "psutil",
            "pytest",
            "pytest-timeout",
            "pytest-xdist",
            "ruff",
            "types-PyYAML",
        ],
    },
    zip_safe=False,
    classifiers=[
        "Intended Audience :: Science/Research",
        "Programming Language :: Python :: 3",
        "Programming Language :: Python :: 3.10",
        "Programming Language :: Python :: 3.11",
        "Programming Language :: Python :: 3.12",
        "Programming Language :: Python :: 3.13",
        "Topic :: Scientific/Engineering",
        "Typing :: Typed",
    ],
)
