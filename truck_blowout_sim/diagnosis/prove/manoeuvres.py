"""Runs that could be driven next, prepared like recorded ones: same channels, noise and bins."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Blowout, Recording
from truck_blowout_sim.simulation import load_scenario, prepare
from truck_blowout_sim.simulation.drive import Drive, names_of, run_drive
from truck_blowout_sim.simulation.equilibrium import initial_vector

Floats = NDArray[np.float64]
# with the share of its brake pressures: a wheel that locks tells nothing about small differences
_SCENARIOS = {"coast_down": 1.0, "brake_stop": 0.4, "double_lane_change": 1.0, "sine_sweep": 1.0,
              "trailer_step_steer_no_blowout": 1.0}
_SPEED_FACTORS = (0.75, 1.3)  # of the first training run, driven again
_LONGEST_S = 15.0
_SLOWEST_MPS = 3.0  # a run ends there
_FEWEST_BINS = 20


def manoeuvres(study: Study) -> Iterator[Run]:
    """Shipped scenarios without their blowouts, and the first training run at other speeds.

    A run's recording holds no channels; its name says in words what would be driven.
    """
    like = study.runs[study.train[0]]
    for name, share in _SCENARIOS.items():
        try:
            scenario = load_scenario(name).with_blowouts(())
            _, drive, _ = prepare(study.packed, scenario, step_s=like.drive.step_s)
        except InputError:
            continue  # not with this vehicle
        words = f"{name} ({scenario.title.partition(',')[0]})"
        words += "" if share == 1.0 else f" with {100.0 * share:.0f} percent of its brake pressure"
        braked = drive.inputs * np.where(np.arange(drive.inputs.shape[1]) < 2, 1.0, share)
        run = _prepared(study, words, replace(drive, inputs=braked), ())
        if run is not None:
            yield run
    for factor in () if like.drive.speed_imposed else _SPEED_FACTORS:
        speed_mps = factor * like.drive.initial.speed_mps
        initial = replace(like.drive.initial, speed_mps=speed_mps)
        run = _prepared(study, f"{like.recording.name} again from {speed_mps:.0f} m/s",
                        replace(like.drive, initial=initial), like.recording.blowouts)
        if run is not None:
            yield run


def _prepared(study: Study, words: str, drive: Drive, blowouts: tuple[Blowout, ...]
              ) -> Run | None:
    """The reference truck's drive on bins; None if it falls over or is over at once."""
    like, rules, start_s = study.runs[study.train[0]], study.settings, drive.initial.time_s
    drive = replace(drive, inputs=drive.inputs[:round(_LONGEST_S / drive.step_s)],
                    warm=initial_vector(study.packed, drive.initial, drive.step_s))
    out = run_drive(study.packed, drive)
    slow = out[:, names_of(study.packed.vehicle).index("tractor_vx_mps")] < _SLOWEST_MPS
    end_s = drive.times_s[int(np.argmax(slow)) if slow.any() else -1]
    n = int((end_s - start_s - rules.skip_s) / rules.bin_s)
    if n < _FEWEST_BINS or not np.isfinite(out).all():
        return None
    edges: Floats = start_s + rules.skip_s + rules.bin_s * np.arange(n + 1, dtype=np.float64)
    none = np.zeros((n, len(like.channels)))
    run = Run(Recording(words, {}, blowouts), "holdout", drive, like.channels, like.columns, edges,
              none, none, none, drive, none, like.color, leaning=like.leaning)
    base = run.bins_of(out)
    noise = np.broadcast_to(np.nanmedian(like.noise, axis=0), base.shape)
    return replace(run, measured=base, noise=noise).weighed(base, rules)
