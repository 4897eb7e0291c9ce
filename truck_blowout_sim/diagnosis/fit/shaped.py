"""Whether an event at its own instants stands out of the restless force of `windows.py`.

`windows.py` knows whole seconds and small amounts. Once amount, starts and ends were fitted by
simulation, the event leaves less, and what is left asks for a calmer process. With theta the
amount and all instants, its likelihood is integrated about the best theta (Laplace):

    ln p(r | event) = ln L(process | r - e(theta)) + fall / 2
                      + ln p(theta) + k/2 ln 2 pi - 1/2 ln det H(theta, process)

with the amount N(0, wide^2) and the instants anywhere in the run; whether a run has the event is
open. The odds are averaged with those of `windows.py`, so that two looks are not two chances.

References: MacKay 2003, chapter 28 (Occam factors); Tierney and Kadane 1986 (Laplace).
Known limits: theta is the best without the process, so the odds are somewhat low.
Validated with: test/diagnosis/test_shaped.py (sound trucks; a gust that whole seconds hardly show).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.special import logsumexp

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects import LIBRARY
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.attribute import Ranked
from truck_blowout_sim.diagnosis.fit.event_fit import event_columns, runs_with
from truck_blowout_sim.diagnosis.fit.models import models_at
from truck_blowout_sim.diagnosis.fit.seconds import Seconds

Floats = NDArray[np.float64]


def shaped_support(study: Study, event: Ranked, seconds: Seconds,
                   named: Sequence[Hypothesis] = ()) -> float:
    """Twice the log of the odds of an event that was fitted, whole seconds asked as well.

    Args:
        study: the case; its models have ``named`` in force.
        event: at its best amount and instants, with the support that whole seconds give.
        seconds: what these show.
    """
    h, windows = event.hypothesis, seconds.windows
    if windows.scale <= 0.0 or not h.times:
        return event.support
    residual = study.residual()
    left = study.residual(models_at(study, [h], named)[0])
    projector = seconds.projector
    fall = projector.chi2(residual) - projector.chi2(left)
    columns, _ = event_columns(study, h, named)
    information = columns.T @ np.stack([projector.remove(c) for c in columns.T], axis=1)
    cross = np.stack([seconds.seen_of(study, c) for c in columns.T], axis=1)
    gradient, prior = seconds.seen_of(study, left), _log_prior(study, h, windows.wide)
    found = []
    for process in windows.processes():
        for k, rest in enumerate(process.likelihoods(gradient).tolist()):
            bend = information - cross.T @ process.taken(k) @ cross
            bend[0, 0] += windows.wide**-2
            sign, volume = np.linalg.slogdet(bend)
            if sign > 0.0:
                found.append(rest + 0.5 * fall + prior + 0.5 * (
                    columns.shape[1] * np.log(2.0 * np.pi) - volume))
    if not found:
        return event.support
    # which of its forms it is was free to choose
    forms = sum(one.name == h.effect.name for one in LIBRARY)
    odds = logsumexp(found) - windows.without() - np.log(forms)
    return float(2.0 * (np.logaddexp(odds, 0.5 * event.support) - np.log(2.0)))


def _log_prior(study: Study, event: Hypothesis, wide: float) -> float:
    """Log density of amount and instants, and the odds that just these runs have the event."""
    density = -0.5 * (event.amount / wide)**2 - float(np.log(wide * np.sqrt(2.0 * np.pi)))
    for i in runs_with(study, event):
        # start, and end after it: half of the square of the length
        edges = event.effect.edges
        density -= edges * float(np.log(study.runs[i].length_s)) - float(np.log(edges))
    return density - len(study.train) * float(np.log(2.0))
