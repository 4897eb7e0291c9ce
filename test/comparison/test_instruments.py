"""Every kind of channel that a truck's recording may hold has a good instrument's noise."""

from __future__ import annotations

import numpy as np
import pytest

from truck_blowout_sim.comparison.instruments import body_sigma, good_sigma
from truck_blowout_sim.recordings import channels_for
from truck_blowout_sim.vehicle import load_vehicle

READINGS = np.full(10, 2e5)


def test_no_output_channel_is_without_one() -> None:
    truck = load_vehicle("international_9400i_trailmobile")
    rows = channels_for(truck.hubs, truck.tires, truck.units, ["steer_left"])
    names = [row.name for row in rows if row.group != "input"] + ["tractor_across_m"]
    assert not [name for name in names if good_sigma(name, READINGS) <= 0.0]


@pytest.mark.parametrize(("channel", "sigma"), [
    ("tractor_yaw_rate_radps", 3.5e-4), ("hub_speed_steer_left_radps", 400.0),
    ("brake_chamber_steer_left_pa", np.hypot(500.0, 1000.0)), ("tire_fz_steer_left_n", 24.0),
])  # fmt: skip
def test_shares_of_the_reading_and_constants(channel: str, sigma: float) -> None:
    assert good_sigma(channel, READINGS) == pytest.approx(sigma)


def test_what_is_no_motion_of_a_body_has_none_of_its_noise() -> None:
    assert body_sigma("hub_speed_steer_left_radps") == 0.0
