"""The recommended tire against its acceptance table, and what combined slip may do."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from truck_blowout_sim.physics.layout import TIRE
from truck_blowout_sim.physics.tires import magic_formula as mf
from truck_blowout_sim.vehicle import Packed

Block = Callable[[str], int]
# Fz [kN]: Fy [kN] at 1, 2, 4, 10 deg; Mz [N m] at 1, 2, 4, 8 deg; relaxation length [m]
ACCEPTANCE = {
    9.81: ((1.19, 2.34, 4.31, 7.38), (20, 37, 59, 53), 0.18),
    19.61: ((2.29, 4.48, 8.28, 14.3), (69, 129, 203, 185), 0.35),
    25.40: ((2.86, 5.60, 10.4, 18.1), (104, 195, 307, 282), 0.43),
    39.23: ((3.93, 7.73, 14.5, 26.1), (183, 344, 548, 514), 0.60),
}


def forces(p: NDArray[np.float64], at: int, fz: float, inflation: float, slip: float, tan: float,
           friction: float, axle_peak: float, k: float) -> tuple[float, float, float]:
    peak_x, peak_y, slope = mf.limits(p, at, fz, friction, axle_peak)
    alpha, total = mf.combined(slip, tan, (slope / peak_x, k / peak_y))
    bent = mf.shapes(total, *(p[at + place] for place in (
        TIRE.shape_x, TIRE.curvature_x, TIRE.shape_y, TIRE.curvature_y)))
    return mf.forces(p, at, fz, inflation, slip, tan, alpha, total, (slope, k), bent)


def side_force(truck: Packed, at: int, fz: float, degrees: float) -> tuple[float, float]:
    k = mf.cornering_stiffness_nprad(truck.params, at, fz, 1.0)
    tan = math.tan(math.radians(degrees))
    _, fy, mz = forces(truck.params, at, fz, 1.0, 0.0, tan, 1.0, 1.0, k)
    return fy, mz


@pytest.mark.parametrize("load_kn", ACCEPTANCE)
def test_acceptance_loads(truck: Packed, block: Block, load_kn: float) -> None:
    at = block("tire.steer_left")
    forces, moments, relaxation = ACCEPTANCE[load_kn]
    fz = 1000.0 * load_kn
    for degrees, expected in zip((1, 2, 4, 10), forces, strict=True):
        assert side_force(truck, at, fz, degrees)[0] / 1000.0 == pytest.approx(expected, rel=0.008)
    for degrees, moment in zip((1, 2, 4, 8), moments, strict=True):
        assert -side_force(truck, at, fz, degrees)[1] == pytest.approx(moment, rel=0.03)
    k = mf.cornering_stiffness_nprad(truck.params, at, fz, 1.0)
    assert k / truck["tire.steer_left.lateral_stiffness_npm"] == pytest.approx(relaxation, abs=6e-3)


@pytest.mark.parametrize(("load_n", "npdeg"), [(9807, 1203), (19613, 2307), (29420, 3236),
                                               (39227, 3956)])
def test_cornering_stiffness_over_load(truck: Packed, block: Block, load_n: float, npdeg: float
                                       ) -> None:
    k = mf.cornering_stiffness_nprad(truck.params, block("tire.steer_left"), load_n, 1.0)
    assert math.radians(1.0) * k == pytest.approx(npdeg, rel=2e-3)


@pytest.mark.parametrize(("psi", "factor"), [(70, 1.21), (40, 1.39)])
def test_a_softer_tire_first_gets_stiffer(truck: Packed, block: Block, psi: float, factor: float
                                          ) -> None:
    at = block("tire.steer_left")
    full = mf.cornering_stiffness_nprad(truck.params, at, 26_500.0, 1.0)
    soft = mf.cornering_stiffness_nprad(truck.params, at, 26_500.0, psi / 110.0)
    assert soft / full == pytest.approx(factor, abs=0.04)


def test_pressure_below_the_data_changes_nothing_more(truck: Packed, block: Block) -> None:
    at, valid = block("tire.steer_left"), truck["tire.steer_left.pressure_valid"]
    edge = mf.cornering_stiffness_nprad(truck.params, at, 25_000.0, valid)
    assert mf.cornering_stiffness_nprad(truck.params, at, 25_000.0, 0.0) == edge


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(slip=st.floats(-1.0, 1.0), tan=st.floats(-2.0, 2.0), load=st.floats(500.0, 60_000.0),
       friction=st.floats(0.2, 1.2))
def test_combined_force_stays_in_the_friction_ellipse(
        truck: Packed, block: Block, slip: float, tan: float, load: float, friction: float
) -> None:
    p, at, name = truck.params, block("tire.steer_left"), "tire.steer_left."
    k = mf.cornering_stiffness_nprad(p, at, load, 1.0)
    fx, fy, _ = forces(p, at, load, 1.0, slip, tan, friction, 1.0, k)
    d = load / truck[name + "reference_load_n"] - 1.0
    peak_x = max(truck[name + "peak_x"] - truck[name + "peak_x_load"] * d, 0.1) * friction * load
    peak_y = max(truck[name + "peak_y"] - truck[name + "peak_y_load"] * d, 0.1) * friction * load
    assert math.hypot(fx / peak_x, fy / peak_y) <= 1.0 + 1e-9
    assert fx * slip >= 0.0
    assert fy * tan >= 0.0


def test_slopes_at_the_origin_are_the_stiffnesses(truck: Packed, block: Block) -> None:
    p, at, fz = truck.params, block("tire.steer_left"), 27_000.0
    k = mf.cornering_stiffness_nprad(p, at, fz, 1.0)
    fx, _, _ = forces(p, at, fz, 1.0, 1e-6, 0.0, 1.0, 1.0, k)
    _, fy, _ = forces(p, at, fz, 1.0, 0.0, 1e-6, 1.0, 1.0, k)
    assert fx / 1e-6 == pytest.approx(14.0 * fz, rel=1e-4)
    assert fy / 1e-6 == pytest.approx(k, rel=1e-4)


def test_braking_takes_cornering_force_away(truck: Packed, block: Block) -> None:
    p, at, fz = truck.params, block("tire.steer_left"), 25_000.0
    k = mf.cornering_stiffness_nprad(p, at, fz, 1.0)
    sides = [forces(p, at, fz, 1.0, slip, 0.05, 1.0, 1.0, k)[1]
             for slip in np.linspace(0.0, -0.5, 20)]
    assert all(b < a for a, b in pairwise(sides))
    assert sides[-1] < 0.3 * sides[0]


def test_trail_never_shrinks_with_load_nor_changes_its_side(truck: Packed, block: Block) -> None:
    at, loads = block("tire.steer_left"), np.linspace(5e3, 300e3, 60)
    trails = [mf.pneumatic_trail_m(truck.params, at, fz, 1.0, 0.01, math.atan(0.01))
              for fz in loads]
    assert all(b >= a for a, b in pairwise(trails))
    assert trails[-1] == pytest.approx(0.0506, rel=0.02)
