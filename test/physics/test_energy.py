"""Energy of the truck changes by exactly what its elements deliver, step by step."""

from __future__ import annotations

import pytest

from truck_blowout_sim.physics.energy import energy_j
from truck_blowout_sim.simulation import InitialState, Truck, load_scenario, prepare
from truck_blowout_sim.simulation.validation.audit import audit
from truck_blowout_sim.vehicle import Packed


@pytest.mark.parametrize("scenario", ["steer_axle_blowout", "trailer_step_steer_right",
                                      "drive_step_steer", "brake_stop", "fishhook", "sine_sweep"])
def test_balance_closes_to_a_thousandth(truck: Packed, scenario: str) -> None:
    packed, drive, _ = prepare(truck, load_scenario(scenario))
    assert audit(packed, drive).closure < 1e-3


def test_balance_closes_with_the_thesis_datasets(thesis: Packed) -> None:
    packed, drive, _ = prepare(thesis, load_scenario("drive_step_steer_right"))
    assert audit(packed, drive).closure < 1e-3


def test_what_only_takes_takes(truck: Packed) -> None:
    packed, drive, _ = prepare(truck, load_scenario("brake_stop"))
    work = audit(packed, drive).work_j
    assert all(work[name] < 0.0 for name in ("slip", "rolling", "brakes", "air", "dampers"))
    # nearly all of the motion ends in the brakes
    assert work["brakes"] < -0.8 * 0.5 * 23_587 * 22.35**2


def test_a_steady_turn_needs_no_damper(truck: Packed) -> None:
    """Dampers of a rolled body in a turn must not work: nothing travels."""
    packed, drive, _ = prepare(truck, load_scenario("trailer_step_steer_no_blowout"))
    work = audit(packed, drive).work_j
    assert abs(work["dampers"]) < 1000.0
    assert work["slip"] < -1e5


def test_kinetic_energy_of_a_rolling_truck(truck: Packed) -> None:
    """1/2 m v^2 and the wheels; heights fall out of the difference to the same truck at rest."""
    energies = []
    for speed in (0.0, 20.0):
        run = Truck(truck, initial=InitialState(speed_mps=speed))
        energies.append(energy_j(run.state, truck.params, truck.topology, run._work))
    mass = sum(truck[n] for n in truck.index if n.endswith(".mass_kg"))
    inertia = sum(truck[n] for n in truck.index if n.endswith("spin_inertia_kgm2"))
    expected = 0.5 * mass * 20.0**2 + 0.5 * inertia * (20.0 / 0.497) ** 2
    assert energies[1] - energies[0] == pytest.approx(expected, rel=3e-3)
