from __future__ import annotations

import math

import numpy as np
import pytest

from truck_blowout_sim.physics import road
from truck_blowout_sim.physics.layout import GLOBAL_S
from truck_blowout_sim.simulation import InitialState, Inputs, Truck
from truck_blowout_sim.vehicle import Packed


def test_a_smooth_road_is_flat_and_a_rough_one_has_its_rms(truck: Packed) -> None:
    assert road.height(truck.params, 12.3, -4.5) == 0.0
    rough = truck.with_values({"world.road_roughness_m": 0.004}).params
    heights = np.array([road.height(rough, x, 0.7) for x in np.arange(0.0, 4000.0, 0.11)])
    assert heights.std() == pytest.approx(0.004, rel=0.03)
    assert abs(heights.mean()) < 2e-4


def test_seeds_give_different_roads(truck: Packed) -> None:
    values = {"world.road_roughness_m": 0.004, "world.road_roughness_seed": 1.0}
    one = truck.with_values(values).params
    two = truck.with_values(values | {"world.road_roughness_seed": 2.0}).params
    xs = np.arange(0.0, 50.0, 0.5)
    differences = [abs(road.height(one, x, 0.0) - road.height(two, x, 0.0)) for x in xs]
    assert max(differences) > 0.004


def test_friction_of_a_patch_and_of_a_change(truck: Packed) -> None:
    patch = {"world.patch_x0_m": 10.0, "world.patch_x1_m": 20.0, "world.patch_y0_m": -5.0,
             "world.patch_y1_m": 0.0, "world.patch_scale": 0.4}
    p = truck.with_values(patch).params
    assert [road.friction(p, 0.0, 0.0, 15.0, y) for y in (-1.0, 1.0)] == [0.4, 1.0]
    p = truck.with_values({"world.friction_change_scale": 0.5,
                           "world.friction_change_time_s": 2.0}).params
    assert [road.friction(p, t, 0.0, 0.0, 0.0) for t in (1.9, 2.0)] == [1.0, 0.5]
    assert road.friction(p, 2.0, -1.0, 0.0, 0.0) == 1.0


def test_axles_meet_another_friction_one_after_another(truck: Packed) -> None:
    """The last axle is on ice when the truck has rolled its length since the first one met it."""
    icy = truck.with_values({"world.friction_change_scale": 0.5,
                             "world.friction_change_time_s": 1.0})
    run = Truck(icy, initial=InitialState(speed_mps=20.0))
    behind = [icy[f"axle.{axle}.behind_m"] for axle in ("steer", "drive_1", "trailer_2")]
    assert behind == pytest.approx([0.0, 5.33, 17.35], abs=0.01)
    run.advance(Inputs(), round(1.0 / run.step_s))
    assert run.state[GLOBAL_S.over_m] == pytest.approx(0.0, abs=0.05)
    run.advance(Inputs(), round(17.35 / 20.0 / run.step_s))
    assert run.state[GLOBAL_S.over_m] == pytest.approx(17.35, rel=0.02)
    assert [road.friction(icy.params, 2.0, run.state[GLOBAL_S.over_m] - at, 0.0, 0.0)
            for at in (*behind, 20.0)] == [0.5, 0.5, 1.0, 1.0]


def test_gravity_keeps_its_size_on_any_slope(truck: Packed) -> None:
    p = truck.with_values({"world.road_grade_rad": 0.03, "world.road_bank_rad": -0.02}).params
    g = road.gravity(p, 0.0)
    assert math.hypot(*g) == pytest.approx(9.81)
    assert g[0] == pytest.approx(-9.81 * math.sin(0.03))
    assert g[1] > 0.0


def test_a_rolling_truck_gains_on_a_grade_what_gravity_gives(truck: Packed) -> None:
    """Downhill against level, the same truck: the difference is g sin(grade)."""
    speeds = []
    for grade in (0.0, -0.03):
        run = Truck(truck.with_values({"world.road_grade_rad": grade}),
                    initial=InitialState(speed_mps=15.0))
        run.advance(Inputs(), 2000)
        speeds.append(run.outputs()["tractor_vx_mps"])
    wheels = 18 * 14.0 / 0.495**2 / truck_mass(truck)
    gained = (speeds[1] - speeds[0]) / 2.0
    assert gained == pytest.approx(9.81 * math.sin(0.03) / (1.0 + wheels), rel=0.02)


def truck_mass(truck: Packed) -> float:
    return sum(v for v in (truck[n] for n in truck.index if n.endswith(".mass_kg")))


def test_a_slope_that_begins_eases_in(truck: Packed) -> None:
    p = truck.with_values({"world.grade_change_rad": 0.02, "world.grade_change_time_s": 3.0,
                           "world.grade_change_ramp_s": 2.0}).params
    before, half, after = (road.gravity(p, time_s)[0] for time_s in (3.0, 4.0, 9.0))
    assert before == pytest.approx(0.0, abs=1e-12)
    assert half == pytest.approx(-9.80665 * math.sin(0.01), rel=1e-3)
    assert after == pytest.approx(-9.80665 * math.sin(0.02), rel=1e-3)


def test_grade_and_bank_begin_each_at_its_own_instant(truck: Packed) -> None:
    p = truck.with_values({"world.grade_change_rad": 0.02, "world.grade_change_time_s": 3.0,
                           "world.bank_change_rad": 0.01, "world.bank_change_time_s": 9.0,
                           "world.grade_change_ramp_s": 1.0,
                           "world.bank_change_ramp_s": 4.0}).params
    assert road.gravity(p, 3.5)[0] == pytest.approx(-9.80665 * math.sin(0.01), rel=1e-3)
    along, across, _ = road.gravity(p, 6.0)
    assert along == pytest.approx(-9.80665 * math.sin(0.02), rel=1e-3)
    assert across == pytest.approx(0.0, abs=1e-12)
    assert road.gravity(p, 11.0)[1] == pytest.approx(-9.80665 * math.sin(0.005), rel=1e-3)
    assert road.gravity(p, 13.0)[1] == pytest.approx(-9.80665 * math.sin(0.01), rel=1e-3)
