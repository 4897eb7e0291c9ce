"""The car of another simulator: its own functions, its own numbers, and the file that models it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from truck_blowout_sim.vehicle import load_vehicle, pack

pytest.importorskip("vehiclemodels")

from proving_ground.car.channels import gyros
from proving_ground.car.effects import CAR_LISTED, CAR_UNLISTED, combine
from proving_ground.car.forces import engine, outside
from proving_ground.car.individual import draw, nominal
from proving_ground.car.manoeuvres import KINDS, CarDriver, make
from proving_ground.car.rig import CarRig
from proving_ground.worlds import world_cases


def test_our_parameters_move_the_foreign_model_as_its_own_do() -> None:
    from vehiclemodels.init_mb import init_mb
    from vehiclemodels.parameters_vehicle2 import parameters_vehicle2
    from vehiclemodels.vehicle_dynamics_mb import vehicle_dynamics_mb

    own, ours = parameters_vehicle2(), nominal().parameters()
    state = init_mb([0.0, 0.0, 0.03, 20.0, 0.1, 0.15, 0.01], own)
    there = vehicle_dynamics_mb(list(state), [0.1, -2.0], own)
    here = vehicle_dynamics_mb(list(state), [0.1, -2.0], ours)
    assert np.allclose(there, here)


def test_the_vehicle_file_states_the_published_car() -> None:
    published, packed = nominal().car, pack(load_vehicle("bmw_320i"))
    assert packed["unit.tractor.mass_kg"] == pytest.approx(published["m_s"], rel=1e-4)
    assert packed["unit.tractor.ixx_kgm2"] == pytest.approx(published["I_Phi_s"], rel=1e-3)


def test_the_engine_cuts_out_where_the_wheels_turn_as_fast_as_at_top_speed() -> None:
    numbers, state = nominal().parameters(), np.zeros(29)
    state[3] = 20.0
    for tread_mps, share in ((20.0, 1.0), (50.8, 1.0), (50.8 * 1.025, 0.5), (60.0, 0.0)):
        state[25:27] = tread_mps / numbers.R_w
        given = engine(state, numbers, 0.5)
        assert given == pytest.approx(share * 0.5 * 110e3 / 20.0 / numbers.m)


def test_cars_differ_and_repeat() -> None:
    assert draw(5).car == draw(5).car
    assert draw(5).car != draw(6).car
    assert draw(5).car["m"] == pytest.approx(nominal().car["m"], rel=0.021)


@pytest.mark.parametrize("name", sorted({**CAR_LISTED, **CAR_UNLISTED}))
def test_every_effect_sets_something(name: str) -> None:
    kind = {**CAR_LISTED, **CAR_UNLISTED}[name]
    still, _ = combine([])
    for law in range(1 + len(kind.others)):
        acts, tires = combine([kind.by_law(law)(0.5, kind.places[0], 1.0, 50.0)])
        changed = [key for key, value in acts._asdict().items()
                   if not np.array_equal(value, getattr(still, key))]
        assert changed or tires


def test_every_manoeuvre_of_a_case_exists() -> None:
    for kinds in KINDS.values():
        for kind in kinds:
            assert 5.0 < make(kind, 3).duration_s < 20.0
    assert {case.truth for case in world_cases("w3", 0, 24)} == {"w3"}


def test_gyros_of_a_rolled_car_in_a_steady_turn_show_pitching_too() -> None:
    nothing, roll = np.zeros(1), np.array([0.06])
    yaw_rate, roll_rate, pitch_rate = gyros(roll, nothing, nothing, nothing, np.array([0.2]))
    assert roll_rate[0] == 0.0
    assert pitch_rate[0] == pytest.approx(0.2 * np.sin(0.06))
    assert yaw_rate[0] == pytest.approx(0.2 * np.cos(0.06))


def test_rates_belong_to_the_states_of_the_same_row() -> None:
    """Else accelerometers would be late, or early, beside the speeds."""
    rig, manoeuvre = CarRig(replace(nominal(), bumps_seed=0)), make("lane_change", 3)
    truth = rig.drive(manoeuvre, *combine([]), CarDriver(manoeuvre, 3))
    yaw_rate = truth.states[:, 5]
    changes = np.gradient(yaw_rate, 0.01)[5:-5]
    turned = truth.rates[:, 5]
    before, here, after = (float(np.var(changes - turned[5 + k:len(turned) - 5 + k]))
                           for k in (-1, 0, 1))
    best = 0.5 * (before - after) / (before - 2.0 * here + after)  # of the parabola, in samples
    assert abs(best) < 0.2


def test_a_bank_becomes_a_grade_for_a_car_that_turned() -> None:
    """As the angles that it reads do."""
    yaw, bank, acts = 1.2, 0.06, combine([])[0]
    state, still = np.zeros(29), np.zeros((2, 29))
    state[3], state[4] = 20.0, -yaw
    for forces, slope in zip(still, (0.0, bank), strict=True):
        outside(forces, state, np.zeros(37), nominal().parameters(), acts,
                np.array([0.0, 0.0, 0.0, 0.0, slope, 0.5]))
    changed = still[1] - still[0]
    assert changed[3] == pytest.approx(-9.81 * np.sin(bank * np.sin(yaw)))
    assert changed[10] == pytest.approx(9.81 * np.sin(bank * np.cos(yaw)))
