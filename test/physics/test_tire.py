from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from truck_blowout_sim.physics.layout import TIRE, TIRE_S
from truck_blowout_sim.physics.tires import magic_formula
from truck_blowout_sim.physics.tires.lanes import LANE, LANE_BLOCK
from truck_blowout_sim.physics.tires.tire import tire_at_load
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
Block = Callable[[str], int]
Slot = Callable[[str, str], int]
FZ, SPEED = 25_000.0, 20.0


def force(truck: Packed, state: Floats, s: int, t: int, *, vx: float = SPEED, vy: float = 0.0,
          roll: float | None = None, rim: float = 0.0, camber: float = 0.0, fz: float = FZ,
          axle_peak: float = 1.0) -> tuple[float, float, float]:
    """Forces of one tire after a step of 1 ms, its slips kept in the state, its load given."""
    lanes = np.zeros(LANE_BLOCK)
    lanes[[LANE.vx_mps, LANE.vy_mps, LANE.sin_camber]] = vx, vy, np.sin(camber)
    lanes[[LANE.friction, LANE.axle_peak, LANE.radius_m]] = 1.0, axle_peak, 1.0
    lanes[LANE.spin_radps] = vx if roll is None else roll
    lanes[[LANE.pressure_pa, LANE.rim, LANE.fz_n]] = state[s + TIRE_S.pressure_pa], rim, fz
    lanes[[LANE.slip, LANE.slip_tan]] = state[s + TIRE_S.slip], state[s + TIRE_S.slip_tan]
    tire_at_load(truck.params, t, 0, lanes, 0, 0.001)
    state[s + TIRE_S.slip], state[s + TIRE_S.slip_tan] = lanes[[LANE.slip, LANE.slip_tan]]
    return tuple(lanes[[LANE.fx_n, LANE.fy_n, LANE.mz_nm]].tolist())


@pytest.fixture
def inflated(truck: Packed, state: Floats, slot: Slot) -> tuple[Floats, int]:
    s = slot("tire", "steer_left")
    state[s + TIRE_S.pressure_pa] = truck["tire.steer_left.pressure_pa"]
    return state, s


def test_after_a_while_the_lag_is_gone(truck: Packed, inflated: tuple[Floats, int], block: Block
                                       ) -> None:
    (state, s), t = inflated, block("tire.steer_left")
    for _ in range(2000):
        fx, fy, mz = force(truck, state, s, t, vy=-0.03 * SPEED, roll=1.01 * SPEED)
    k = magic_formula.cornering_stiffness_nprad(truck.params, t, FZ, 1.0)
    peak_x, peak_y, slope = magic_formula.limits(truck.params, t, FZ, 1.0, 1.0)
    alpha, total = magic_formula.combined(0.01, 0.03, (slope / peak_x, k / peak_y))
    bent = magic_formula.shapes(total, *(truck.params[t + at] for at in (
        TIRE.shape_x, TIRE.curvature_x, TIRE.shape_y, TIRE.curvature_y)))
    steady = magic_formula.forces(truck.params, t, FZ, 1.0, 0.01, 0.03, alpha, total, (slope, k),
                                  bent)
    assert (fx, fy, mz) == pytest.approx(steady, rel=1e-6)


@pytest.mark.parametrize("speed", [5.0, 25.0])
def test_side_force_builds_over_a_rolled_distance(truck: Packed, inflated: tuple[Floats, int],
                                                  block: Block, speed: float) -> None:
    """63 % after one relaxation length, whatever the speed."""
    (state, s), t = inflated, block("tire.steer_left")
    k = magic_formula.cornering_stiffness_nprad(truck.params, t, FZ, 1.0)
    length = k / truck["tire.steer_left.lateral_stiffness_npm"]
    for _ in range(round(length / speed / 0.001)):
        _, fy, _ = force(truck, state, s, t, vx=speed, vy=-0.001 * speed)
    assert fy / (0.001 * k) == pytest.approx(1.0 - np.exp(-1.0), abs=0.02)


def test_a_standing_tire_is_a_spring(truck: Packed, inflated: tuple[Floats, int], block: Block
                                     ) -> None:
    """Pushed sideways by 1 mm it resists with its carcass stiffness."""
    (state, s), t = inflated, block("tire.steer_left")
    for _ in range(1000):
        force(truck, state, s, t, vx=0.0, vy=-0.001, roll=0.0)
    _, fy, _ = force(truck, state, s, t, vx=0.0, vy=0.0, roll=0.0)
    assert fy == pytest.approx(0.001 * truck["tire.steer_left.lateral_stiffness_npm"], rel=0.02)


def test_a_flat_tire_keeps_its_share_of_cornering(truck: Packed, inflated: tuple[Floats, int],
                                                  block: Block) -> None:
    (state, s), t = inflated, block("tire.steer_left")
    whole = [force(truck, state, s, t, vy=-0.005 * SPEED)[1] for _ in range(1000)][-1]
    flat = [force(truck, state, s, t, vy=-0.005 * SPEED, rim=1.0)[1] for _ in range(1000)][-1]
    assert flat / whole == pytest.approx(truck["tire.steer_left.flat_cornering"], rel=1e-3)


def test_camber_thrust_points_where_the_wheel_leans(truck: Packed, inflated: tuple[Floats, int],
                                                    block: Block) -> None:
    """About 55 N a degree at 26.5 kN; positive camber leans the top to the left."""
    (state, s), t = inflated, block("tire.steer_left")
    _, fy, _ = force(truck, state, s, t, camber=np.radians(1.0), fz=26_500.0)
    assert fy == pytest.approx(55.5, abs=1.0)


def test_a_tire_in_the_air_gives_no_force(truck: Packed, inflated: tuple[Floats, int], block: Block
                                          ) -> None:
    (state, s), t = inflated, block("tire.steer_left")
    assert force(truck, state, s, t, vy=-2.0, roll=0.0, fz=0.0) == (0.0, 0.0, 0.0)


def test_in_reverse_the_trail_lies_on_the_other_side(truck: Packed, inflated: tuple[Floats, int],
                                                     block: Block) -> None:
    (state, s), t = inflated, block("tire.steer_left")
    ends = {}
    for vx in (SPEED, -SPEED, 0.0):
        for _ in range(1500):
            _, fy, mz = force(truck, state, s, t, vx=vx, vy=-0.03 * abs(vx))
        ends[vx] = fy, mz
    assert ends[-SPEED][0] == pytest.approx(ends[SPEED][0], rel=1e-6)
    assert ends[-SPEED][1] == pytest.approx(-ends[SPEED][1], rel=1e-6)
    assert ends[0.0][1] == 0.0


@pytest.mark.parametrize("camber", [0.0, 0.05])
@pytest.mark.parametrize("rim", [0.0, 1.0])
@pytest.mark.parametrize("axle_peak", [0.7, 1.3])
@pytest.mark.parametrize("fz", [0.4 * FZ, 1.6 * FZ])
def test_the_most_side_force_is_the_formulas_peak(
    truck: Packed, inflated: tuple[Floats, int], block: Block, fz: float, axle_peak: float,
    rim: float, camber: float
) -> None:
    """At light loads and large ones, on an axle with other grip, flat, with camber thrust."""
    (state, s), t = inflated, block("tire.steer_left")
    peak = magic_formula.limits(truck.params, t, fz, 1.0, axle_peak)[1]
    kept = 1.0 - rim * (1.0 - truck["tire.steer_left.flat_cornering"])
    most = 0.0
    for tan in np.linspace(0.02, 1.5, 60):
        for _ in range(400):
            fy = force(truck, state, s, t, vy=-tan * SPEED, roll=SPEED, rim=rim, camber=camber,
                       fz=fz, axle_peak=axle_peak)[1]
        most = max(most, fy)
    assert most == pytest.approx(kept * peak, rel=2e-3)


def test_grip_falls_with_the_load(truck: Packed, inflated: tuple[Floats, int], block: Block
                                  ) -> None:
    """Below the reference load as above it: the loss per load is the file's, with mu of Fz."""
    (state, s), t = inflated, block("tire.steer_left")
    grips = []
    for fz in (0.4 * FZ, 0.8 * FZ, 1.2 * FZ):
        most = 0.0
        for tan in np.linspace(0.05, 0.6, 40):
            for _ in range(400):
                most = max(most, force(truck, state, s, t, vy=-tan * SPEED, roll=SPEED, fz=fz)[1])
        grips.append(most / fz)
    loss = truck["tire.steer_left.peak_y_load"] * truck["tire.steer_left.friction_scale"]
    step = 0.4 * FZ / truck["tire.steer_left.reference_load_n"]
    assert np.diff(grips) == pytest.approx([-loss * step] * 2, rel=0.03)
