"""Places of blocks: those that the packed vehicle gives its named parameters and states."""

from __future__ import annotations

import pytest

from truck_blowout_sim.physics import places
from truck_blowout_sim.physics.layout import AXLE, AXLE_S, HUB, HUB_S, TIRE, TIRE_S, UNIT, UNIT_S
from truck_blowout_sim.vehicle import Packed, load_vehicle, pack
from truck_blowout_sim.vehicle.packing.names import state_index
from truck_blowout_sim.vehicle.schema.axle import CIRCUITS


@pytest.fixture(scope="module", params=["international_9400i_trailmobile", "ferrari_250lm"])
def packed(request: pytest.FixtureRequest) -> Packed:
    return pack(load_vehicle(request.param))


def test_blocks_stand_where_their_names_say(packed: Packed) -> None:
    topo, state = packed.topology, state_index(packed.vehicle)
    for k, name in enumerate(packed.names.units):
        assert packed.position(f"unit.{name}.hitch_x_m") == places.unit_params(k) + UNIT.hitch_x_m
        assert state[f"unit.{name}.u_mps"] == places.unit_state(k) + UNIT_S.u_mps
    for k, name in enumerate(packed.names.axles):
        assert packed.position(f"axle.{name}.mass_kg") == places.axle_params(topo, k) + AXLE.mass_kg
        assert state[f"axle.{name}.vz_mps"] == places.axle_state(topo, k) + AXLE_S.vz_mps
    for k, name in enumerate(packed.names.hubs):
        assert packed.position(f"hub.{name}.toe_rad") == places.hub_params(topo, k) + HUB.toe_rad
        assert state[f"hub.{name}.heat_j"] == places.hub_state(topo, k) + HUB_S.heat_j
    for k, name in enumerate(packed.names.tires):
        assert packed.position(f"tire.{name}.law") == places.tire_params(topo, k) + TIRE.law
        assert state[f"tire.{name}.fz_n"] == places.tire_state(topo, k) + TIRE_S.fz_n
    assert places.brake_line(topo, 0) == len(state)


def test_what_hangs_on_what(packed: Packed) -> None:
    topo, names, axles = packed.topology, packed.names, packed.vehicle.spec.axles
    for k, name in enumerate(names.axles):
        assert names.units[places.unit_of(topo, k)] == axles[name].unit
        assert CIRCUITS[places.circuit_of(topo, k)] == axles[name].circuit
        partner = places.partner_of(topo, k)
        assert (names.axles[partner] if partner >= 0 else None) == (axles[name].equalized_with
                                                                    or None)
        for side, word in enumerate(("left", "right")):
            hub = names.hubs[places.hub_at_side(k, side)]
            assert packed.vehicle.axle_of_hub(hub) == name
            assert hub.endswith(word)
    for hub_number, hub in enumerate(names.hubs):
        for tire in packed.vehicle.tires_of_hub(hub):
            assert places.hub_of(topo, names.tires.index(tire)) == hub_number
