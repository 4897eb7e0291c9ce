"""Where the model is believed less: a flat tire that was braked, turns near the limit of grip.

Both widen the difference that good models of one truck are allowed, bin by bin.

Known limits: lateral acceleration is that of the first unit's yaw rate and speed; without both
channels no turn counts as hard.
Validated with: test/diagnosis/test_trust.py.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.settings import Settings
from truck_blowout_sim.recordings import INPUT_NAMES, Recording
from truck_blowout_sim.simulation.drive import Drive
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
BRAKES_ON_PA = 20_000.0


def wider(recording: Recording, drive: Drive, packed: Packed, edges_s: Floats,
          settings: Settings) -> Floats:
    """Factor on the difference between models in each bin, 1 where nothing is special."""
    flat = np.where(flat_was_braked(recording, drive, packed, edges_s), settings.flat_braked, 1.0)
    return np.maximum(flat, hard_turn(recording, packed, edges_s, settings))


def flat_was_braked(recording: Recording, drive: Drive, packed: Packed, edges_s: Floats
                    ) -> NDArray[np.bool_]:
    """Bins from which on a tire blown on command has been braked.

    What brakes a flat tire, its grip and its lever, no two models agree on; the speed keeps it.
    """
    vehicle, middles = packed.vehicle, 0.5 * (edges_s[1:] + edges_s[:-1])
    rows = np.clip(((middles - drive.initial.time_s) / drive.step_s).astype(np.int64), 0,
                   drive.inputs.shape[0] - 1)
    braked = np.zeros(middles.size, dtype=np.bool_)
    for event in recording.blowouts:
        for tire in event.tires:
            axle = vehicle.spec.axles[vehicle.axle_of_hub(vehicle.hub_of_tire(tire))]
            column = INPUT_NAMES.index(f"brake_pressure_{axle.circuit}_pa")
            braked |= (middles > event.time_s) & (drive.inputs[rows, column] > BRAKES_ON_PA)
    return np.asarray(np.maximum.accumulate(braked))


def hard_turn(recording: Recording, packed: Packed, edges_s: Floats, settings: Settings) -> Floats:
    """Factor by how hard the truck turns: near the limit each model's tire has its own curve.

    It counts for as long as a difference lasts, before and after.
    """
    unit = packed.vehicle.units[0]
    names = (f"{unit}_yaw_rate_radps", f"{unit}_vx_mps")
    if not all(name in recording for name in names):
        return np.ones(edges_s.size - 1)
    middles = 0.5 * (edges_s[1:] + edges_s[:-1])
    rate, speed = (np.interp(middles, recording[n].time_s, recording[n].value) for n in names)
    around = max(round(settings.correlation_s / settings.bin_s), 1)
    sharpest = np.array([np.max(np.abs(rate * speed)[max(k - around, 0):k + around + 1])
                         for k in range(middles.size)])
    return np.asarray(1.0 + settings.hard_growth_s2pm * np.maximum(
        sharpest - settings.hard_from_mps2, 0.0))
