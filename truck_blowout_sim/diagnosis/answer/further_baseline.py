"""Which further run of the truck in order would let smaller effects be seen.

What a model is off by is known where baseline runs ask of the truck what training asks. A fault at
the limit of grip is hidden by the form of the tire model as long as only training goes there.

References: see `driven.py`. Two more baseline runs, driven as training, let 17 of 40 effects be
named that were missed without them (docs/proof.md).
Validated with: test/diagnosis/test_further_baseline.py.
"""

from __future__ import annotations

import numpy as np

from truck_blowout_sim.diagnosis.case.driven import driven
from truck_blowout_sim.diagnosis.case.study import Study

ALIKE = 0.9  # likeness from which on runs ask the same of the truck


def further_baseline(study: Study) -> str:
    """What to record, in words; empty where every training run has a baseline run like it."""
    if not study.baseline:
        return ("Record runs of the same vehicle with nothing missing, driven as these were: "
                "without such baseline runs only large effects show.")
    manners = np.array(driven(study)[:len(study.runs)])
    likeness = (manners[list(study.train)] @ manners[list(study.baseline)].T).max(axis=1)
    least = int(np.argmin(likeness))
    if likeness[least] >= ALIKE:
        return ""
    name = study.runs[study.train[least]].recording.name
    return (f"Record a baseline run driven as {name} was: no baseline run asks of the vehicle what "
            f"that one does (likeness {likeness[least]:.2f} of 1), so only larger effects show in "
            "it.")
