"""What a truck starts from: nothing that is timed acts while it settles."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest

from truck_blowout_sim.physics import layout
from truck_blowout_sim.simulation import InitialState, Inputs, Truck
from truck_blowout_sim.simulation.equilibrium import held_motion, initial_vector
from truck_blowout_sim.vehicle import Packed
from truck_blowout_sim.vehicle.packing.blocks import NEUTRAL
from truck_blowout_sim.vehicle.packing.bounds import may_be_infinite

START = InitialState(speed_mps=20.0, time_s=-4.92)
# What each event does where its instant alone does nothing; one amount for every event of a block.
AMOUNTS = {
    "world": {"grade_change_rad": 0.05, "bank_change_rad": 0.05, "friction_change_scale": 0.3},
    "unit.trailer": {"gust_mps": 15.0, "shift_y_m": 0.4, "shift_x_m": 1.0, "probe_fy_n": 2e4,
                     "probe_end_s": math.inf, "probe_mz_nm": 2e4},
    "driveline": {"clutch_open_drag_n": 5e3},
    "tire.steer_left": {},
}


def events() -> list[str]:
    """Every parameter that is an instant or place which may never come, each at one block."""
    blocks = {"world": layout.WorldParams, "unit.trailer": layout.UnitParams,
              "driveline": layout.DrivelineParams, "tire.steer_left": layout.TireParams}
    return [f"{prefix}.{field}" for prefix, block in blocks.items() for field in block._fields
            if may_be_infinite(block, field)]


def test_no_other_block_has_events() -> None:
    others = set(NEUTRAL) - {layout.WorldParams, layout.UnitParams, layout.DrivelineParams,
                             layout.TireParams}
    assert not [field for block in others for field in block._fields
                if may_be_infinite(block, field)]
    assert len(events()) >= 10


@pytest.mark.parametrize("name", events())
@pytest.mark.parametrize("since_s", [-3.0, -20.0])
def test_an_event_before_zero_is_not_felt_while_settling(
    truck: Packed, settled: np.ndarray, name: str, since_s: float
) -> None:
    prefix = name.rpartition(".")[0]
    amounts = {f"{prefix}.{key}": value for key, value in AMOUNTS[prefix].items()}
    timed = truck.with_values({**amounts, name: since_s})
    np.testing.assert_array_equal(initial_vector(timed, START, 0.001), settled)


@pytest.fixture(scope="module")
def settled(truck: Packed) -> np.ndarray:
    return initial_vector(truck, START, 0.001)


@pytest.mark.parametrize("articulation", [0.5, -0.5, 0.0])
def test_both_units_move_their_hitch_alike(truck: Packed, articulation: float) -> None:
    """The hitch has one velocity in map, seen from the fifth wheel and from the kingpin."""
    start = InitialState(speed_mps=10.0, lateral_speed_mps=0.4, yaw_rate_radps=0.2,
                         articulation_rad=articulation)
    velocities = []
    for k, (u, v, yaw_rate, yaw) in enumerate(held_motion(truck, start)):
        at = layout.UNIT_AT + k * layout.UNIT_SIZE
        v += yaw_rate * truck.params[at + layout.UNIT.hitch_x_m]
        velocities.append((u + 1j * v) * cmath.exp(1j * yaw))
    assert velocities[1] == pytest.approx(velocities[0], abs=1e-12)


@pytest.mark.parametrize("articulation", [0.5, -0.5])
def test_an_articulated_start_is_no_jolt(truck: Packed, articulation: float) -> None:
    """The coupling carries less than the grip of the trailer's axles; nothing jumps."""
    run = Truck(truck, initial=InitialState(speed_mps=10.0, articulation_rad=articulation))
    pulls = []
    for _ in range(300):
        run.advance(Inputs())
        pulls.append(abs(run.state[layout.GLOBAL_S.coupling_fx_n]))
    assert max(pulls) < 10e3
