from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from truck_blowout_sim.physics.tires.linear import forces
from truck_blowout_sim.vehicle import load_vehicle, pack


def test_force_is_proportional_then_capped_by_friction(block: Callable[[str], int]) -> None:
    packed = pack(load_vehicle("ferrari_250lm"))
    at = min(i for name, i in packed.index.items() if name.startswith("tire.front_left."))
    k = packed["tire.front_left.linear_cornering_nprad"]
    _, fy, mz = forces(packed.params, at, 5000.0, 0.0, math.tan(0.01), 1.0, 1.0, k)
    assert fy == pytest.approx(0.01 * k)
    assert mz == 0.0
    limit = packed["tire.front_left.peak_y"] * packed["tire.front_left.friction_scale"] * 5000.0
    fx, fy, _ = forces(packed.params, at, 5000.0, 0.8, 1.0, 1.0, 1.0, k)
    assert math.hypot(fx, fy) == pytest.approx(limit)


def test_both_axles_carry_the_published_stiffness() -> None:
    packed = pack(load_vehicle("ferrari_250lm"))
    for axle, stiffness in (("front", 70e3), ("rear", 120e3)):
        total = sum(packed[f"tire.{axle}_{side}.linear_cornering_nprad"]
                    * packed[f"tire.{axle}_{side}.cornering_scale"] for side in ("left", "right"))
        assert total == pytest.approx(stiffness)


def test_saturation_keeps_the_slope_and_levels_off(block: Callable[[str], int]) -> None:
    packed = pack(load_vehicle("ferrari_250lm"))
    at = min(i for name, i in packed.index.items() if name.startswith("tire.front_left."))
    k, fz_n = packed["tire.front_left.linear_cornering_nprad"], 2500.0
    level = packed.with_values({"tire.front_left.saturation": 0.8})
    _, small, _ = forces(level.params, at, fz_n, 0.0, 1e-4, 1.0, 1.0, k)
    assert small == pytest.approx(1e-4 * k, rel=1e-4)
    _, large, _ = forces(level.params, at, fz_n, 0.0, 1.0, 1.0, 1.0, k)
    assert large == pytest.approx(fz_n / 0.8, rel=1e-4)
