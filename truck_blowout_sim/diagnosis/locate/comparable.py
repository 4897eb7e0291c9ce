"""What nothing explains, as far as baseline runs tell how well the model describes the truck.

Good models of one truck differ most in what a tire does once it is lost: its drag and cornering
differ by tens of per cent. Baseline runs on sound tires say nothing of that. So where only training
lost a tire, what is left from then on is no sign of something that the model lacks.

Known limits: an effect without a name that acts after such a blowout only is not noticed.
Validated with: test/diagnosis/test_comparable.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.algebra.linear import Projector
from truck_blowout_sim.diagnosis.case.study import Study, row_ranges
from truck_blowout_sim.diagnosis.case.trust import comparable_rows
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Left:
    """What nothing explains, of all rows or of those that baseline runs tell of.

    Attributes:
        projector: of the nuisances; ``removed``: [rows] what it leaves of the residual.
        seen: [rows] 1 where a row counts, else 0.
    """

    projector: Projector
    removed: Floats
    seen: Floats

    @staticmethod
    def of(study: Study, models: Sequence[Floats], named: Sequence[Hypothesis] = (), *,
           comparable: bool = False) -> Left:
        """With ``named`` in force in the ``models`` of all runs.

        ``comparable``: later rows of a run do not count, and do not fit the nuisances either.
        """
        residual, projector = study.residual(dict(enumerate(models))), study.projector(named)
        seen: Floats = np.ones(residual.size)
        if comparable:
            seen = np.concatenate([comparable_rows(study, run) for run in study.runs])
        if not seen.all():
            projector = Projector.of(study.columns * seen[:, None], projector.kept.tolist())
        return Left(projector, projector.remove(residual * seen), seen)

    def rows_of(self, study: Study, i: int) -> NDArray[np.bool_]:
        """[bins] of a run that count."""
        rows = self.seen[row_ranges(study)[i]].reshape(study.runs[i].measured.shape)
        return np.asarray(rows[:, 0] > 0.0)

    def worst(self, study: Study) -> int:
        """The training run that is explained worst."""
        rows = row_ranges(study)
        return max(study.train, key=lambda i: float(self.removed[rows[i]] @ self.removed[rows[i]]))
