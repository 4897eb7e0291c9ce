"""Which drives can go abreast: trucks built alike, whose step takes the same branches.

References: none, this is bookkeeping.
Known limits: trucks with tables of other sizes are not alike, though they might go abreast.
Validated with: test/simulation/test_abreast.py.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.jit import PLAIN_PYTHON
from truck_blowout_sim.physics.layout import (
    ABS,
    ABS_AT,
    AXLE,
    GLOBAL_S,
    STEER,
    STEER_AT,
    TIRE,
    TOPOLOGY,
)
from truck_blowout_sim.physics.octet import EIGHT
from truck_blowout_sim.physics.places import axle_params, tire_params
from truck_blowout_sim.simulation.drive import Drive
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
FEWEST = 4  # fewer trucks are done sooner one after the other than as some of eight
_SHARED_OF_TIRE = (TIRE.model, TIRE.law, TIRE.table, TIRE.map_table)
_TABLES_OF_TIRE = (TIRE.table, TIRE.map_table)
_TABLE_HEAD = 2  # numbers before a table that say its size


def in_eights(kinds: Sequence[Hashable]) -> tuple[list[list[int]], list[int]]:
    """Numbers of what goes abreast, of each kind up to eight, and of what goes alone.

    Uncompiled, everything goes alone.
    """
    if PLAIN_PYTHON:
        return [], list(range(len(kinds)))
    eights, alone = [], []
    for kind in dict.fromkeys(kinds):
        same = [k for k, other in enumerate(kinds) if other == kind]
        for first in range(0, len(same), EIGHT):
            part = same[first:first + EIGHT]
            if len(part) < FEWEST:
                alone += part
            else:
                eights.append(part)
    return eights, alone


def kind_of(packed: Packed, drive: Drive, start: Floats | None) -> Hashable:
    """What must be the same for drives to go abreast: their `choose.shared` numbers and steps."""
    before = drive.warm if start is None else start
    # where the delay line of the brakes is written next
    position = 0.0 if before is None else float(before[GLOBAL_S.line_position])
    if not len(drive.inputs):
        return object()
    return (packed.topology.tobytes(), shared_numbers(packed), drive.step_s, drive.every,
            before is None, start is None, position)


def shared_numbers(packed: Packed) -> tuple[float, ...]:
    """Parameters that rule branches of the step."""
    p, topo = packed.params, packed.topology
    found = [p.size, p[ABS_AT + ABS.mode], p[STEER_AT + STEER.compliance_on]]
    found += [p[axle_params(topo, i) + AXLE.x_m] > 0.0 for i in range(topo[TOPOLOGY.n_axles])]
    tires = np.array([tire_params(topo, k) for k in range(topo[TOPOLOGY.n_tires])])
    laws = p[np.add.outer(tires, _SHARED_OF_TIRE)]
    tables = topo[TOPOLOGY.table_at] + p[np.add.outer(tires, _TABLES_OF_TIRE)].astype(np.int64)
    heads = np.unique(tables)[:, None] + np.arange(_TABLE_HEAD)
    # a truck without tables has nothing where they would begin
    found += [*laws.ravel(), *p[heads[heads < p.size]]]
    return tuple(float(value) for value in found)
