"""A car and a rigid truck are diagnosed with the default settings, as the combination is."""

from __future__ import annotations

import numpy as np
import pytest

from truck_blowout_sim.diagnosis import Diagnosis, diagnose
from truck_blowout_sim.recordings import INPUT_NAMES, Recording, Series
from truck_blowout_sim.simulation.drive import Drive, execute
from truck_blowout_sim.simulation.equilibrium import InitialState
from truck_blowout_sim.simulation.replay import as_recording
from truck_blowout_sim.vehicle import Packed, load_vehicle, pack

STEP_S, LENGTH_S = 0.0025, 9.0
NOISE = {"_vx_mps": 0.01, "_yaw_rate_radps": 3e-4, "_ax_mps2": 0.03, "_ay_mps2": 0.03,
         "_roll_rad": 3e-4, "_radps": 0.05}
# hand wheel [rad] and brake pressure [Pa] of a gentle slalom that ends in braking
GENTLE = {"bmw_320i": (0.25, 0.8e6), "rigid_truck": (0.9, 1.5e5)}


def recorded(truck: Packed, hand_wheel: float, brake_pa: float, seed: int) -> Recording:
    """A drive of nine seconds with noise."""
    t = STEP_S * np.arange(round(LENGTH_S / STEP_S))
    inputs = np.zeros((t.size, len(INPUT_NAMES)))
    inputs[:, 0] = hand_wheel * np.where(t > 1.0, np.sin(2.0 * np.pi * 0.4 * (t - 1.0)), 0.0)
    inputs[:, 1] = 0.1 * (t < 5.5)
    inputs[:, 2:] = (brake_pa * np.clip(2.0 * (t - 5.8), 0.0, 1.0))[:, None]
    none = np.zeros(0, dtype=np.int64)
    drive = Drive(InitialState(speed_mps=22.0), STEP_S, 4, inputs, np.zeros(0), none, none)
    exact = as_recording(f"run_{seed}", truck, drive, execute(truck, drive), ())
    rng = np.random.default_rng(seed)
    channels = {key: exact[key] for key in INPUT_NAMES}
    for key, series in exact.channels.items():
        sigma = next((s for end, s in NOISE.items() if key.endswith(end)), None)
        if sigma is not None and key.startswith(("tractor", "hub_speed")):
            channels[key] = Series(series.time_s, series.value
                                   + sigma * rng.standard_normal(series.value.size))
    return Recording(f"run_{seed}", channels)


def told(vehicle: str, weak: str | None) -> Diagnosis:
    """The answer for a vehicle, the brake of one hub weak in training and on the unseen run."""
    truck = pack(load_vehicle(vehicle))
    wheel, brake_pa = GENTLE[vehicle]
    changed = truck if weak is None else truck.with_values({f"hub.{weak}.brake_gain": 0.3 *
                                                            truck[f"hub.{weak}.brake_gain"]})
    return diagnose([recorded(changed, wheel, brake_pa, 1)],
                    baseline=[recorded(truck, -wheel, 0.8 * brake_pa, 2)],
                    holdout=[recorded(changed, -0.8 * wheel, 0.9 * brake_pa, 3)],
                    vehicle=vehicle, next_run=False)[0]


@pytest.mark.parametrize("vehicle", sorted(GENTLE))
def test_nothing_is_named_of_a_vehicle_that_is_as_modelled(vehicle: str) -> None:
    answer = told(vehicle, None)
    assert answer.verdict in ("consistent", "miscalibrated")
    assert answer.effects == ()


@pytest.mark.parametrize(("vehicle", "hub"), [("bmw_320i", "rear_left"),
                                              ("rigid_truck", "drive_1_right")])
def test_a_weak_brake_is_named_at_its_wheel(vehicle: str, hub: str) -> None:
    answer = told(vehicle, hub)
    assert answer.verdict == "missing_physics"
    effect, = answer.effects
    assert (effect.name, effect.where.hub) == ("brake_imbalance", hub)
