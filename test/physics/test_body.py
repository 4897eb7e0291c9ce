"""A sprung body alone: free fall, free spin, added masses, frame twist."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from truck_blowout_sim.physics import body
from truck_blowout_sim.physics.layout import STATE_UNIT_AT, UNIT, UNIT_AT, UNIT_S, UNIT_W
from truck_blowout_sim.physics.rotation import fill_rotation, to_body, to_map
from truck_blowout_sim.physics.step import move_unit
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
S, A = STATE_UNIT_AT, UNIT_AT
AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def accelerations(state: Floats, work: Floats) -> Floats:
    body.solve_unit(state, S, work, 0)
    return state[S + UNIT_S.ax_mps2:S + UNIT_S.rdot_radps2 + 1].copy()


def test_a_body_without_forces_falls_freely(truck: Packed, state: Floats, work: Floats) -> None:
    state[S + UNIT_S.pitch_rad], state[S + UNIT_S.roll_rad] = 0.1, -0.2
    fill_rotation(state, S, work, 0)
    g = to_body(work, 0, 0.0, 0.0, -9.81)
    body.start_unit(state, S, truck.params, A, work, 0, g)
    assert accelerations(state, work) == pytest.approx([*g, 0.0, 0.0, 0.0], abs=1e-12)


def test_free_spin_keeps_angular_momentum_and_energy(truck: Packed, state: Floats, work: Floats
                                                     ) -> None:
    p = truck.params
    inertia = np.array([[p[A + UNIT.ixx_kgm2], -p[A + UNIT.ixy_kgm2], -p[A + UNIT.ixz_kgm2]],
                        [-p[A + UNIT.ixy_kgm2], p[A + UNIT.iyy_kgm2], -p[A + UNIT.iyz_kgm2]],
                        [-p[A + UNIT.ixz_kgm2], -p[A + UNIT.iyz_kgm2], p[A + UNIT.izz_kgm2]]])
    state[S + UNIT_S.p_radps:S + UNIT_S.r_radps + 1] = 0.4, 0.1, -0.3

    def momentum() -> tuple[Floats, float]:
        w = state[S + UNIT_S.p_radps:S + UNIT_S.r_radps + 1]
        fill_rotation(state, S, work, 0)
        return np.array(to_map(work, 0, *(inertia @ w))), float(w @ inertia @ w)

    start, energy = momentum()
    dt = 1e-4
    for _ in range(20_000):
        fill_rotation(state, S, work, 0)
        body.start_unit(state, S, p, A, work, 0, (0.0, 0.0, 0.0))
        accelerations(state, work)
        move_unit(state, S, work, 0, dt)
    end, energy_end = momentum()
    assert energy_end == pytest.approx(energy, rel=1e-3)
    assert end == pytest.approx(start, abs=2e-3 * float(np.linalg.norm(start)))


def test_a_mass_carried_in_all_directions_is_a_point_mass(truck: Packed, state: Floats,
                                                          work: Floats) -> None:
    """Composite of body and point mass: its own center of gravity, its own inertia."""
    p = truck.params
    m, point, mass = p[A + UNIT.mass_kg], np.array([1.5, -0.4, 0.3]), 2000.0
    force, lever = np.array([1e4, -5e3, 2e3]), np.array([0.2, 0.7, -0.5])
    body.start_unit(state, S, p, A, work, 0, (0.0, 0.0, 0.0))
    for axis in AXES:
        body.add_inertia_along(work, 0, mass, axis, tuple(point))
    body.add_force(work, 0, tuple(force), tuple(lever))
    found = accelerations(state, work)
    center = mass * point / (m + mass)
    own = np.diag([p[A + UNIT.ixx_kgm2], p[A + UNIT.iyy_kgm2], p[A + UNIT.izz_kgm2]])
    for i, j, name in ((0, 1, "ixy"), (0, 2, "ixz"), (1, 2, "iyz")):
        own[i, j] = own[j, i] = -p[A + getattr(UNIT, f"{name}_kgm2")]

    def steiner(weight: float, r: Floats) -> Floats:
        return weight * (float(r @ r) * np.eye(3) - np.outer(r, r))

    inertia = own + steiner(m, -center) + steiner(mass, point - center)
    turn = np.linalg.solve(inertia, np.cross(lever - center, force))
    linear = force / (m + mass) + np.cross(turn, -center)
    assert found == pytest.approx(np.concatenate([linear, turn]), rel=1e-10)


def test_a_mass_carried_in_one_direction_resists_that_one_alone(truck: Packed, state: Floats,
                                                                work: Floats) -> None:
    p = truck.params
    m = p[A + UNIT.mass_kg]
    body.start_unit(state, S, p, A, work, 0, (0.0, 0.0, 0.0))
    body.add_inertia_along(work, 0, m, AXES[0], (0.0, 0.0, 0.0))
    body.add_force(work, 0, (m, m, m), (0.0, 0.0, 0.0))
    assert accelerations(state, work)[:3] == pytest.approx([0.5, 1.0, 1.0])


def test_a_held_twist_is_moment_over_stiffness(truck: Packed, state: Floats, work: Floats,
                                               block: Callable[[str], int]) -> None:
    a, k = block("unit.tractor"), 400e3
    soft = truck.with_values({"unit.tractor.torsion_front_nmprad": k})
    for _ in range(5000):
        work[UNIT_W.front_nm], work[UNIT_W.front_nmprad] = 4000.0, 0.0
        work[UNIT_W.rear_nm], work[UNIT_W.rear_nmprad] = 0.0, 0.0
        body.twist_frame(state, S, soft.params, a, work, 0, 0.001)
    assert state[S + UNIT_S.twist_front_rad] == pytest.approx(4000.0 / k, rel=1e-6)
    assert state[S + UNIT_S.twist_rear_rad] == 0.0


def test_a_load_that_moves_pushes_its_unit_back(truck: Packed, state: Floats, work: Floats,
                                                block: Callable[[str], int]) -> None:
    """Nothing acts from outside: the common center of gravity stays where it is."""
    start_s, duration_s, shift_m = -0.2, 0.8, 0.3
    values = {"unit.trailer.shift_y_m": shift_m, "unit.trailer.shift_start_s": start_s,
              "unit.trailer.shift_duration_s": duration_s}
    p, a = truck.with_values(values).params, block("unit.trailer")
    body.start_unit(state, S, p, a, work, 0, (0.0, 0.0, 0.0))
    pulled_mps2 = (6.0 - 12.0 * 0.25) * shift_m / duration_s**2  # a quarter of the way in time
    share = p[a + UNIT.payload_kg] / p[a + UNIT.mass_kg]
    found = accelerations(state, work)
    assert found[1] == pytest.approx(-share * pulled_mps2)
    assert found[5] * p[a + UNIT.payload_x_m] < 0.0  # it turns the end that it stands on aside


def test_a_shifted_payload_moves_the_center_of_gravity(truck: Packed, state: Floats, work: Floats,
                                                       block: Callable[[str], int]) -> None:
    """A force at the new center of gravity of the whole does not turn it."""
    values = {"unit.trailer.shift_x_m": 1.0, "unit.trailer.shift_y_m": 0.3,
              "unit.trailer.shift_start_s": -10.0, "unit.trailer.shift_duration_s": 1.0}
    p, a = truck.with_values(values).params, block("unit.trailer")
    m, load = p[a + UNIT.mass_kg], p[a + UNIT.payload_kg]
    body.start_unit(state, S, p, a, work, 0, (0.0, 0.0, 0.0))
    at = (load * 1.0 / m, load * 0.3 / m, 0.0)
    body.add_force(work, 0, (0.0, 1e4, 0.0), at)
    found = accelerations(state, work)
    assert found[5] == pytest.approx(0.0, abs=1e-9)
    assert found[1] == pytest.approx(1e4 / m)
