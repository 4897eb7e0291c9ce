"""The case under study: runs, the calibrated truck, residuals and nuisance columns, stacked.

Rows of the stack: baseline runs first (nothing missing there), then training runs. Nuisances are
shared by all runs of the case; an effect acts in training only.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.algebra.linear import Projector
from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.case.simulations import (
    Abreast,
    Alone,
    Job,
    simulate_bins,
    simulated_abreast,
)
from truck_blowout_sim.diagnosis.case.trust import grip_used
from truck_blowout_sim.diagnosis.effects import Effect
from truck_blowout_sim.diagnosis.effects.base import GripUsed
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.effort import USUAL
from truck_blowout_sim.diagnosis.settings import Settings
from truck_blowout_sim.simulation.course import Course, drive_course
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
Progress = Callable[[str, float], None]
_MOST_COURSES = 12  # driven trucks that are remembered, some 3 MB each
FURTHEST = 3.0  # prior sigmas a number of the sheet may stray
_START_SPEED_SIGMA_MPS = 0.02
_START_SPEED_STEP_MPS = 0.1


@dataclass(eq=False)
class Study:
    """A case being worked on.

    Attributes:
        runs: baseline and training; ``holdout``: predicted only.
        packed: the truck at its reference (sheet, then calibrated).
        settings: assumptions; ``workers``: threads.
        refits: how many steady candidates are fitted anew in a round, and how many events.
        models: bin means of the model for each of ``runs`` as it stands now.
        columns: [rows, k] nuisance columns over ``runs``, scaled by prior sigma.
        holdout_models, holdout_columns: the same, run by run, for holdout.
        names: of the nuisances, in the order of the columns.
        amounts: of each sheet nuisance at the reference, in prior sigmas from the sheet.
        level: mean square of a row where nothing is missing.
        known: sheet nuisances that the baseline runs determine: what differs from them in training
            is an effect, and both can be fitted together.
        quiet: by law of a candidate, what it would change in the baseline runs for each unit of
            its amount.
        seconds: by event, what it would change over each second of the baseline and unseen runs.
        simulations: how many were asked for; ``simulated`` gives the bin means of one,
            ``simulated_abreast`` those of up to eight.
    """

    runs: tuple[Run, ...]
    holdout: tuple[Run, ...]
    packed: Packed
    settings: Settings
    workers: int = 2
    refits: tuple[int, int] = USUAL.refits
    models: list[Floats] = field(default_factory=list)
    columns: Floats = field(default_factory=lambda: np.zeros((0, 0)))
    holdout_models: list[Floats] = field(default_factory=list)
    holdout_columns: list[Floats] = field(default_factory=list)
    names: tuple[str, ...] = ()
    amounts: dict[str, float] = field(default_factory=dict)
    level: float = 1.0
    known: frozenset[str] = frozenset()
    quiet: dict[tuple[str, str, str], dict[int, Floats]] = field(default_factory=dict)
    seconds: dict[tuple[Effect, str], dict[int, list[tuple[float, Floats]]]] = field(
        default_factory=dict)
    simulations: int = 0
    simulated: Alone = Run.simulated
    simulated_abreast: Abreast = simulated_abreast
    _projectors: dict[frozenset[str], Projector] = field(default_factory=dict)
    _grams: dict[int, Floats] = field(default_factory=dict)
    _courses: dict[tuple[Run, bytes], Course] = field(default_factory=dict)

    @property
    def train(self) -> tuple[int, ...]:
        """Positions of the training runs in ``runs``."""
        return tuple(i for i, run in enumerate(self.runs) if run.role == "train")

    @cached_property
    def grip_used(self) -> GripUsed:
        """Shares of the tires' grip that training asks for."""
        return grip_used(self)

    @property
    def baseline(self) -> tuple[int, ...]:
        """Positions of the baseline runs in ``runs``."""
        return tuple(i for i, run in enumerate(self.runs) if run.role == "baseline")

    @property
    def alarms_by_name(self) -> float:
        """False alarms that the search for names may raise."""
        return self.settings.alarms_by_name(bool(self.baseline))

    @property
    def parts_of_one_log(self) -> bool:
        """Whether all that tells are the episodes of one long log, with no baseline run beside it.

        They share what the model's form lacks as they share what the truck lacks.
        """
        if self.baseline or len(self.train) != 1:
            return False
        log = self.runs[self.train[0]]
        return len(log.episodes(0, self.settings.episode_s)) > 1

    def expected(self, name: str) -> float:
        """Amount of a nuisance that the baseline runs show; without such runs that of the sheet."""
        return self.amounts.get(name, 0.0) if self.baseline else 0.0

    def meaning(self, hypothesis: Hypothesis) -> str:
        """Nuisance that would swallow the hypothesis; empty if none or if baseline runs hold it."""
        name = hypothesis.meaning(self.packed.vehicle)
        return "" if name in self.known else name

    def projector(self, hypotheses: Sequence[Hypothesis] = ()) -> Projector:
        """Projector without the nuisances that mean the same as one of the hypotheses.

        Made once for each set that is left out.
        """
        drop = frozenset(self.meaning(h) for h in hypotheses)
        if drop not in self._projectors:
            keep = [k for k, name in enumerate(self.names) if name not in drop]
            gram = self.gram_of(range(len(self.runs)))
            self._projectors[drop] = Projector.of(self.columns, keep, gram)
        return self._projectors[drop]

    def gram(self, k: int) -> Floats:
        """[nuisances, nuisances] products of the columns over one run; unseen ones come last."""
        if k not in self._grams:
            fitted = len(self.runs)
            block = (self.columns[rows_of(self.runs)[k]] if k < fitted
                     else self.holdout_columns[k - fitted])
            self._grams[k] = block.T @ block
        return self._grams[k]

    def gram_of(self, runs: Iterable[int]) -> Floats:
        """The same over several runs."""
        total: Floats = np.sum([self.gram(k) for k in runs], axis=0)
        return total

    def kept(self, hypotheses: Sequence[Hypothesis] = ()) -> list[int]:
        """Positions of the nuisances that :meth:`projector` keeps."""
        kept: list[int] = self.projector(hypotheses).kept.tolist()
        return kept

    def amounts_of_kind(self, hypotheses: Sequence[Hypothesis], residual: Floats) -> Floats:
        """Amounts that a residual asks of the nuisances that :meth:`projector` keeps.

        None is farther from where it is expected than trucks of one kind stray.
        """
        usual = np.array([self.expected(self.names[k]) for k in self.kept(hypotheses)])
        return self.projector(hypotheses).amounts_within(residual, usual - FURTHEST,
                                                         usual + FURTHEST)

    def joint_amounts(self, named: Sequence[Hypothesis] = ()) -> Mapping[str, float]:
        """Each nuisance in the joint fit, in prior sigmas, with ``named`` in force in the models.

        Those of the sheet are measured from the sheet.
        """
        amounts = self.projector(named).amounts(self.residual())
        return {self.names[k]: float(a) for k, a in zip(self.kept(named), amounts, strict=True)}

    def forget(self) -> None:
        """Drop what was made of columns that are no longer these."""
        self._projectors.clear()
        self._grams.clear()

    def simulate(self, jobs: Sequence[Job], what: str = "",
                 progress: Progress | None = None) -> list[Floats]:
        """Bin means of many (run, truck) pairs; ``progress`` is told of them as ``what``."""
        self.simulations += len(jobs)
        tell = partial(progress, what) if progress else None
        return simulate_bins(jobs, self.workers, self.simulated, self.simulated_abreast, tell)

    def job(self, run: Run, base: Packed, hypothesis: Hypothesis) -> tuple[Run, Packed]:
        """What to simulate for a hypothesis on top of a truck: an event from its start on only."""
        name = run.recording.name
        truck = hypothesis.apply(base, name)
        if not hypothesis.effect.timed:
            return run, truck
        start, _ = hypothesis.times.get(name, (np.inf, np.inf))
        return self.late(run, base, start), truck

    def late(self, run: Run, base: Packed, since_s: float) -> Run:
        """The run for trucks that are another than ``base`` only from an instant on."""
        key = (run, base.params.tobytes())
        if key not in self._courses:
            if len(self._courses) >= _MOST_COURSES:
                self._courses.pop(next(iter(self._courses)))
            self._courses[key] = drive_course(base, run.drive)
        return replace(run, course=self._courses[key], since_s=since_s)

    def stack(self, parts: Mapping[int, Floats]) -> Floats:
        """Join whitened vectors of some runs into one over all rows, zero elsewhere."""
        return np.concatenate([parts.get(i, np.zeros(run.measured.size))
                               for i, run in enumerate(self.runs)])

    def residual(self, models: Mapping[int, Floats] | None = None) -> Floats:
        """Whitened measured - model over all rows; ``models`` replaces some runs' models."""
        models = models or {}
        return self.stack({i: run.residual(models.get(i, self.models[i]))
                           for i, run in enumerate(self.runs)})

    def update_models(self) -> None:
        """Simulate every run at the reference."""
        self.models = self.simulate([(run, self.packed) for run in self.runs])


def build_columns(study: Study, progress: Progress | None = None) -> None:
    """Fill the nuisance columns of all runs, holdout too, at the present reference."""
    everything = [*study.runs, *study.holdout]
    bases = [*study.models, *study.holdout_models]
    sheet = study.settings.nuisances
    shown = [[bool(run.shows(n.only)) for n in sheet] for run in everything]
    jobs: list[tuple[Run, Packed]] = []
    for run, flags in zip(everything, shown, strict=True):
        jobs += [(run, study.packed.unchecked(n.values(study.packed, n.step)))
                 for n, flag in zip(sheet, flags, strict=True) if flag]
        jobs.append((_faster(run), study.packed))
    results = iter(study.simulate(jobs, "sensitivities", progress))
    blocks = []
    for k, (run, flags, base) in enumerate(zip(everything, shown, bases, strict=True)):
        own = [run.change(next(results), base) * (n.sigma / n.moved(study.amounts.get(n.name, 0.0)))
               if flag else np.zeros(base.size) for n, flag in zip(sheet, flags, strict=True)]
        start = run.change(next(results), base) * (_START_SPEED_SIGMA_MPS / _START_SPEED_STEP_MPS)
        starts = [start if j == k else np.zeros(base.size) for j in range(len(everything))]
        blocks.append(np.stack([*own, *starts, *instrument_columns(study, run)], axis=1))
    n_runs = len(study.runs)
    study.columns = np.concatenate(blocks[:n_runs], axis=0)
    study.forget()
    study.holdout_columns = blocks[n_runs:]
    study.names = (*(n.name for n in sheet), *(f"start speed of {r.recording.name}"
                                               for r in everything), *instrument_names(study))


def _faster(run: Run) -> Run:
    """The same run begun a little faster."""
    initial = replace(run.drive.initial,
                      speed_mps=run.drive.initial.speed_mps + _START_SPEED_STEP_MPS)
    return replace(run, drive=replace(run.drive, initial=initial))


def instrument_names(study: Study) -> tuple[str, ...]:
    """Names of the mounting errors and gains of all channels of the case."""
    channels = dict.fromkeys(c for run in (*study.runs, *study.holdout) for c in run.channels)
    names = []
    for channel in channels:
        rule = study.settings.rule(channel)
        if rule and rule.bias:
            names.append(f"bias of {channel}")
        if rule and rule.gain:
            names.append(f"gain of {channel}")
    return tuple(names)


def instrument_columns(study: Study, run: Run) -> list[Floats]:
    """Whitened columns of a normal instrument's constant error and gain, for one run."""
    columns: list[Floats] = []
    for name in instrument_names(study):
        kind, channel = name.split(" of ")
        column = np.zeros(run.measured.shape)
        if channel in run.channels:
            k = run.channels.index(channel)
            rule = study.settings.rule(channel)
            assert rule is not None
            value = rule.bias if kind == "bias" else rule.gain * run.measured[:, k]
            column[:, k] = value
        columns.append(run.change(column, np.zeros(column.shape)))
    return columns


def row_ranges(study: Study) -> list[slice]:
    """Rows of each run in the stack."""
    return rows_of(study.runs)


def rows_of(runs: Sequence[Run]) -> list[slice]:
    """Rows of each run where these are stacked."""
    ends = np.cumsum([run.measured.size for run in runs])
    return [slice(int(end - run.measured.size), int(end))
            for end, run in zip(ends, runs, strict=True)]
