"""Where the model is believed less: after a lost tire, and in turns near the limit of grip.

Baseline runs on sound tires say nothing of a lost one. Near the limit of grip laws of tires differ
most.

Known limits: accelerations are those of the first unit's yaw rate and speed; without both channels
no turn counts as hard; a slope counts as braking.
Validated with: test/diagnosis/test_trust.py, test_comparable.py.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import uniform_filter1d

from truck_blowout_sim.diagnosis.effects.base import GripUsed
from truck_blowout_sim.vehicle import Packed

if TYPE_CHECKING:
    from truck_blowout_sim.diagnosis.case.runs import Run
    from truck_blowout_sim.diagnosis.case.study import Study

Floats = NDArray[np.float64]
BRAKES_ON_PA = 20_000.0
_LASTS_S = 0.5


def comparable_until_s(study: Study, run: Run) -> float:
    """Up to when baseline runs tell how well the model describes a run.

    Where no baseline run is, or one lost a tire too, the whole run counts.
    """
    if not study.baseline or any(study.runs[k].has_blowout for k in study.baseline):
        return float("inf")
    return run.lost_s


def comparable_rows(study: Study, run: Run) -> Floats:
    """[rows] 1 up to then, 0 afterwards."""
    known = run.edges_s[1:] <= comparable_until_s(study, run)
    return np.repeat(known, len(run.channels)).astype(np.float64)


def grip_used(study: Study) -> GripUsed:
    """Shares of the tires' grip that training asks for, by recording or model.

    The harder of both: tires that let go early keep the vehicle from turning or braking hard.
    """
    unit = study.packed.vehicle.units[0]
    names = (f"{unit}_yaw_rate_radps", f"{unit}_vx_mps")
    bin_s = study.settings.bin_s
    hardest: Floats = np.zeros(2)
    for i in study.train:
        run = study.runs[i]
        if names[1] not in run.recording:
            continue
        recorded = run.recording[names[1]]
        speed = np.interp(run.middles_s, recorded.time_s, recorded.value)
        for signals in (run.measured, study.models[i]):
            turns, drives = (signals[:, run.channels.index(name)] if name in run.channels else other
                             for name, other in zip(names, (0.0 * speed, speed), strict=True))
            side, forward = (lasting(one, bin_s) for one in (turns * speed,
                                                             np.gradient(drives, bin_s)))
            hardest = np.maximum(hardest, [np.abs(side).max(initial=0.0),
                                           np.hypot(side, forward).max(initial=0.0)])
    return GripUsed(*np.minimum(hardest / max(grip_mps2(study.packed), 1e-9), 1.0).tolist())


def asked_for_mps2(study: Study, run: Run) -> Floats:
    """[n] side and forward acceleration together that each bin of a recording asks for."""
    unit = study.packed.vehicle.units[0]
    middles = run.middles_s
    rate, speed = (np.interp(middles, run.recording[name].time_s, run.recording[name].value)
                   if name in run.recording else np.zeros(middles.size)
                   for name in (f"{unit}_yaw_rate_radps", f"{unit}_vx_mps"))
    bin_s = study.settings.bin_s
    forward = np.gradient(lasting(speed, bin_s), bin_s)
    return np.hypot(lasting(speed * rate, bin_s), lasting(forward, bin_s))


def lasting(values: Floats, bin_s: float) -> Floats:
    """[n] running mean over half a second; what is not measured is 0."""
    return np.asarray(uniform_filter1d(np.nan_to_num(values), max(round(_LASTS_S / bin_s), 1)))


def grip_mps2(packed: Packed) -> float:
    """Acceleration at which the tires let go, by their sheet."""
    peaks = [packed[f"tire.{tire}.peak_y"] for tire in packed.vehicle.tires]
    return float(np.mean(peaks)) * packed["world.friction_scale"] * packed["world.gravity_mps2"]
