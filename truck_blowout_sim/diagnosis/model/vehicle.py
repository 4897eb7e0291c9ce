"""The diagnosed vehicle: the truck that was judged, each value with its own source.

Numbers of the sheet stand where the prediction of unseen runs puts them: none farther than trucks
of one kind stray, the others as these then ask. The columns that ask are linear, so the truck is
driven over the fitted runs; where that explains them worse, it goes half of the way, or stays at
the reference. What belongs to the place of the test (slope, crossfall, grip, wind) is not written
unless it is what was named.

References: Gauss-Newton with shortened steps (Nocedal and Wright 2006, section 10.3).
Known limits: one step. To go on from there made speeds of unseen runs better and yaw rates worse,
as the amounts of what is named were not fitted with it.
Validated with: test/diagnosis/test_diagnose_cli.py, test/diagnosis/test_diagnosed_truck.py.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.comparison import rms_errors
from truck_blowout_sim.diagnosis.algebra.linear import Projector
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.models import jobs_with, unseen_jobs
from truck_blowout_sim.diagnosis.result import Fit
from truck_blowout_sim.diagnosis.sensors import Noise, channel_noise, slow_noise, told_noise
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
_NO_CHANGE = 1e-9
_SHARES = (1.0, 0.5)  # of the way that linear columns ask for, the first that helps


@dataclass(frozen=True, eq=False)
class DiagnosedTruck:
    """A truck with what was found.

    Attributes:
        packed: its parameters.
        values: those that differ from the given truck's.
        sources: of each of them.
    """

    packed: Packed
    values: Mapping[str, float]
    sources: Mapping[str, str]


def diagnosed_truck(
    study: Study, given: Packed, models: Sequence[Floats], named: Sequence[Hypothesis],
    law: Mapping[str, float] | None = None,
) -> DiagnosedTruck:  # fmt: skip
    """The truck that the runs ask for with the named effects in force.

    Args:
        study: the case.
        given: the truck before the diagnosis.
        models: of all runs, those of training with the named effects in force.
        named: effects.
        law: parameters of a force without name, if one is to be added.
    """
    amounts = _asked_for(study, models, named)
    place = {number.name for number in study.settings.nuisances if number.of_the_place}
    truck = _moved(study, np.array([0.0 if name in place else amount
                                    for name, amount in amounts.items()]))
    sources: dict[str, str] = {}
    for number in study.settings.nuisances:
        total = amounts[number.name]
        if number.name not in place and abs(total) > _NO_CHANGE:
            sources |= {name: _joined(sources.get(name), f"sheet number {number.name} "
                                      f"{total:+.2f} prior sigmas from the sheet")
                        for name, _ in number.targets}  # fmt: skip
    if law:
        truck = truck.unchecked(law)
        sources |= dict.fromkeys(law, "diagnosed: the law of a force that has no name")
    for effect in named:
        before = truck
        truck = effect.apply(truck, next(iter(effect.times), ""))
        words = f"diagnosed: {effect.effect.name} {effect.place}".strip()
        sources |= dict.fromkeys(truck.differing(before), words)
    values = truck.differing(given)
    return DiagnosedTruck(truck, values, {name: sources.get(name, "calibrated") for name in values})


def _asked_for(study: Study, models: Sequence[Floats], named: Sequence[Hypothesis]
               ) -> dict[str, float]:
    """Amounts of all numbers of the sheet, in prior sigmas, that explain the fitted runs best.

    All the way that the linear columns ask for, or half of it, or none: as simulation has it.
    Not so far that an unseen run cannot be driven any more.
    """
    sheet = [number.name for number in study.settings.nuisances]
    wanted = study.amounts_of_kind(named, study.residual(dict(enumerate(models))))
    asked = dict(zip((study.names[k] for k in study.kept(named)), wanted.tolist(), strict=True))
    here = np.array([study.amounts.get(name, 0.0) for name in sheet])
    way = np.array([asked.get(name, at) for name, at in zip(sheet, here, strict=True)]) - here
    instruments = Projector.of(study.columns, range(len(sheet), study.columns.shape[1]))
    least = _left(study, instruments, models, here)
    for share in _SHARES:
        there = here + share * way
        truck = _moved(study, there)
        driven = study.simulate(jobs_with(study, truck, named))
        if _left(study, instruments, driven, there) < least and _drives(study, truck, named):
            here = there
            break
    return dict(zip(sheet, here.tolist(), strict=True))


def _drives(study: Study, truck: Packed, named: Sequence[Hypothesis]) -> bool:
    """Whether a truck stays in the range of the model where the reference does, in unseen runs."""
    models = study.simulate(unseen_jobs(study, truck, [named] * len(study.holdout)))
    return all(bool((np.isfinite(model) | ~np.isfinite(usual)).all())
               for model, usual in zip(models, study.holdout_models, strict=True))


def _moved(study: Study, amounts: Floats) -> Packed:
    """The reference with its sheet numbers at these amounts."""
    truck = study.packed
    for number, there in zip(study.settings.nuisances, amounts.tolist(), strict=True):
        here = study.amounts.get(number.name, 0.0)
        truck = truck.unchecked(number.values(truck, number.between(here, there)))
    return truck


def _left(study: Study, instruments: Projector, models: Sequence[Floats], amounts: Floats
          ) -> float:
    """Sum of squares that instruments and starts leave, and what the priors say of the amounts."""
    sheet = [number.name for number in study.settings.nuisances]
    here = np.array([study.amounts.get(name, 0.0) for name in sheet])
    # the runs were shifted by what the columns say of the reference, so that amounts count from
    # the sheet: a truck that is driven has its own already
    residual = study.residual(dict(enumerate(models))) - study.columns[:, :len(sheet)] @ here
    left = instruments.chi2(residual) + float(amounts @ amounts)
    return left if np.isfinite(left) else float("inf")


def _joined(first: str | None, second: str) -> str:
    return second if first is None else f"{first}; {second}"


def driven_fit(
    recordings: Sequence[Recording], before: Packed, after: Packed, *,
    impose_speed: bool | None, quanta: Mapping[str, float],
) -> Fit:  # fmt: skip
    """Rms error of each measured channel, as ``compare`` has it, over the noise seen in it.

    Args:
        recordings: unseen runs, instruments corrected.
        before: the calibrated truck without what was named; ``after``: with it.
        impose_speed: as in ``compare``; ``quanta``: steps in which the channels read.
    """
    noises = [told_noise(r, {**channel_noise(r, quanta), **slow_noise(r)}) for r in recordings]
    sides = [_errors(recordings, noises, truck, impose_speed) for truck in (before, after)]
    common = sorted(set(sides[0]) & set(sides[1]))
    return Fit(*({name: side[name] for name in common} for side in sides))


def _errors(
    recordings: Sequence[Recording], noises: Sequence[Mapping[str, Noise]], truck: Packed,
    impose_speed: bool | None,
) -> dict[str, float]:
    squares: dict[str, list[float]] = {}
    for recording, noise in zip(recordings, noises, strict=True):
        for name, rms in rms_errors(recording, truck, impose_speed=impose_speed).items():
            if name in noise:
                squares.setdefault(name, []).append((rms / noise[name].sigma)**2)
    return {name: float(np.sqrt(np.mean(values))) for name, values in squares.items()}
