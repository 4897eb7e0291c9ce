"""What Autoware's `base_link`, between the rear axles, does: against the motion itself."""

from __future__ import annotations

import numpy as np
import pytest

from truck_blowout_sim import InitialState, Inputs, Truck, load_vehicle
from truck_blowout_sim.nodes.adapters.rear_axle import RearAxle


def test_motion_at_the_rear_axle_is_that_of_a_rigid_body() -> None:
    vehicle = load_vehicle("international_9400i_trailmobile")
    truck = Truck(vehicle, initial=InitialState(speed_mps=15.0))
    axle = RearAxle(vehicle, truck.output_names)
    before = None
    for tick in range(300):
        truck.advance(Inputs(2.0, 0.3), 10)
        now = axle.motion((tick + 1) * 10_000_000, truck.output_vector())
        if before is not None and tick > 250:
            moved = (now.place_m - before.place_m) / 0.01
            yaw = 2 * np.arctan2(now.turn[2], now.turn[3])
            along = np.cos(yaw) * moved[0] + np.sin(yaw) * moved[1]
            across = np.cos(yaw) * moved[1] - np.sin(yaw) * moved[0]
            assert along == pytest.approx(now.velocity_mps[0], abs=0.05)
            assert across == pytest.approx(now.velocity_mps[1], abs=0.05)
        before = now
    # in a steady turn the rear axle is drawn toward the center by v times yaw rate
    centripetal = now.velocity_mps[0] * now.rate_radps[2]
    assert now.acceleration_mps2[1] == pytest.approx(centripetal, rel=0.1)
