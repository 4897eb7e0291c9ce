"""Everything that an answer is made of, and what follows from it for every part of the answer.

Validated with: test/diagnosis/test_outcome.py.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

from truck_blowout_sim.diagnosis.answer import words
from truck_blowout_sim.diagnosis.answer.unlisted import Unlisted
from truck_blowout_sim.diagnosis.case.antilock import Lockup
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.fit.beside import placed_in, unseen_with
from truck_blowout_sim.diagnosis.locate.beat import Beat
from truck_blowout_sim.diagnosis.locate.lagging import Lag
from truck_blowout_sim.diagnosis.locate.left_over import keeps_more, mean_squares
from truck_blowout_sim.diagnosis.locate.posture import Posture
from truck_blowout_sim.diagnosis.locate.restless import Restless, Unrest
from truck_blowout_sim.diagnosis.locate.wrench import Wrenches
from truck_blowout_sim.diagnosis.model.law import Law
from truck_blowout_sim.diagnosis.name.judging import Found
from truck_blowout_sim.diagnosis.prove.intervals import Timing
from truck_blowout_sim.diagnosis.prove.next_test import Separation
from truck_blowout_sim.diagnosis.prove.profile import Arms
from truck_blowout_sim.diagnosis.result import Showing
from truck_blowout_sim.diagnosis.result.evidence import FAR
from truck_blowout_sim.diagnosis.sensors import GateResult

Key = tuple[str, str]  # of a hypothesis: name and place


@dataclass(frozen=True, eq=False)
class Material:
    """Everything an answer is made of.

    Attributes:
        wrenches: missing on each body before anything was named; ``unnamed``: after.
        law: plainest law of what is left unnamed.
        timings: intervals of each timed effect's onset and duration, by key and run.
        vehicle: name of the model's vehicle.
        separation: the run that would best tell apart what these cannot, if any could.
        arms: of each effect's amount by profile likelihood and jackknife, by key, if asked for.
        beat: a periodic force too fast for the bins; ``lag``: a wheel that a drag holds back;
            ``posture``: a body that stands turned; ``unrest``: a channel that nothing calms.
        lockup: a wheel that stood, so that the model goes without anti-lock control.
        would_show: smallest amounts that would be named, where nothing was.
    """

    study: Study
    found: Found
    gate: GateResult
    wrenches: tuple[Wrenches, ...]
    unnamed: tuple[Wrenches, ...]
    law: Law
    timings: Mapping[Key, Mapping[str, Timing]]
    vehicle: str
    separation: Separation | None = None
    arms: Mapping[Key, Arms] = field(default_factory=dict)
    beat: Beat | None = None
    lag: Lag | None = None
    posture: Posture | None = None
    unrest: Unrest = field(default_factory=Unrest)
    lockup: Lockup | None = None
    would_show: tuple[Showing, ...] = ()

    @cached_property
    def squares(self) -> tuple[float, ...]:
        """Squares a row that each run keeps with everything named in force, unseen runs last."""
        named = [r.hypothesis for r in self.found.named]
        placed = placed_in(self.study, named, [one.named for one in self.found.after])
        return mean_squares(self.study, named, unseen_with(self.study, placed))

    @cached_property
    def squares_unnamed(self) -> tuple[float, ...]:
        """The same with nothing named, of the same runs."""
        unnamed = replace(self.study, models=list(self.found.models_null))
        return mean_squares(unnamed, unseen=unnamed.holdout_models)[:len(self.squares)]

    @property
    def worst(self) -> int:
        """Index in `squares` of the run that was to be explained and keeps most."""
        asked = (*self.study.train, *range(len(self.study.runs), len(self.squares)))
        return max(asked, key=lambda i: self.squares[i])

    @property
    def keeps_more(self) -> bool:
        """Whether training keeps more than chance lets it.

        Not asked beside a faulty instrument: once corrected, it leaves more of itself than models
        do.
        """
        return not self.gate.findings and keeps_more(self.study, self.squares)

    @property
    def signs(self) -> tuple[words.Sign, ...]:
        """What shows beside a force that has a name."""
        found = self.found
        shown = (*(Unlisted.of(r, rivals)
                   for r, rivals in zip(found.named, found.rivals, strict=True)
                   if not r.hypothesis.effect.listed),
                 self.new_beat, self.lag, self.posture, self.moving_on)
        return tuple(one for one in shown if one is not None)

    @property
    def new_beat(self) -> Beat | None:
        """The beat, where baseline runs tell that it is new: every sound wheel beats a little."""
        return self.beat if self.study.baseline else None

    @property
    def bought(self) -> float:
        """Fall of the sum of squares that the named effects brought.

        With what calibration had ascribed to the sheet: a dragging flat tire is also a number of
        it.
        """
        found = self.found
        return found.chi2_null - found.chi2_after + sum(
            max(r.evidence - r.delta, 0.0) for r in found.named)

    @property
    def moving_on(self) -> Restless | None:
        """The restless channel, if more is left of it than everything named explains of all."""
        moving = self.unrest.channel
        return moving if moving is not None and moving.evidence > self.bought else None

    @property
    def joint_amounts(self) -> Mapping[str, float]:
        """Each nuisance in the joint fit, in prior sigmas, the named effects in force."""
        return self.study.joint_amounts([r.hypothesis for r in self.found.named])

    @property
    def pulled(self) -> Sequence[tuple[str, float]]:
        """Sheet numbers far from the sheet, with their pull, strongest first."""
        own = self.joint_amounts
        total = {n.name: own.get(n.name, 0.0) for n in self.study.settings.nuisances}
        return sorted(((n, a) for n, a in total.items() if abs(a) > FAR),
                      key=lambda p: -abs(p[1]))
