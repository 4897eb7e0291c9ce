"""What is named must help where it is used: its vehicle is driven over the unseen runs.

A prediction lets the numbers of the sheet follow what is named; a vehicle file has one value of
each, and is driven where the model is no longer linear. So the last that was named is taken back as
long as the vehicle with it predicts the unseen runs that can show it worse than the calibrated one,
and no channel clearly better: what acts shows somewhere.

References: Stone 1974 (a model is judged by what it predicts).
Known limits: an event begins at another instant in each run, so a case with one is not asked; an
effect that no unseen run could show is believed without.
Validated with: test/diagnosis/test_driving.py.
"""

from __future__ import annotations

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.model.vehicle import diagnosed_truck
from truck_blowout_sim.diagnosis.name.judging import Found, note, predict_with
from truck_blowout_sim.diagnosis.name.trial import Fate
from truck_blowout_sim.diagnosis.prove.unseen import gained
from truck_blowout_sim.vehicle import Packed

_CLEARLY = 0.7  # of a logarithm: half of the squares


def take_back(study: Study, found: Found, given: Packed) -> None:
    """Keep of ``found`` what makes the unseen runs better when its vehicle is driven.

    ``given``: the truck before the diagnosis.
    """
    without = None
    while found.named and study.holdout:
        named = [one.hypothesis for one in found.named]
        runs = [k for k, run in enumerate(study.holdout) if run.shows(named[-1].effect.applies)]
        if not runs or any(h.effect.timed for h in named):
            return
        without = without or diagnosed_truck(study, given, found.models_null, ())
        with_them = diagnosed_truck(study, given, study.models, named)
        gain = gained(study, runs, without.packed, with_them.packed)
        if gain.all_channels > 0.0 or gain.best > _CLEARLY:
            return
        note(found, found.named.pop(), Fate("driven", gain.all_channels))
        found.rivals.pop()
        named.pop()
        study.models, found.after = predict_with(study, named)
        found.chi2_after = study.projector(named).chi2(study.residual())
