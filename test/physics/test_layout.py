from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from truck_blowout_sim.physics import layout
from truck_blowout_sim.vehicle import Packed

BLOCKS = (layout.WORLD, layout.STEER, layout.COUPLING, layout.DRIVE, layout.ABS, layout.CIRCUIT,
          layout.UNIT, layout.AXLE, layout.HUB, layout.TOPOLOGY, layout.GLOBAL_S,
          layout.UNIT_S, layout.AXLE_S, layout.HUB_S, layout.TIRE_S, layout.INPUT, layout.UNIT_W)


@pytest.mark.parametrize("block", BLOCKS, ids=lambda b: type(b).__name__)
def test_a_block_numbers_its_fields(block: tuple[Any, ...]) -> None:
    assert list(block) == list(range(len(block)))


def test_every_parameter_has_one_place(truck: Packed) -> None:
    positions = list(truck.index.values())
    assert len(set(positions)) == len(positions)
    assert max(positions) < truck.topology[layout.TOPOLOGY.table_at] <= truck.params.size


def test_tires_stand_side_by_side(truck: Packed) -> None:
    for number, tire in enumerate(truck.names.tires):
        at = truck.topology[layout.TOPOLOGY.tire_at] + number
        assert truck.index[f"tire.{tire}.volume_m3"] == at + layout.TIRE.volume_m3
    assert np.diff(layout.TIRE).tolist() == [layout.TIRE_LANES] * (len(layout.TIRE) - 1)


def test_the_state_has_room_for_everything(truck: Packed) -> None:
    topo, t = truck.topology, layout.TOPOLOGY
    assert topo[t.state_axle_at] == layout.STATE_UNIT_AT + 2 * len(layout.UNIT_S)
    assert topo[t.state_hub_at] - topo[t.state_axle_at] == 5 * len(layout.AXLE_S)
    assert topo[t.state_tire_at] - topo[t.state_hub_at] == 10 * len(layout.HUB_S)
    assert topo[t.state_line_at] - topo[t.state_tire_at] == 18 * len(layout.TIRE_S)
    assert topo[t.n_state] - topo[t.state_line_at] == layout.N_CIRCUITS * topo[t.line_length]


def test_units_stand_in_the_names() -> None:
    """Every field that has a dimension says its unit; the others are pure numbers."""
    for name in (*layout.UNIT_S._fields, *layout.HUB_S._fields):
        assert name.rpartition("_")[2] in {"m", "rad", "mps", "radps", "mps2", "radps2", "pa", "j",
                                           "s", "nm", "released"}, name
