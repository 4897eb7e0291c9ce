"""Accelerations free of gravity are compared with the model's that are."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.runs import prepare_run
from truck_blowout_sim.diagnosis.settings import Settings
from truck_blowout_sim.recordings import Recording, Series
from truck_blowout_sim.recordings.gravity import ACCELERATIONS, gravity_felt
from truck_blowout_sim.simulation.drive import run_drive
from truck_blowout_sim.vehicle import Packed

UNITS = ("tractor", "trailer")


def leveled(run: Recording) -> Recording:
    """The same log as an inertial unit writes it that knows its tilt."""
    free = {}
    for unit in UNITS:
        rolled = run[f"{unit}_roll_rad"]
        for name in (f"{unit}_{stem}" for stem in ACCELERATIONS if f"{unit}_{stem}" in run):
            felt = gravity_felt(name.partition("_")[2], rolled.value, np.zeros(len(rolled)))
            free[name] = Series(rolled.time_s, run[name].value - felt)
    return run.with_channels(free).with_metadata(accelerometers="gravity removed")


def test_the_same_motion_leaves_the_same(
    drive_it: Callable[..., Recording], truck: Packed, few: Settings
) -> None:
    turned = drive_it()
    given, level = (prepare_run(one, "train", truck, few, step_s=0.0025)
                    for one in (turned, leveled(turned)))
    out = run_drive(truck, given.drive)
    assert "ay_mps2" in {one.stem for one in level.leaning}
    assert given.leaning == ()
    k = given.channels.index("trailer_ay_mps2")
    leaned = given.measured[:, k] - level.measured[:, k]
    assert np.ptp(leaned) > 0.05
    left, right = (run.measured[:, k] - run.bins_of(out)[:, k] for run in (given, level))
    # what is left is noise of the accelerometer, and of the tilt times gravity
    assert np.std(right - left) < 0.02
    assert right == pytest.approx(left, abs=0.05)
