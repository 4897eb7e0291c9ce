"""Holdout errors of the rivals beside those of the diagnosed model, on the same runs and scale.

Errors are mean squares over the motion channels, in instrument noise squared, so that 1 is as good
as the instruments. Rivals:

- ``no_change``: the vehicle as its sheet says;
- ``recalibrated``: all spec-sheet numbers and mounting errors fitted to baseline and training runs
  together, within three prior sigmas, nothing added;
- ``gaussian_process``: what that leaves in training, learned as a function of commands and motion;
- ``sparse_regression``: the same as a sparse law of residual accelerations, integrated over time.

Known limits: one set of features for all cases; recordings are taken as they are, without the
diagnosis's correction of instruments, so cases with a faulty instrument compare unlike things.
Validated with: test/proof/test_baselines.py.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.calibration import calibrate
from truck_blowout_sim.diagnosis.case.recorded import Recorded
from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.case.study import row_ranges
from truck_blowout_sim.diagnosis.effort import USUAL
from truck_blowout_sim.diagnosis.prove.holdout import predict
from truck_blowout_sim.diagnosis.settings import load_settings
from truck_blowout_sim.proof.baselines.features import Stretch, inputs_of, motion_columns
from truck_blowout_sim.proof.baselines.gaussian_process import predict_residual
from truck_blowout_sim.proof.baselines.sparse_regression import fit_law, integrate
from truck_blowout_sim.proof.memory import Memory
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.vehicle import load_vehicle, pack

Floats = NDArray[np.float64]
_WORST = 1e8  # mean square written where a rival ran away


def baseline_errors(train: Sequence[Recording], baseline: Sequence[Recording],
                    holdout: Sequence[Recording], vehicle: str, step_s: float,
                    diagnosed: Mapping[str, float], memory: Memory | None = None
                    ) -> dict[str, float]:
    """Mean square on holdout of each rival, and of the diagnosed model from its rms by channel.

    ``vehicle``: that of the diagnosis. ``memory``: knows what this has simulated already.
    """
    packed = pack(load_vehicle(vehicle))
    rules = load_settings(packed)
    study = Recorded(train, baseline, holdout, packed, rules,
                     replace(USUAL, step_s=step_s)).study()
    study.simulated = (memory or Memory()).simulated
    plain = study.simulate([(run, packed) for run in study.holdout])
    calibrate(study)
    residual = study.residual()
    predicted = predict(study, residual, ())
    amounts = np.clip(study.projector().amounts(residual), -3.0, 3.0)
    clean, rows = residual - study.columns @ amounts, row_ranges(study)
    learned = [stretch(study.runs[i], clean[rows[i]].reshape(study.runs[i].measured.shape))
               for i in study.train]
    unseen = [stretch(run, p.left) for run, p in zip(study.holdout, predicted, strict=True)]
    names = tuple(sorted(set.intersection(*(set(s.names) for s in (*learned, *unseen)))))
    law = fit_law(learned, names)
    errors = {
        "no_change": mean_square([unchanged(run, model) for run, model in zip(
            study.holdout, plain, strict=True)], names),
        "recalibrated": mean_square(unseen, names),
        "gaussian_process": mean_square(
            [s.less(predict_residual(learned, s, names), names) for s in unseen], names),
        "sparse_regression": mean_square(
            [s.less(integrate(law, s, names), names) for s in unseen], names),
    }
    ours = [diagnosed[n] ** 2 for n in names if n in diagnosed]
    if len(ours) == len(names) and ours:
        errors["diagnosed"] = float(np.mean(ours))
    return errors


def unchanged(run: Run, model: Floats) -> Stretch:
    """What a model [n, m] of the whole run leaves of it, as far as the run counts."""
    counted = model[:run.measured.shape[0]]
    return stretch(run, run.residual(counted).reshape(run.measured.shape))


def stretch(run: Run, whitened: Floats) -> Stretch:
    """The motion residuals of a run in SI with their noise and the inputs at the bins."""
    columns = motion_columns(run.channels)
    return Stretch(tuple(run.channels[k] for k in columns),
                   np.where(np.isfinite(run.measured), run.plain(whitened), np.nan)[:, columns],
                   run.noise[:, columns], inputs_of(run),
                   float(run.edges_s[1] - run.edges_s[0]))


def mean_square(stretches: Sequence[Stretch], names: Sequence[str]) -> float:
    """Mean over channels of the mean square residual over noise; bounded where it ran away."""
    total = []
    for name in names:
        z = np.concatenate([s.column(name) / s.noise_of(name) for s in stretches])
        z = z[~np.isnan(z)]
        if z.size:
            total.append(float(np.mean(np.clip(z, -1e4, 1e4) ** 2)))
    return min(float(np.mean(total)), _WORST)
