"""How alike two runs were driven: as far as they ask the same numbers of the sheet.

What a model is off by depends on how the truck is driven: two gentle turns find the same error, a
stop on a straight finds another. A run is described by how much each number of the sheet changes
in it, in the widths of its channels; two runs are as alike as the cosine between these.

References: Kennedy and O'Hagan 2001 (a model's discrepancy as a function of its inputs).
Known limits: a number that acts in every run, as the mass, makes all runs somewhat alike.
Validated with: test/diagnosis/test_driven.py.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.study import Study, row_ranges

Floats = NDArray[np.float64]


def driven(study: Study) -> list[Floats]:
    """What each run asks of the sheet, as unit vectors; of the holdout too, behind the others."""
    sheet = len(study.settings.nuisances)
    blocks = [study.columns[rows, :sheet] for rows in row_ranges(study)]
    return [_asked(block) for block in (*blocks, *(c[:, :sheet] for c in study.holdout_columns))]


def _asked(columns: Floats) -> Floats:
    """Length of each column, all of them scaled to 1."""
    length = np.linalg.norm(columns, axis=0)
    return np.asarray(length / max(float(np.linalg.norm(length)), 1e-12))
