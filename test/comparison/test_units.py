from __future__ import annotations

import pytest

from truck_blowout_sim.comparison.units import display_unit


@pytest.mark.parametrize(
    ("channel", "si", "shown", "symbol"),
    [
        ("tractor_vx_mps", 26.8224, 60.0, "mph"),
        ("tractor_yaw_rate_radps", 0.0436332313, 2.5, "deg/s"),
        ("tractor_yaw_rad", 0.0174532925, 1.0, "deg"),
        ("tractor_x_m", 0.3048, 1.0, "ft"),
        ("tire_pressure_steer_left_pa", 758423.302, 110.0, "psi"),
        ("trailer_ay_mps2", 9.80665, 1.0, "g"),
        ("hub_speed_steer_left_radps", 6.283185307, 60.0, "rpm"),
        ("tire_fz_steer_left_n", 4.4482216152605, 1.0, "lbf"),
        ("throttle", 0.5, 50.0, "%"),
    ],
)
def test_people_see_the_units_they_use(channel: str, si: float, shown: float, symbol: str) -> None:
    unit = display_unit(channel)
    assert si * unit.per_si == pytest.approx(shown, rel=1e-7)
    assert unit.symbol == symbol
