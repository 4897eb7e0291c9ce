"""Where each block of a truck stands in its vectors: state, parameters, working memory.

Names for the arithmetic of the topology; the compiler folds them into the address.

References: none, this is bookkeeping.
Known limits: see layout.py.
Validated with: test/physics/test_places.py.
"""

from __future__ import annotations

import numpy as np
from numba.extending import register_jitable
from numpy.typing import NDArray

from truck_blowout_sim.physics.layout import (
    AXLE_S,
    AXLE_SIZE,
    HUB_S,
    HUB_SIZE,
    STATE_UNIT_AT,
    TIRE_S,
    TOPOLOGY,
    TOPOLOGY_AXLE_SIZE,
    TOPOLOGY_SIZE,
    UNIT_AT,
    UNIT_S,
    UNIT_SIZE,
    UNIT_WORK_SIZE,
)
from truck_blowout_sim.physics.tires.lanes import tire_offset

Integers = NDArray[np.int64]


@register_jitable
def unit_of(topo: Integers, axle: int) -> int:
    """Number of the unit that an axle carries."""
    return topo[TOPOLOGY_SIZE + axle * TOPOLOGY_AXLE_SIZE]


@register_jitable
def circuit_of(topo: Integers, axle: int) -> int:
    """Number of the brake circuit of an axle."""
    return topo[TOPOLOGY_SIZE + axle * TOPOLOGY_AXLE_SIZE + 1]


@register_jitable
def partner_of(topo: Integers, axle: int) -> int:
    """Number of the axle that one is equalized with; -1: none."""
    return topo[TOPOLOGY_SIZE + axle * TOPOLOGY_AXLE_SIZE + 2]


@register_jitable
def hub_of(topo: Integers, tire: int) -> int:
    """Number of the hub that a tire stands on."""
    return topo[TOPOLOGY_SIZE + topo[TOPOLOGY.n_axles] * TOPOLOGY_AXLE_SIZE + tire]


@register_jitable
def hub_at_side(axle: int, side: int) -> int:
    """Number of an axle's hub: ``side`` 0 left, 1 right."""
    return 2 * axle + side


@register_jitable
def unit_state(unit: int) -> int:
    """Place of a unit's first state, `UNIT_S`."""
    return STATE_UNIT_AT + unit * len(UNIT_S)


@register_jitable
def unit_params(unit: int) -> int:
    """Place of a unit's first parameter, `UNIT`."""
    return UNIT_AT + unit * UNIT_SIZE


@register_jitable
def unit_work(unit: int) -> int:
    """Place of a unit's working memory, `UNIT_W`."""
    return unit * UNIT_WORK_SIZE


@register_jitable
def axle_state(topo: Integers, axle: int) -> int:
    """Place of an axle's first state, `AXLE_S`."""
    return topo[TOPOLOGY.state_axle_at] + axle * len(AXLE_S)


@register_jitable
def axle_params(topo: Integers, axle: int) -> int:
    """Place of an axle's first parameter, `AXLE`."""
    return topo[TOPOLOGY.axle_at] + axle * AXLE_SIZE


@register_jitable
def hub_state(topo: Integers, hub: int) -> int:
    """Place of a hub's first state, `HUB_S`."""
    return topo[TOPOLOGY.state_hub_at] + hub * len(HUB_S)


@register_jitable
def hub_params(topo: Integers, hub: int) -> int:
    """Place of a hub's first parameter, `HUB`."""
    return topo[TOPOLOGY.hub_at] + hub * HUB_SIZE


@register_jitable
def tire_state(topo: Integers, tire: int) -> int:
    """Place of a tire's first state, `TIRE_S`."""
    return topo[TOPOLOGY.state_tire_at] + tire * len(TIRE_S)


@register_jitable
def tire_params(topo: Integers, tire: int) -> int:
    """Place of a tire's first parameter, `TIRE`."""
    return topo[TOPOLOGY.tire_at] + tire_offset(tire)


@register_jitable
def brake_line(topo: Integers, circuit: int) -> int:
    """Place of the first sample of a circuit's delay line."""
    return topo[TOPOLOGY.state_line_at] + circuit * topo[TOPOLOGY.line_length]
