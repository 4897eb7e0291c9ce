"""The integer vector that says what hangs on what, and where state and parameters begin."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics import layout
from truck_blowout_sim.vehicle.schema.axle import CIRCUITS
from truck_blowout_sim.vehicle.vehicle import Vehicle

LINE_SAMPLES = 1000  # longest brake delay in steps, 1 s at 1 ms


def topology_of(vehicle: Vehicle, table_at: int) -> NDArray[np.int64]:
    """Topology vector of a vehicle whose tables begin at `table_at`."""
    axles = vehicle.spec.axles
    n_units, n_axles = len(vehicle.units), len(vehicle.axles)
    n_hubs, n_tires = len(vehicle.hubs), len(vehicle.tires)
    axle_at = layout.UNIT_AT + n_units * layout.UNIT_SIZE
    hub_at = axle_at + n_axles * layout.AXLE_SIZE
    state_axle_at = layout.STATE_UNIT_AT + n_units * len(layout.UNIT_S)
    state_hub_at = state_axle_at + n_axles * len(layout.AXLE_S)
    state_tire_at = state_hub_at + n_hubs * len(layout.HUB_S)
    state_line_at = state_tire_at + n_tires * len(layout.TIRE_S)
    steered = [number for number, axle in enumerate(axles.values()) if axle.steered]
    head = layout.Topology(
        n_units=n_units,
        n_axles=n_axles,
        n_hubs=n_hubs,
        n_tires=n_tires,
        n_state=state_line_at + layout.N_CIRCUITS * LINE_SAMPLES,
        steered_axle=steered[0] if steered else -1,
        axle_at=axle_at,
        hub_at=hub_at,
        tire_at=hub_at + n_hubs * layout.HUB_SIZE,
        table_at=table_at,
        state_axle_at=state_axle_at,
        state_hub_at=state_hub_at,
        state_tire_at=state_tire_at,
        state_line_at=state_line_at,
        line_length=LINE_SAMPLES,
    )
    return np.array([*head, *_axle_entries(vehicle), *_tire_entries(vehicle)], dtype=np.int64)


def _axle_entries(vehicle: Vehicle) -> list[int]:
    """Per axle: its unit, its circuit, the axle it is equalised with or -1."""
    entries: list[int] = []
    for axle in vehicle.spec.axles.values():
        partner = axle.equalized_with
        entries += [
            vehicle.units.index(axle.unit),
            CIRCUITS.index(axle.circuit),
            vehicle.axles.index(partner) if partner else -1,
        ]
    return entries


def _tire_entries(vehicle: Vehicle) -> list[int]:
    """Per tire: its hub."""
    return [number for number, hub in enumerate(vehicle.hubs) for _ in vehicle.tires_of_hub(hub)]
