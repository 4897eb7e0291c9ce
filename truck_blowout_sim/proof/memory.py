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
from truck_blowout_sim.diagnosis.case.simulations import Job, simulated_abreast
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
        if key in self._seen:
            self.hits += 1
            return self._seen[key].copy()
        bins = run.simulated(truck)
        if len(self._seen) < self.most:
            self._seen[key] = bins.copy()
        return bins

    def simulated_abreast(self, jobs: Sequence[Job]) -> list[Floats]:
        """Bin means of up to eight."""
        keys = [simulation_key(*job, abreast=True) for job in jobs]
        found = {key: self._seen[key] for key in keys if key in self._seen}
        self.hits += len(found)
        left = {key: job for key, job in zip(keys, jobs, strict=True) if key not in found}
        if left:
            for key, bins in zip(left, simulated_abreast(list(left.values())), strict=True):
                found[key] = bins
                if len(self._seen) < self.most:
                    self._seen[key] = bins
        return [found[key].copy() for key in keys]
