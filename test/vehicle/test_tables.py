"""Tables behind the parameters: the thesis's tables 9 and 10 to the digit, and the maps."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from math import radians
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.physics import layout
from truck_blowout_sim.vehicle import Packed, load_vehicle, pack
from truck_blowout_sim.vehicle.packing.formula import aligning_nm, lateral_n
from truck_blowout_sim.vehicle.packing.tables import force_map
from truck_blowout_sim.vehicle.schema.tire import TireMapSpec

THESIS = "international_9400i_trailmobile_thesis"

# time s, radius mm, stiffness N/mm, rolling resistance 1, rolling resistance h/km
TABLES_9_AND_10 = """
0    491   980   0.0041  0.0000256
0.05 471.9 700   0.01025 0.000064
0.10 452.8 500   0.0164  0.0001024
0.15 433.7 300   0.02255 0.0001408
0.20 414.6 300   0.0287  0.0001792
0.25 395.5 300   0.03485 0.0002176
0.30 376.4 3000  0.041   0.000256
0.35 357.3 10000 0.04715 0.0002944
0.40 338.2 50000 0.0533  0.0003228
0.45 319.1 90000 0.05945 0.0003712
0.50 300   98000 0.0656  0.0004096
"""


def tail(packed: Packed, offset: float) -> NDArray[np.float64]:
    return packed.params[packed.topology[layout.TOPOLOGY.table_at] + int(offset) :]


def steps(packed: Packed, tire: str) -> NDArray[np.float64]:
    table = tail(packed, packed[f"tire.{tire}.table"])
    rows, columns = int(table[0]), layout.N_STEP_COLUMNS
    return table[1 : 1 + rows * columns].reshape(rows, columns)


@pytest.fixture(scope="module")
def thesis() -> Packed:
    return pack(load_vehicle(THESIS))


def test_steps_are_as_printed(thesis: Packed) -> None:
    printed = np.array([line.split() for line in TABLES_9_AND_10.split("\n")[1:-1]], dtype=float)
    table = steps(thesis, "steer_left")
    column = layout.STEP_COLUMNS.index
    assert table[:, column("time_s")] == pytest.approx(printed[:, 0], abs=0)
    assert table[:, column("radius_m")] * 1e3 == pytest.approx(printed[:, 1], rel=1e-14)
    assert table[:, column("stiffness_npm")] / 1e3 == pytest.approx(printed[:, 2], rel=1e-14)
    assert table[:, column("rolling_0")] == pytest.approx(printed[:, 3], abs=0)
    assert table[:, column("rolling_spm")] / 3.6 == pytest.approx(printed[:, 4], rel=1e-14)
    assert table[:, column("cornering_scale")] == pytest.approx(1 - 0.09 * np.arange(11))


def test_the_misprint_of_row_8_can_be_mended(write: Callable[..., Path]) -> None:
    write("extends: thesis_steps\ntable_10_row_8: linear_series\n", "mended.yaml")
    mended = pack(load_vehicle(write(f"extends: {THESIS}\nblowout: mended.yaml\n")))
    speed = steps(mended, "steer_left")[:, layout.STEP_COLUMNS.index("rolling_spm")] / 3.6
    assert speed[8] == pytest.approx(0.0003328)
    assert speed == pytest.approx(0.0000256 * (1 + 1.5 * np.arange(11)))


def test_another_size_runs_from_its_own_radius_to_the_same_rim(thesis: Packed) -> None:
    radius = steps(thesis, "drive_1_left_outer")[:, layout.STEP_COLUMNS.index("radius_m")]
    assert radius == pytest.approx(np.linspace(0.481, 0.300, 11), abs=1e-6)


def test_equal_tires_share_a_table(thesis: Packed) -> None:
    assert thesis["tire.steer_left.table"] == thesis["tire.trailer_2_right_inner.table"]
    assert thesis["tire.steer_left.table"] != thesis["tire.drive_1_left_outer.table"]
    assert thesis["tire.steer_left.map_table"] != thesis["tire.steer_left.table"]


def test_a_map_holds_the_formula_at_its_nodes(thesis: Packed) -> None:
    table = tail(thesis, thesis["tire.steer_left.map_table"])
    n_slip, n_load = int(table[0]), int(table[1])
    size = n_slip * n_load
    side = table[4 : 4 + size].reshape(n_slip, n_load)
    moment = table[4 + size : 4 + 2 * size].reshape(n_slip, n_load)
    tire = thesis.vehicle.tire_specs["steer_left"]
    slip, load = table[2] * 4, table[3] * 5
    assert (slip, load) == pytest.approx((radians(2), 25_000))
    assert side[4, 5] == pytest.approx(lateral_n(tire, slip, load))
    assert moment[4, 5] == pytest.approx(aligning_nm(tire, slip, load))
    assert not side[0].any()
    assert not side[:, 0].any()
    assert (np.diff(side[:, 1:], axis=0) > 0)[:12].all()


def test_a_map_of_a_file_is_taken_as_it_is(thesis: Packed) -> None:
    given = TireMapSpec(
        slip_step_rad=0.1,
        load_step_n=10_000.0,
        loads=2.0,
        lateral_n=(0.0, 0.0, 0.0, 5e3, 0.0, 8e3),
        aligning_nm=(0.0, 0.0, 0.0, 100.0, 0.0, 50.0),
    )
    tire = dataclasses.replace(thesis.vehicle.tire_specs["steer_left"], map=given)
    assert force_map(tire) == [3.0, 2.0, 0.1, 1e4, *given.lateral_n, *given.aligning_nm]


def test_without_tables_nothing_follows_the_parameters(packed: Packed) -> None:
    assert packed.params.size == packed.topology[layout.TOPOLOGY.table_at]


@pytest.mark.parametrize(("name", "value", "words"), [
    ("tire.steer_left.model", 1.0, "has no force map"),
    ("tire.steer_left.law", 1.0, "no table of steps"),
    ("tire.steer_left.map_table", 1e9, "a place inside the packed vehicle"),
    ("tire.steer_left.table", -1.0, "a place inside the packed vehicle"),
])  # fmt: skip
def test_a_table_that_is_not_there_is_never_read(name: str, value: float, words: str) -> None:
    truck = pack(load_vehicle("international_9400i_trailmobile"))
    with pytest.raises(InputError, match=words):
        truck.with_values({name: value})
    mapped = pack(load_vehicle("international_9400i_trailmobile_thesis"))
    assert mapped.with_values({"tire.steer_left.model": 1.0})["tire.steer_left.model"] == 1.0
