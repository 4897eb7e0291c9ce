"""Signs that a proposal takes from a compass, and from what goes together in a turn."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim.recordings.logs.log import Column, Table
from truck_blowout_sim.recordings.mapping.proposing import Proposal, propose

TIMES = 0.05 * np.arange(400)
RATE_DEGPS = 5.0 * np.sin(TIMES)  # left positive
TURNED_DEG = 5.0 * (1.0 - np.cos(TIMES))
SPEED_MPS = 20.0
LATERAL_MPS2 = SPEED_MPS * np.radians(RATE_DEGPS)
COMPASS_DEG = (10.0 - 3.0 * TURNED_DEG) % 360.0  # crosses north
LEFT, RIGHT = 1.0, -1.0


def found(right_positive: bool, heading: str = "", heading_deg: np.ndarray | None = None,
          **more: np.ndarray) -> dict[str, Proposal]:  # fmt: skip
    """Proposals for a turn, in axes with y to the left, or to the right."""
    side = RIGHT if right_positive else LEFT
    columns = {
        "speed": Column(np.full(TIMES.size, SPEED_MPS), "m/s"),
        "yawrate": Column(side * 3.0 * RATE_DEGPS, "deg/s"),
        "latacc": Column(side * 3.0 * LATERAL_MPS2, "m/s2"),
        "steering": Column(side * 40.0 * np.sin(TIMES), "deg"),
        **{name: Column(values) for name, values in more.items()},
    }
    if heading_deg is not None:
        columns[heading] = Column(heading_deg, "deg")
    proposals = propose(Table(Path("log"), "text", columns), time_s=TIMES)
    return {p.channel.removeprefix("tractor_"): p for p in proposals}


@pytest.mark.parametrize("name", ["heading", "course", "cog", "Track angle", "Kurs"])
@pytest.mark.parametrize("right_positive", [False, True])
def test_a_compass_tells_which_side_is_positive(name: str, right_positive: bool) -> None:
    """It counts clockwise: a yaw rate that goes with it counts to the right."""
    proposals = found(right_positive, name, COMPASS_DEG)
    side = RIGHT if right_positive else LEFT
    signs = {stem: p.sign for stem, p in proposals.items()}
    assert signs == {"vx_mps": 1.0, "yaw_rate_radps": side, "ay_mps2": side,
                     "steering_wheel_angle_rad": side, "yaw_rad": -1.0}  # fmt: skip
    assert proposals["yaw_rad"].offset == -90.0
    if right_positive:
        assert any("compass" in why for why in proposals["yaw_rate_radps"].why)


@pytest.mark.parametrize(("numbers", "sign"), [(TURNED_DEG - 90.0, 1.0), (90.0 - TURNED_DEG, -1.0)])
def test_a_yaw_angle_goes_with_the_yaw_rate(numbers: np.ndarray, sign: float) -> None:
    yaw = found(False, "yaw", 3.0 * numbers)["yaw_rad"]
    assert (yaw.sign, yaw.offset) == (sign, 0.0)


def test_a_heading_that_turns_left_is_no_compass_where_gravity_points_up() -> None:
    up = {"az": np.full(TIMES.size, 9.81)}
    proposals = found(False, "heading", 3.0 * TURNED_DEG, **up)
    assert {p.sign for p in proposals.values()} == {1.0}
    assert proposals["yaw_rad"].offset == 0.0


def test_a_lateral_acceleration_against_the_turn_is_turned_over() -> None:
    columns = {
        "speed": Column(np.full(TIMES.size, SPEED_MPS), "m/s"),
        "yawrate": Column(3.0 * RATE_DEGPS, "deg/s"), "latacc": Column(-3.0 * LATERAL_MPS2, "m/s2"),
    }  # fmt: skip
    proposals = propose(Table(Path("log"), "text", columns), time_s=TIMES)
    signs = {p.column: p.sign for p in proposals}
    assert signs == {"speed": 1.0, "yawrate": 1.0, "latacc": -1.0}


def test_a_northing_stays_where_axes_point_down() -> None:
    down = {"az": np.full(TIMES.size, -9.81), "easting": np.cumsum(TIMES),
            "northing": np.cumsum(TIMES)}  # fmt: skip
    proposals = found(True, **down)
    assert proposals["y_m"].sign == 1.0
    assert proposals["az_mps2"].sign == -1.0
