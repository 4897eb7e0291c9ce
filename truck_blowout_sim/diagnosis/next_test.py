"""Which run would tell explanations apart that these recordings cannot: tried by simulation.

Each manoeuvre is driven with either explanation in force. Where they differ most, the sheet numbers
are varied, too: what the recordings leave open of them, and what their joint fit with either
explanation asks of them, is no separation. The rest, in units of what instruments and good models
of one truck differ by, is what the run would show.

Known limits: nuisances linear; an event that cannot be commanded does not happen in the new run,
and effects that begin at an instant and stay are not tried.
Validated with: test/diagnosis/test_next_test.py.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cholesky

from truck_blowout_sim.comparison.words import labels_for
from truck_blowout_sim.diagnosis.attribute import Ranked, with_effects
from truck_blowout_sim.diagnosis.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.linear import Projector
from truck_blowout_sim.diagnosis.refit import models_at
from truck_blowout_sim.diagnosis.runs import Run
from truck_blowout_sim.diagnosis.study import Study, instrument_columns
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.simulation import load_scenario, prepare
from truck_blowout_sim.simulation.drive import Drive, names_of, run_drive
from truck_blowout_sim.simulation.equilibrium import initial_vector

Floats = NDArray[np.float64]
_SCENARIOS = ("coast_down", "brake_stop", "double_lane_change", "sine_sweep",
              "trailer_step_steer_no_blowout")
_SPEED_FACTORS = (0.75, 1.3)  # of a training run, driven again
_LONGEST_S = 15.0
_SLOWEST_MPS = 3.0
_MOST_PROJECTED = 2  # manoeuvres in which nuisances are varied: nearly all of the time
CLEAR_SIGMA = 3.0


@dataclass(frozen=True)
class Separation:
    """What the best of the tried runs would show.

    Attributes:
        pair: the two explanations, the better one first.
        manoeuvre: in words; ``tried``: how many there were to choose from.
        channel: in words, the one that differs most, by ``sigma``.
    """

    pair: tuple[Hypothesis, Hypothesis]
    manoeuvre: str
    channel: str
    sigma: float
    tried: int

    def __str__(self) -> str:
        if self.sigma < CLEAR_SIGMA:
            return (f"None of {self.tried} simulated manoeuvres would separate them by more than "
                    f"{self.sigma:.1f} sigma in a channel recorded here.")
        return (f"Of {self.tried} simulated manoeuvres {self.manoeuvre} separates them best: "
                f"{self.channel} would differ by {self.sigma:.0f} sigma.")


def best_test(study: Study, rivals: Sequence[Ranked], named: Sequence[Hypothesis]
              ) -> Separation | None:
    """The run that best separates an effect from the first that explains as much under a new name.

    Args:
        rivals: an alias set, the accepted effect first; ``named``: all that was accepted.

    Returns:
        None where there is nothing to separate, or no manoeuvre could be tried.
    """
    pair = pair_of(rivals)
    if pair is None:
        return None
    others = [h for h in named if h.key not in {p.key for p in pair}]
    runs = list(_manoeuvres(study))
    models = [_with_either(study, run, pair, others) for run in runs]
    raw = [float(np.linalg.norm(run.change(b, a))) for run, (a, b) in zip(runs, models, strict=True)
           if np.isfinite(a).all() and np.isfinite(b).all()]
    if not raw or len(raw) < len(runs):
        sound = [k for k, (a, b) in enumerate(models)
                 if np.isfinite(a).all() and np.isfinite(b).all()]
        runs, models = [runs[k] for k in sound], [models[k] for k in sound]
    first = np.argsort(raw)[::-1][:_MOST_PROJECTED]
    found = [_separation(study, runs[k], models[k], pair, others, len(runs)) for k in first]
    return max(found, key=lambda s: s.sigma, default=None)


def pair_of(rivals: Sequence[Ranked]) -> tuple[Hypothesis, Hypothesis] | None:
    """The two explanations to separate, of different names if there are such."""
    if len(rivals) < 2:
        return None
    best = rivals[0].hypothesis
    other = next((r.hypothesis for r in rivals[1:]
                  if r.hypothesis.effect.name != best.effect.name), rivals[1].hypothesis)
    timings = [h.effect.timing for h in (best, other) if h.times]
    return None if "step" in timings or len(timings) == 2 else (best, other)
