"""Whether training pulls numbers of the sheet farther than vehicles of the kind lie apart.

Where something is missing, the fit may take numbers for it that no vehicle has, as a peak friction
below zero. Little is left of the residual then, but the numbers tell.

References: none beyond `fit/shown.py`, which has the same mixture: one number in ten of a sheet is
wrong, and strays four times as far.
Known limits: linear in the numbers; a sheet that is far off tells the same; says nothing without
baseline runs, which alone can show that.
Validated with: test/diagnosis/test_beyond_sheet.py (drawn numbers; an askew axle).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm

from truck_blowout_sim.diagnosis.algebra.independent import in_any
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects.base import WRONG_SHEET
from truck_blowout_sim.diagnosis.fit.shown import WRONG_SHEETS

Floats = NDArray[np.float64]


def chance_of_numbers(study: Study) -> float:
    """Chance that any number of a vehicle lies as far from its sheet as the joint fit has one.

    1 without such runs.
    """
    if not study.baseline:
        return 1.0
    fitted = study.joint_amounts()
    return chance_of_any_beyond(np.array([fitted[name] for name in study.amounts]))


def chance_of_any_beyond(amounts: Floats) -> float:
    """Chance that any of so many numbers lies as far as the farthest of these, in prior sigmas.

    1 of no numbers.
    """
    if not amounts.size:
        return 1.0
    far = float(np.max(np.abs(amounts)))
    alone = 2.0 * float((1.0 - WRONG_SHEETS) * norm.sf(far)
                        + WRONG_SHEETS * norm.sf(far / WRONG_SHEET))
    return in_any(alone, amounts.size)
