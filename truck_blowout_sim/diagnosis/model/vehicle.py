"""The diagnosed vehicle: the truck that was judged, each value with its own source.

Numbers of the sheet stand where the prediction of unseen runs puts them: none farther than trucks
of one kind stray, the others as these then ask. What belongs to the place of the test (slope,
crossfall, grip, wind) is not written unless it is what was named.

Validated with: test/diagnosis/test_diagnose_cli.py.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.comparison import compare
from truck_blowout_sim.diagnosis.case.study import FURTHEST, Study
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.result import Fit
from truck_blowout_sim.diagnosis.sensors import channel_noise
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
_PLACE = "world."
_NO_CHANGE = 1e-9


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
    study: Study, given: Packed, residual: Floats, named: Sequence[Hypothesis],
    law: Mapping[str, float] | None = None,
) -> DiagnosedTruck:  # fmt: skip
    """The truck that the runs ask for with the named effects in force.

    Args:
        study: the case.
        given: the truck before the diagnosis.
        residual: whitened, over all rows, with the named effects in force.
        named: effects.
        law: parameters of a force without name, if one is to be added.
    """
    projector = study.projector(named)
    names = [study.names[k] for k in projector.kept.tolist()]
    usual = np.array([study.expected(name) for name in names])
    found = projector.amounts_within(residual, usual - FURTHEST, usual + FURTHEST)
    amounts = dict(zip(names, found.tolist(), strict=True))
    truck = study.packed
    sources: dict[str, str] = {}
    for number in study.settings.nuisances:
        here = study.amounts.get(number.name, 0.0)
        total = amounts.get(number.name, here)
        place = all(name.startswith(_PLACE) for name, _ in number.targets)
        changed = number.values(truck, number.between(here, 0.0 if place else total))
        truck = truck.unchecked(changed)
        if not place and abs(total) > _NO_CHANGE:
            sources |= {name: _joined(sources.get(name), f"sheet number {number.name} "
                                      f"{total:+.2f} prior sigmas from the sheet")
                        for name in changed}  # fmt: skip
    if law:
        truck = truck.unchecked(law)
        sources |= dict.fromkeys(law, "diagnosed: the law of a force that has no name")
    for effect in named:
        before = truck
        truck = effect.apply(truck, next(iter(effect.times), ""))
        words = f"diagnosed: {effect.effect.name} {effect.place}".strip()
        sources |= {name: words for name, i in truck.index.items()
                    if truck.params[i] != before.params[i]}  # fmt: skip
    values = {name: float(truck.params[i]) for name, i in given.index.items()
              if truck.params[i] != given.params[i]}  # fmt: skip
    return DiagnosedTruck(truck, values, {name: sources.get(name, "calibrated") for name in values})


def _joined(first: str | None, second: str) -> str:
    return second if first is None else f"{first}; {second}"


def driven_fit(
    recordings: Sequence[Recording], before: Packed, after: Packed, *,
    impose_speed: bool | None,
) -> Fit:  # fmt: skip
    """Rms error of each measured channel, as ``compare`` has it, over the noise seen in it.

    Args:
        recordings: unseen runs, instruments corrected.
        before: the calibrated truck without what was named; ``after``: with it.
        impose_speed: as in ``compare``.
    """
    sides = [_errors(recordings, truck, impose_speed) for truck in (before, after)]
    common = sorted(set(sides[0]) & set(sides[1]))
    return Fit(*({name: side[name] for name in common} for side in sides))


def _errors(
    recordings: Sequence[Recording], truck: Packed, impose_speed: bool | None
) -> dict[str, float]:
    squares: dict[str, list[float]] = {}
    for recording in recordings:
        compared = compare(recording, truck, impose_speed=impose_speed)
        noise = channel_noise(recording)
        for channel in compared.channels:
            if channel.name in noise and not channel.imposed:
                figure = channel.rms / noise[channel.name].sigma
                squares.setdefault(channel.name, []).append(figure**2)
    return {name: float(np.sqrt(np.mean(values))) for name, values in squares.items()}
