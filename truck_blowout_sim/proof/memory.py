"""What was simulated once in a case, for whoever asks again: diagnosis and rivals share a start.

Validated with: test/diagnosis/test_resume.py.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis import simulation_key
from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.case.simulations import Job, known_or_abreast
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]


@dataclass(eq=False)
class Memory:
    """Bin means of one case, the first so many of them; the same bits as simulated anew.

    Attributes:
        most: how many are remembered (some 50 kB each); those of the calibration come first.
        hits: how many did not have to be simulated again.
    """

    most: int = 1000
    hits: int = 0
    _seen: dict[bytes, Floats] = field(default_factory=dict)

    def begin(self, case: Mapping[str, str]) -> None:
        """Nothing to take up."""

    def simulated(self, run: Run, truck: Packed) -> Floats:
        """Bin means of a truck over a run."""
        key = simulation_key(run, truck)
        bins = self._recall(key)
        if bins is None:
            bins = run.simulated(truck)
            self._keep(key, bins)
        return bins.copy()

    def simulated_abreast(self, jobs: Sequence[Job]) -> list[Floats]:
        """Bin means of up to eight."""
        return known_or_abreast(jobs, self._recall, self._keep)

    def _recall(self, key: bytes) -> Floats | None:
        bins = self._seen.get(key)
        self.hits += bins is not None
        return bins

    def _keep(self, key: bytes, bins: Floats) -> None:
        if len(self._seen) < self.most:
            self._seen[key] = bins
