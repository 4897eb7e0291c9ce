"""Small vehicle files: a shipped one with some lines put over it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.vehicle import Packed, Vehicle, load_vehicle, pack

DEFAULT = "international_9400i_trailmobile"


@pytest.fixture(scope="session")
def default_vehicle() -> Vehicle:
    return load_vehicle(DEFAULT)


@pytest.fixture(scope="session")
def packed(default_vehicle: Vehicle) -> Packed:
    return pack(default_vehicle)


@pytest.fixture
def write(tmp_path: Path) -> Callable[..., Path]:
    """Write a file into an empty folder."""

    def write_file(text: str, name: str = "mine.yaml") -> Path:
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return write_file


@pytest.fixture
def extending(write: Callable[..., Path]) -> Callable[[str], Path]:
    """Write a vehicle file that extends the default one."""
    return lambda text: write(f"extends: {DEFAULT}\n{text}")


@pytest.fixture
def refusal() -> Callable[[Path], str]:
    """Load a file that is wrong; return the one line that says so."""

    def load(path: Path) -> str:
        with pytest.raises(InputError) as caught:
            load_vehicle(path)
        line = str(caught.value)
        assert line.startswith(str(path)), line
        assert "\n" not in line
        return line

    return load
