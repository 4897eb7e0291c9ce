"""Trucks and small scenario files."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.simulation import load_scenario, simulate
from truck_blowout_sim.vehicle import Packed, load_vehicle, pack


@pytest.fixture(scope="session")
def truck() -> Packed:
    return pack(load_vehicle("international_9400i_trailmobile"))


@pytest.fixture
def write(tmp_path: Path) -> Callable[[str], Path]:
    def write_file(text: str) -> Path:
        path = tmp_path / "mine.yaml"
        path.write_text(text, encoding="utf-8")
        return path

    return write_file


@pytest.fixture
def refusal(write: Callable[[str], Path], truck: Packed) -> Callable[[str], str]:
    """The one line that a scenario file is refused with, on loading or on the first run."""

    def refuse(text: str) -> str:
        path = write(text)
        with pytest.raises(InputError) as caught:
            simulate(truck, load_scenario(path))
        line = str(caught.value)
        assert "\n" not in line
        assert line.startswith(str(path)), line
        return line

    return refuse
