"""Whether training pulls numbers of the sheet farther than vehicles of the kind lie apart.

Where something is missing, the fit may take numbers for it that no vehicle has, as a peak friction
below zero. Little is left of the residual then, but the numbers tell. They are counted from where
the baseline runs leave them: a vehicle has the same numbers in all its runs.

References: none beyond `fit/shown.py`, which has the same mixture: one number in ten of a sheet is
wrong, and strays four times as far.
Known limits: linear in the numbers; says nothing without baseline runs.
Validated with: test/diagnosis/test_beyond_sheet.py (drawn numbers; an askew axle).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects.base import WRONG_SHEET
from truck_blowout_sim.diagnosis.fit.shown import WRONG_SHEETS

Floats = NDArray[np.float64]


def chance_of_numbers(study: Study) -> float:
    """Chance that any number of the sheet lies as far from its value in the baseline runs.

    1 without such runs.
    """
    if not study.baseline:
        return 1.0
    amounts = study.projector().amounts(study.residual())
    sheet = [name in study.amounts for name in (study.names[k] for k in study.kept())]
    return chance_of_any_beyond(amounts[np.array(sheet, dtype=np.bool_)])


def chance_of_any_beyond(amounts: Floats) -> float:
    """Chance that any of so many numbers lies as far as the farthest of these, in prior sigmas.

    1 of no numbers.
    """
    if not amounts.size:
        return 1.0
    far = float(np.max(np.abs(amounts)))
    alone = 2.0 * float((1.0 - WRONG_SHEETS) * norm.sf(far)
                        + WRONG_SHEETS * norm.sf(far / WRONG_SHEET))
    return float(-np.expm1(amounts.size * np.log1p(-min(alone, 1.0 - 1e-15))))
