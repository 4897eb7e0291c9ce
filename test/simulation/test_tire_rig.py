"""Maps of the tire rig: slope, load, and what becomes of them without air."""

from __future__ import annotations

import numpy as np
import pytest

from truck_blowout_sim import load_vehicle, pack
from truck_blowout_sim.simulation.tire_rig import TireMap, tire_map

SLIP, LOAD = np.radians([0.0, 1.0, 4.0, 10.0]), np.array([0.0, 9_810.0, 25_400.0])
SHEETS = ("international_9400i_trailmobile", "international_9400i_trailmobile_thesis")


@pytest.fixture(scope="module")
def maps() -> dict[tuple[str, bool], TireMap]:
    return {(name, flat): tire_map(pack(load_vehicle(name)), "steer_left", flat=flat,
                                   slip_rad=SLIP, load_n=LOAD)
            for name in SHEETS for flat in (False, True)}  # fmt: skip


def test_the_sound_tire_gives_the_forces_of_its_data(maps: dict[tuple[str, bool], TireMap]) -> None:
    """Acceptance table of the tire set (docs/physics.md): kN and N m at 1, 4 and 10 deg."""
    found = maps[SHEETS[0], False]
    assert found.lateral_n[1:, 2] == pytest.approx([2860, 10_400, 18_100], rel=0.02)
    assert found.aligning_nm[1:3, 2] == pytest.approx([104, 307], rel=0.03)
    assert found.lateral_n[1:, 1] == pytest.approx([1190, 4310, 7380], rel=0.04)


def test_neither_slip_nor_load_no_force(maps: dict[tuple[str, bool], TireMap]) -> None:
    for found in maps.values():
        assert not found.lateral_n[0].any()
        assert not found.lateral_n[:, 0].any()


def test_the_thesis_divides_the_flat_tires_force_by_ten(
    maps: dict[tuple[str, bool], TireMap]
) -> None:
    sound, flat = maps[SHEETS[1], False], maps[SHEETS[1], True]
    assert flat.lateral_n[1:, 1:] == pytest.approx(0.1 * sound.lateral_n[1:, 1:])
