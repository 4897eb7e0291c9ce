"""The recordings of a case, ready to be cut into runs once the instruments are known.

Validated with: test/diagnosis/test_recorded.py.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from truck_blowout_sim.diagnosis.case.resume import Keeps
from truck_blowout_sim.diagnosis.case.runs import Run, prepare_run
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effort import USUAL, Effort
from truck_blowout_sim.diagnosis.result import Role
from truck_blowout_sim.diagnosis.sensors import SensorFinding, correct, seen_quanta
from truck_blowout_sim.diagnosis.settings import Settings
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.vehicle import Packed


@dataclass(frozen=True, eq=False)
class Recorded:
    """What is diagnosed, and how.

    Attributes:
        train, baseline, holdout: recordings by role.
        packed: the vehicle that is simulated; ``rules``: the settings.
        effort: how much work it may take; ``workers``: threads.
        impose_speed: follow the recorded speed; None: only where throttle or brakes are missing.
        kept: knows simulations made before.
    """

    train: Sequence[Recording]
    baseline: Sequence[Recording]
    holdout: Sequence[Recording]
    packed: Packed
    rules: Settings
    effort: Effort = USUAL
    impose_speed: bool | None = None
    workers: int = 1
    kept: Keeps | None = None

    @property
    def every(self) -> tuple[Recording, ...]:
        """Recordings of all roles."""
        return (*self.train, *self.baseline, *self.holdout)

    def study(self, findings: Sequence[SensorFinding] = ()) -> Study:
        """All runs, corrected for what was found of the instruments."""
        study = Study((*(self._cut(r, "baseline", findings) for r in self.baseline),
                       *(self._cut(r, "train", findings) for r in self.train)),
                      tuple(self._cut(r, "holdout", findings) for r in self.holdout),
                      self.packed, self.rules, self.workers, self.effort.refits)
        if self.kept is not None:
            study.simulated = self.kept.simulated
            study.simulated_abreast = self.kept.simulated_abreast
        return study

    def _cut(self, recording: Recording, role: Role, findings: Sequence[SensorFinding]) -> Run:
        there = [f for f in findings if f.in_baseline or role != "baseline"]
        return prepare_run(correct(recording, there), role, self.packed, self.rules,
                           step_s=self.effort.step_s, impose_speed=self.impose_speed,
                           quanta=self.quanta)

    @cached_property
    def quanta(self) -> Mapping[str, float]:
        """Steps in which the channels read."""
        return seen_quanta(list(self.every))
