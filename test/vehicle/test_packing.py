"""The packed parameter vector: nothing without source, everything by name, signs as agreed."""

from __future__ import annotations

from math import radians
from typing import Any

import numpy as np
import pytest

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.physics import layout
from truck_blowout_sim.vehicle import Packed, load_road, load_vehicle, pack, road_values
from truck_blowout_sim.vehicle.packing.blocks import NEUTRAL, fill

T = layout.TOPOLOGY


@pytest.mark.parametrize("block", NEUTRAL, ids=lambda block: block.__name__)
def test_neutral_values_belong_to_fields_of_the_layout(block: type[Any]) -> None:
    assert set(NEUTRAL[block]) <= set(block._fields)


def test_every_block_of_the_layout_is_known() -> None:
    blocks = {
        value
        for name, value in vars(layout).items()
        if isinstance(value, type) and name.endswith("Params")
    }
    assert blocks == set(NEUTRAL)


def test_a_field_without_source_fails_at_once() -> None:
    with pytest.raises(LookupError, match="AbsParams has no source for mode"):
        fill(layout.AbsParams, {"slip_off": 1, "slip_on": 1, "cutout_speed_mps": 0, "hold_s": 0})


def test_a_value_without_field_fails_at_once() -> None:
    with pytest.raises(LookupError, match="AbsParams has no field speed"):
        fill(layout.AbsParams, {"speed": 1.0})


@pytest.mark.parametrize(
    "name",
    [
        "international_9400i_trailmobile",
        "international_9400i_trailmobile_thesis",
        "rigid_truck",
        "ferrari_250lm",
    ],
)
def test_blocks_lie_where_the_layout_says(name: str) -> None:
    packed = pack(load_vehicle(name))
    topology, index, names = packed.topology, packed.index, packed.names
    assert len(set(index.values())) == len(index)
    blocks = -(-len(names.tires) // layout.TIRE_LANES)
    assert topology[T.table_at] == topology[T.tire_at] + blocks * layout.TIRE_BLOCK
    assert index["steering.ratio"] == layout.STEER_AT + layout.STEER.ratio
    assert index["circuit.trailer.lag_s"] == (
        layout.CIRCUIT_AT + 2 * layout.CIRCUIT_SIZE + layout.CIRCUIT.lag_s
    )
    places = {
        "unit": (names.units, layout.UNIT_AT, layout.UNIT_SIZE, "mass_kg"),
        "axle": (names.axles, topology[T.axle_at], layout.AXLE_SIZE, "x_m"),
        "hub": (names.hubs, topology[T.hub_at], layout.HUB_SIZE, "y_m"),
        "tire": (names.tires, topology[T.tire_at], 1, "y_m"),
    }
    for kind, (items, start, size, field) in places.items():
        for number, item in enumerate(items):
            assert index[f"{kind}.{item}.{field}"] == start + number * size, item
    assert not np.isnan(packed.params).any()


def test_topology_of_the_default_vehicle(packed: Packed) -> None:
    topology = packed.topology
    head, rest = topology[: layout.TOPOLOGY_SIZE], topology[layout.TOPOLOGY_SIZE :].tolist()
    assert head[[T.n_units, T.n_axles, T.n_hubs, T.n_tires]].tolist() == [2, 5, 10, 18]
    assert head[T.steered_axle] == 0
    assert rest[:15] == [0, 0, -1, 0, 1, -1, 0, 1, -1, 1, 2, 4, 1, 2, 3]
    assert rest[15:] == [0, 1, *(hub for hub in range(2, 10) for _ in range(2))]
    assert head[T.state_axle_at] == layout.STATE_UNIT_AT + 2 * len(layout.UNIT_S)
    assert head[T.n_state] == head[T.state_line_at] + 3 * head[T.line_length]
    assert head[T.state_line_at] == head[T.state_tire_at] + 18 * len(layout.TIRE_S)


def test_names_are_those_of_the_interface(packed: Packed) -> None:
    hubs = [
        f"{axle}_{side}"
        for axle in ("steer", "drive_1", "drive_2", "trailer_1", "trailer_2")
        for side in ("left", "right")
    ]
    tires = [f"{hub}{dual}" for hub in hubs[2:] for dual in ("_outer", "_inner")]
    assert packed.names.units == ("tractor", "trailer")
    assert list(packed.names.hubs) == hubs
    assert list(packed.names.tires) == hubs[:2] + tires
    assert packed.vehicle.tires_of_hub("drive_2_left") == (
        "drive_2_left_outer",
        "drive_2_left_inner",
    )
    assert packed.vehicle.hub_of_tire("trailer_1_right_inner") == "trailer_1_right"


def test_outer_duals_are_farther_out(packed: Packed) -> None:
    for hub in packed.names.hubs[2:]:
        y = packed[f"hub.{hub}.y_m"]
        outer, inner = (packed[f"tire.{hub}_{dual}.y_m"] for dual in ("outer", "inner"))
        assert abs(y + outer) - abs(y + inner) == pytest.approx(0.328)
        assert outer == -inner


def test_positions_are_seen_forward_from_the_center_of_gravity(packed: Packed) -> None:
    assert packed["unit.tractor.origin_x_m"] == pytest.approx(1.40)
    assert packed["unit.tractor.base_x_m"] == pytest.approx(1.40 - 2.42)
    assert packed["unit.tractor.base_z_m"] == pytest.approx(0.90 - 1.07)
    assert packed["unit.tractor.hitch_x_m"] == pytest.approx(1.40 - 5.50)
    assert packed["axle.steer.x_m"] == pytest.approx(1.40)
    trailer_x = (3973 * 5.60 + 3978 * 0.2 + 5967 * 10.5) / 13918
    assert packed["unit.trailer.hitch_x_m"] == pytest.approx(trailer_x)
    assert packed["unit.trailer.base_x_m"] == pytest.approx(trailer_x - 5.613)
    assert packed["axle.trailer_2.x_m"] == pytest.approx(trailer_x - 11.8465)
    cargo_x = (3978 * 0.2 + 5967 * 10.5) / 9945
    assert packed["unit.trailer.payload_x_m"] == pytest.approx(trailer_x - cargo_x)
    assert packed["unit.trailer.payload_kg"] == 9945


def test_alignment_is_given_in_the_sense_of_the_world(packed: Packed) -> None:
    assert packed["hub.steer_left.toe_rad"] == pytest.approx(-radians(0.08))  # turns right
    assert packed["hub.steer_right.toe_rad"] == pytest.approx(radians(0.08))
    assert packed["hub.steer_left.camber_rad"] == pytest.approx(radians(0.25))  # top to the left
    assert packed["hub.steer_right.camber_rad"] == 0.0


def test_brake_torque_is_the_published_quadratic(packed: Packed) -> None:
    psi = 6894.757293168361
    for pressure, newton_meters in ((20, 2.3e3), (40, 5.4e3), (60, 8.3e3), (80, 11.2e3)):
        x = pressure * psi - packed["hub.trailer_1_left.brake_pushout_pa"]
        torque = packed["hub.trailer_1_left.brake_linear_nmppa"] * x
        torque -= packed["hub.trailer_1_left.brake_quadratic_nmppa2"] * x**2
        assert torque == pytest.approx(newton_meters, rel=0.02)


def test_frame_torsion_of_both_ends_adds_up_to_the_given(ferrari: Packed, packed: Packed) -> None:
    """Two springs in series; 0 stands for rigid."""
    for whole in (ferrari, packed):
        for unit, spec in whole.vehicle.unit_specs.items():
            ends = [whole[f"unit.{unit}.torsion_{end}_nmprad"] for end in ("front", "rear")]
            compliance = sum(1 / end for end in ends if end)
            assert 1 / compliance == pytest.approx(spec.frame.torsion_nmprad)


def test_with_values_makes_a_copy(packed: Packed) -> None:
    changed = packed.with_values({"hub.trailer_2_left.brake_gain": 0.35})
    assert changed["hub.trailer_2_left.brake_gain"] == 0.35
    assert packed["hub.trailer_2_left.brake_gain"] == 1.0
    assert changed.index is packed.index


def test_with_values_refuses_an_unknown_name(packed: Packed) -> None:
    with pytest.raises(InputError, match=r"did you mean 'hub\.trailer_2_left\.brake_gain'"):
        packed.with_values({"hub.trailer_2_left.brake_gian": 0.35})


def test_a_single_unit_packs(ferrari: Packed) -> None:
    assert ferrari.topology[T.n_units] == 1
    assert ferrari["steering.compliance_on"] == 0.0
    assert ferrari["fifth_wheel.yaw_friction_nm"] == 0.0


@pytest.fixture(scope="module")
def ferrari() -> Packed:
    return pack(load_vehicle("ferrari_250lm"))


def test_the_car_is_the_nominal_single_track_model(ferrari: Packed) -> None:
    spec = ferrari.vehicle.spec
    front, rear = spec.axles["front"], spec.axles["rear"]
    body = spec.units.tractor.body
    mass = body.mass_kg + front.mass_kg + rear.mass_kg
    x = (body.mass_kg * body.x_m + rear.mass_kg * rear.x_m) / mass
    izz = body.izz_kgm2 + body.mass_kg * (body.x_m - x) ** 2
    izz += sum(axle.izz_kgm2 + axle.mass_kg * (axle.x_m - x) ** 2 for axle in (front, rear))
    assert (mass, x, rear.x_m - x) == pytest.approx((982, 1.33, 1.07), abs=1e-3)
    assert izz == pytest.approx(1605, rel=2e-3)
    assert 2 * ferrari["tire.front_left.linear_cornering_nprad"] == 70e3
    assert 2 * ferrari["tire.rear_right.linear_cornering_nprad"] == 120e3
    assert ferrari["tire.rear_right.model"] == 2.0


def test_a_road_can_be_laid_under_a_packed_vehicle(packed: Packed) -> None:
    hill = packed.with_values(road_values(load_road("uphill_3_percent")))
    changed = [name for name in packed.index if hill[name] != packed[name]]
    assert changed == ["world.road_grade_rad"]
    assert hill["world.road_grade_rad"] == 0.03
