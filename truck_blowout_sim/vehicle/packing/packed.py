"""The packed vehicle: parameters, topology, and where each named parameter sits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics import layout
from truck_blowout_sim.physics.tires.lanes import tire_offset
from truck_blowout_sim.vehicle.document import Place
from truck_blowout_sim.vehicle.packing import chassis, running_gear
from truck_blowout_sim.vehicle.packing.bounds import (
    check_shares,
    check_value,
    may_be_infinite,
    nearest_allowed,
)
from truck_blowout_sim.vehicle.packing.names import (
    Names,
    names_of,
    parameter_blocks,
    parameter_index,
    unknown_parameter,
)
from truck_blowout_sim.vehicle.packing.table_use import check_table_use
from truck_blowout_sim.vehicle.packing.tables import Tables
from truck_blowout_sim.vehicle.packing.topology import topology_of
from truck_blowout_sim.vehicle.statics import StaticLoads, static_loads
from truck_blowout_sim.vehicle.vehicle import Vehicle


@dataclass(frozen=True, eq=False)
class Packed:
    """A vehicle ready to be stepped.

    Attributes:
        params: float64[n], blocks of `physics.layout`, tables behind them.
        topology: int64[m], `layout.Topology`, then per axle and per tire entries.
        index: position in `params` of each named parameter, such as
            `hub.trailer_2_left.brake_gain`.
        vehicle: what was packed.
        names: names of units, axles, hubs and tires in the order of the blocks.
        blocks: block of the layout by the prefix of a parameter's name.
        event_positions: where `params` holds an instant or a place that may never come.
    """

    params: NDArray[np.float64]
    topology: NDArray[np.int64]
    index: Mapping[str, int]
    vehicle: Vehicle
    names: Names
    blocks: Mapping[str, type[Any]]
    event_positions: NDArray[np.int64]

    def __getitem__(self, name: str) -> float:
        """Value of a named parameter.

        Raises:
            InputError: no parameter of this name; says which is nearest.
        """
        return float(self.params[self.position(name)])

    def position(self, name: str) -> int:
        """Position of a named parameter in `params`.

        Raises:
            InputError: no parameter of this name; says which is nearest.
        """
        if name not in self.index:
            raise unknown_parameter(self._place, name, self.index)
        return self.index[name]

    def block(self, name: str) -> type[Any]:
        """The block of the layout that a named parameter belongs to.

        Raises:
            InputError: no parameter of this name; says which is nearest.
        """
        self.position(name)
        return self.blocks[name.rpartition(".")[0]]

    def with_values(self, values: Mapping[str, float]) -> Packed:
        """A copy with some named parameters set, each checked against the bounds of its key.

        Raises:
            InputError: no parameter of a name, or a value the parameter cannot have.
        """
        for name, value in values.items():
            block, place = self.block(name), self._place._replace(key=name)
            check_value(block, name.rpartition(".")[2], value, place)
            if value != self[name]:
                check_table_use(self.vehicle, block, name, value, place)
        changed = self.unchecked(values)
        shares = {name: changed[name] for name in self.index if name.endswith(".drive_share")}
        if given := next((name for name in values if name in shares), ""):
            check_shares(shares, self._place._replace(key=given))
        return changed

    def unchecked(self, values: Mapping[str, float]) -> Packed:
        """As `with_values`, but any number goes: for trials beyond what a truck can be.

        Raises:
            InputError: no parameter of a name.
        """
        params = self.params.copy()
        for name, value in values.items():
            params[self.position(name)] = value
        return replace(self, params=params)

    def within(self, values: Mapping[str, float]) -> Mapping[str, float]:
        """The same values, each as near as the bounds of its key allow.

        Raises:
            InputError: no parameter of a name.
        """
        return {name: nearest_allowed(self.block(name), name.rpartition(".")[2], value)
                for name, value in values.items()}

    def differing(self, other: Packed) -> dict[str, float]:
        """Named parameters that are not those of another packing of the vehicle."""
        return {name: float(self.params[i]) for name, i in other.index.items()
                if self.params[i] != other.params[i]}

    def tire_states(self, field: int) -> NDArray[np.int64]:
        """Position in the state vector of one field of `TIRE_S`, for every tire."""
        tires = np.arange(self.topology[layout.TOPOLOGY.n_tires])
        return np.asarray(self.topology[layout.TOPOLOGY.state_tire_at]
                          + tires * len(layout.TIRE_S) + field)

    def without_events(self) -> NDArray[np.float64]:
        """A copy of the parameters in which nothing that is timed ever happens."""
        params = self.params.copy()
        params[self.event_positions] = np.inf
        return params

    @property
    def _place(self) -> Place:
        return Place(str(self.vehicle.path), 0, "")


def pack(vehicle: Vehicle) -> Packed:
    """Pack a vehicle, its effects included.

    Raises:
        InputError: an effect names no parameter; `load_vehicle` does not let this through.
        ValueError: loads at rest are undetermined; nor does it this.
    """
    tables = Tables(vehicle.blowout)
    loads = static_loads(vehicle, vehicle.road.gravity_mps2)
    head = _head(vehicle, loads)
    tail = _running_gear(vehicle, loads, tables)
    params = np.array([*head, *tail, *tables.values], dtype=np.float64)
    topology = topology_of(vehicle, table_at=len(head) + len(tail))
    index, blocks = parameter_index(vehicle), dict(parameter_blocks(vehicle))
    packed = Packed(params, topology, index, vehicle, names_of(vehicle), blocks,
                    _event_positions(index, blocks))
    return packed.with_values({name: effect.value for name, effect in vehicle.effects.items()})


def _event_positions(index: Mapping[str, int], blocks: Mapping[str, type[Any]]
                     ) -> NDArray[np.int64]:
    """Positions of every parameter that may be infinite: what has not happened yet."""
    found = []
    for name, position in index.items():
        prefix, _, field = name.rpartition(".")
        if may_be_infinite(blocks[prefix], field):
            found.append(position)
    return np.array(found, dtype=np.int64)


def _head(vehicle: Vehicle, loads: StaticLoads) -> list[float]:
    units = [chassis.unit_block(vehicle, name) for name in vehicle.units]
    return [
        *chassis.world_block(vehicle.road),
        *chassis.steering_block(vehicle),
        *chassis.coupling_block(vehicle, loads.hitch_n),
        *chassis.driveline_block(vehicle),
        *chassis.abs_block(vehicle),
        *chassis.circuit_blocks(vehicle),
        *(value for unit in units for value in unit),
    ]


def _running_gear(vehicle: Vehicle, loads: StaticLoads, tables: Tables) -> list[float]:
    axles = vehicle.spec.axles
    blocks = [running_gear.axle_block(vehicle, name, loads) for name in vehicle.axles]
    blocks += [running_gear.hub_block(axles[vehicle.axle_of_hub(hub)], hub) for hub in vehicle.hubs]
    tires = [
        running_gear.tire_block(vehicle, tire, hub, tables)
        for hub in vehicle.hubs
        for tire in vehicle.tires_of_hub(hub)
    ]
    return [*(value for block in blocks for value in block), *side_by_side(tires)]


def side_by_side(tires: Sequence[Sequence[float]]) -> list[float]:
    """Blocks of tires in the order of the layout: field by field, in each the tires.

    Raises:
        ValueError: more tires than the core has room for.
    """
    if len(tires) > layout.MAX_TIRES:
        raise ValueError(f"{len(tires)} tires, at most {layout.MAX_TIRES} have room")
    lanes = np.zeros(-(-len(tires) // layout.TIRE_LANES) * layout.TIRE_BLOCK)
    for number, block in enumerate(tires):
        lanes[tire_offset(number) + np.array(layout.TIRE)] = block
    return lanes.tolist()
