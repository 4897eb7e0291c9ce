"""What was found, as the answer tells it: effects of the truck, faults of instruments, aliases.

Validated with: test/diagnosis/test_outcome.py.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Mapping, Sequence

import numpy as np

from truck_blowout_sim.diagnosis.algebra.quantiles import NINETY
from truck_blowout_sim.diagnosis.answer import words
from truck_blowout_sim.diagnosis.answer.limits import (
    limit_of_search,
    limit_sentence,
    open_at_limit,
)
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects.base import Amount
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.prove.intervals import Timing
from truck_blowout_sim.diagnosis.prove.profile import Arms
from truck_blowout_sim.diagnosis.result import AliasSet, Effect, Parameter, Place
from truck_blowout_sim.diagnosis.result.parts import Interval
from truck_blowout_sim.diagnosis.sensors import SensorFinding

_OPEN = (-np.inf, np.inf)
# What only the angle of the road wheels could tell apart, whatever the evidence.
_UNTOLD = {"steering_lag": (("channel_delay", "all instruments but the hand wheel"),),
           "steering_angle_offset": (("axle_misalignment", "steered axle"),)}


def physics_effect(ranked: Ranked, study: Study, timings: Mapping[str, Timing] | None = None,
                   arms: Arms | None = None) -> Effect:
    """An accepted hypothesis as the answer gives it.

    Args:
        timings: intervals of its instants, by run; ``arms``: of its amount; None: by curvature.
    """
    h = ranked.hypothesis
    amount = h.effect.amount
    # noise alone would give an interval far too narrow: the truth has another law than the model
    share = float(np.hypot(study.settings.form(h.effect.name), amount.file_share))
    form = share * (h.amount - h.effect.neutral(study.packed))
    wide = NINETY * float(np.hypot(ranked.sigma, form))
    below, above = arms.wider(form) if arms else (wide, wide)
    value = amount.report(h.amount)
    ends = reported(amount, *open_at_limit(h, h.amount - below, h.amount + above))
    first = min(h.times, key=lambda run: h.times[run][0], default="")
    onset = h.times[first][0] if first else None
    timings = timings or {}
    interval = timings[first].onset_s if first in timings else None
    parameters = {amount.name: Parameter(value, amount.unit, ends)}
    for run, (start, end) in h.times.items():
        if np.isfinite(end):
            known = timings[run].duration_s if run in timings else None
            parameters[f"duration_s in {run}"] = Parameter(end - start, "s", known or _OPEN)
    sentence, _ = words.fill(h, value, onset)
    sentence = limit_sentence(h, ends) or sentence + words.open_ends(ends)
    sentence += limit_of_search(h) + words.unseen_before(onset, interval)
    return Effect(name=h.effect.name, kind=h.effect.kind, where=h.place, parameters=parameters,
                  equation=words.equation_of(h, study.packed), sentence=sentence,
                  onset_s=onset, onset_ci90_s=interval)


def reported(amount: Amount, low: float, high: float) -> Interval:
    """An interval as reported: within what is physical, infinite where the recordings say nothing.

    A quantity that falls as the amount grows changes its ends round.
    """
    ends = [amount.report(float(np.clip(end, amount.low, amount.high))) for end in (low, high)]
    order = 1.0 if ends[0] <= ends[1] else -1.0
    told = [order * end if np.isinf(end) else value
            for end, value in zip((low, high), ends, strict=True)]
    return min(told), max(told)


def sensor_effects(findings: Sequence[SensorFinding]) -> list[Effect]:
    """Faulty instruments as the answer gives them.

    Where one fault has two amounts, one of every run and one of the runs to explain, each says so.
    """
    kinds = Counter((one.name, one.instrument) for one in findings)
    return [_sensor_effect(one, kinds[one.name, one.instrument] > 1) for one in findings]


def _sensor_effect(finding: SensorFinding, twice: bool) -> Effect:
    which = "in every run" if finding.in_baseline else "beyond that of the baseline"
    fault, colon, amount = finding.sentence.removesuffix(".").partition(": ")
    sentence = f"{fault} {which}{colon}{amount}." if twice else finding.sentence
    instrument = f"{finding.instrument}, {which}" if twice else finding.instrument
    return Effect(name=finding.name, kind="sensor", where=Place(body=finding.body or None),
                  parameters={n: Parameter(a.value, a.unit, a.ci90)
                              for n, a in finding.parameters.items()},
                  equation=finding.equation, sentence=sentence, instrument=instrument,
                  channels=finding.channels)


def alias_set(rivals: Sequence[Ranked], recorded: Collection[str] = ()) -> AliasSet:
    """Names that explain as much, best first, each once; and what no such channels could tell.

    Args:
        rivals: hypotheses that fit alike, the named one first.
        recorded: channels that any run has.
    """
    first: dict[str, str] = {}
    for r in rivals:
        first.setdefault(r.hypothesis.effect.name, str(r.hypothesis.place))
    if not any(c.endswith("_steer_rad") for c in recorded):
        for name, place in _UNTOLD.get(rivals[0].hypothesis.effect.name, ()):
            first.setdefault(name, place)
    return AliasSet(tuple(first), tuple(first.values()), rivals[0].hypothesis.effect.splits)
