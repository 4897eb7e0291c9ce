"""Sentences a driver could check and equations an engineer could."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isfinite
from typing import Protocol

import numpy as np

from truck_blowout_sim.diagnosis.case.study import FURTHEST, Study
from truck_blowout_sim.diagnosis.effects.base import WRONG_SHEET
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.model.law import Law
from truck_blowout_sim.diagnosis.name.judging import Found
from truck_blowout_sim.diagnosis.prove.next_test import Separation
from truck_blowout_sim.diagnosis.result import Effect, Verdict
from truck_blowout_sim.diagnosis.result.parts import Interval
from truck_blowout_sim.diagnosis.sensors import GateResult
from truck_blowout_sim.vehicle import Packed

_HARDLY = 0.1  # of a force's history: a law that left-out windows confirm less is none; judgement
_LONG_S = 0.5  # by so much more may an event have been there before it was found than after
_SPLITTERS = (
    ("hub_speed_", "wheel speeds", "which wheel drags, brakes or slips"),
    ("tire_pressure_", "tire pressures", "a failing tire from a moving load or a dragging brake"),
    ("brake_chamber_", "brake chamber pressures", "late or weak pressure from weak brakes"),
    ("trailer_yaw_rate_radps", "trailer yaw rate", "a force on the trailer from one ahead of it"),
    ("trailer_ay_mps2", "trailer lateral acceleration", "where on the trailer a side force acts"),
    ("tractor_roll_rad", "roll angle", "roll steer from steering compliance"),
    ("throttle", "throttle", "driveline drag from drag of the vehicle"),
)


class Sign(Protocol):
    """What shows beside a force that has a name: for a driver, for an engineer, what to try."""

    @property
    def sentence(self) -> str:
        """For a driver."""

    @property
    def equation(self) -> str:
        """For an engineer."""

    @property
    def next_test(self) -> str:
        """What would show its cause."""


def fill(hypothesis: Hypothesis, value: float, onset_s: float | None) -> tuple[str, str]:
    """Sentence and equation of an effect, the numbers filled in."""
    where = str(hypothesis.place) or "truck"
    onset = f"{onset_s:.2f} s" if onset_s is not None else "the start"
    axles = f"axle {where}" if hypothesis.place.axle else "all axles"
    blanks = {"where": where, "axles": axles, "value": f"{value:.3g}", "onset": onset,
              "percent": f"{100.0 * value:.2g}", "percent_of": f"{100.0 * value:.0f}"}
    effect = hypothesis.effect
    return effect.sentence.format(**blanks), effect.equation.format(**blanks)


def equation_of(hypothesis: Hypothesis, packed: Packed) -> str:
    """Equation of an effect with every number that was fitted; the earliest of its instants."""
    onset = min((start for start, _ in hypothesis.times.values()), default=None)
    value = hypothesis.effect.amount.report(hypothesis.amount)
    return fill(hypothesis, value, onset)[1] + fitted_with(hypothesis.law_numbers(packed))


def fitted_with(numbers: Mapping[str, float]) -> str:
    """Numbers of a law that were fitted beside its amount, as the written vehicle names them."""
    told = ", ".join(f"{key.rsplit('.', 1)[-1]} = {value:.2g}" for key, value in numbers.items())
    return f";  {told}" if told else ""


def open_ends(ends: Interval) -> str:
    """What to say where the recordings set no bound on one side, or on neither."""
    open_ = [word for word, end in zip(("lower", "upper"), ends, strict=True) if not isfinite(end)]
    return f" These recordings set no {' and no '.join(open_)} bound." if open_ else ""


def unseen_before(onset_s: float | None, known: Interval | None) -> str:
    """What to say of an event that may have been there long before it showed."""
    if onset_s is None or known is None:
        return ""
    before, after = onset_s - known[0], known[1] - onset_s
    if not isfinite(before) or before < after + _LONG_S:
        return ""
    return f" It may have begun as early as {known[0]:.2f} s, because it need not show at once."


def verdict_sentence(verdict: Verdict, effects: Sequence[Effect],
                     pulled: Sequence[tuple[str, float]], law: Law | None,
                     signs: Sequence[Sign] = (), cautions: Sequence[str] = ()) -> str:
    """The verdict in words.

    ``law``: of a force left unexplained, ``signs``: what else shows; ``cautions``: sentences that
    hold whatever else is wrong.
    """
    said = _verdict(verdict, effects, pulled, law, signs)
    return " ".join(one for one in (said, *cautions) if one)


ONE_LOG = ("This rests on parts of one log, which share what the model's form lacks: confirm it "
           "with a baseline run.")


def left_untold(squares: Sequence[float]) -> str:
    """Without baseline runs: that much is left, and what it can be."""
    times = float(np.sqrt(np.exp(np.mean(np.log(squares)))))
    return (f"The model leaves {times:.1f} times what good models of one vehicle differ by. "
            "Without baseline runs it cannot be told whether the instruments drift, the sheet "
            "belongs to another vehicle, or physics is missing.")


def left_beside_names(run: str, times: float) -> str:
    """What is named explains most, but not all: which run keeps most beside baseline runs."""
    return (f"That is not all: {run} still differs {times:.1f} times as much as baseline runs do, "
            "so something smaller is missing, too, or what is named has another form.")


def only_unseen(run: str, times: float) -> str:
    """Where training shows nothing, and an unseen run does."""
    return (f"Training shows nothing unusual, but {run}, which was not fitted, differs {times:.1f} "
            "times as much as baseline runs do.")


def train_on(run: str) -> str:
    """What to do then."""
    return f"Diagnose again with {run} among the training runs."


def _verdict(verdict: Verdict, effects: Sequence[Effect], pulled: Sequence[tuple[str, float]],
             law: Law | None, signs: Sequence[Sign]) -> str:
    if verdict == "consistent":
        return ("The model explains these recordings within what instruments and vehicles of one "
                "kind differ; nothing is missing that they could show.")
    if verdict == "miscalibrated":
        return ("No missing physics shows, but the sheet is off"
                f"{': ' if pulled else ''}{_pulls(pulled)}." + _beyond_vehicles(pulled))
    said = [] if verdict == "unknown" else [effect.sentence for effect in effects]
    if law is not None:
        said.append(f"Something acts on the {law.body} that no known effect explains; "
                    + (f"its plainest law is {law.equation}, which left-out windows confirm to "
                       f"{100.0 * law.explained:.0f} percent{_unseen(law)}."
                       if law.explained > _HARDLY else
                       "no plain law of speed, turn, roll or command describes it."))
    said += [sign.sentence for sign in signs]
    if verdict == "unknown" and (impossible := _impossible(pulled)):
        said.append(f"No vehicle is so far off its sheet: {_pulls(impossible)}.")
    return " ".join(said)


def _pulls(pulled: Sequence[tuple[str, float]]) -> str:
    """The first sheet numbers, with how far they are off."""
    return ", ".join(f"{name.replace('_', ' ')} ({pull:+.1f} sigma)" for name, pull in pulled[:3])


def _impossible(pulled: Sequence[tuple[str, float]]) -> Sequence[tuple[str, float]]:
    """Sheet numbers that no vehicle has, not even one whose sheet is wrong."""
    return [(name, pull) for name, pull in pulled if abs(pull) > WRONG_SHEET * FURTHEST]


def _beyond_vehicles(pulled: Sequence[tuple[str, float]]) -> str:
    """What to say of numbers that no vehicle has."""
    if not _impossible(pulled):
        return ""
    return (" No vehicle is so far off its sheet: the model has another form there, or something "
            "is missing that these recordings cannot tell.")


def _unseen(law: Law) -> str:
    """What runs that were never fitted say of a law."""
    if law.unseen is None:
        return "" if law.values else "; the model has no place for it"
    change = 100.0 * (1.0 - law.unseen[1] / law.unseen[0])
    return (f"; with it, unseen runs are predicted {change:.0f} percent better" if law.helps else
            "; unseen runs are not predicted better with it, so it is not added")


def next_look(law: Law, signs: Sequence[Sign]) -> str:
    """Where nothing is named: what would show the cause of a sign, or else of the force."""
    if signs:
        return signs[0].next_test
    return (f"Repeat the run at another speed, then with another load: whether the force on the "
            f"{law.body} follows speed, load or the place on the road tells what makes it.")


def next_test(found: Found, gate: GateResult, best: Separation | None = None,
              baseline: str = "") -> str:
    """The run or channel that would decide, or confirm.

    ``best``: what simulation found. ``baseline``: which run in order would show more, if nothing
    is named.
    """
    if best is not None:
        return f"To tell {_names(best.pair)}: {best.pair[0].effect.splits}. {best}"
    for rivals in found.rivals:
        pair = [r.hypothesis for r in rivals[:2]]
        if len(pair) > 1:
            return f"To tell {_names(pair)}: {pair[0].effect.splits}."
    for finding in gate.findings:
        return finding.next_test
    if found.named:
        return f"To confirm: {found.named[0].hypothesis.effect.splits}."
    return baseline or (
        "None is needed for these maneuvers; a harder one would test more of the model.")


def _names(pair: Sequence[Hypothesis]) -> str:
    """Two explanations; with their places where the names are the same."""
    names = [h.effect.name for h in pair]
    if len(set(names)) == 1:
        names = [f"{h.effect.name} at {h.place}" for h in pair]
    return " from ".join(names)


def assumptions(study: Study) -> tuple[str, ...]:
    """Everything that was taken for granted."""
    base = ["All recordings are of one vehicle with one set of instruments.",
            "Hand wheel, throttle and brake pressures are as recorded.",
            "Sheet numbers stray from vehicle to vehicle as config/diagnosis states.",
            f"Model differences last about {study.settings.correlation_s:g} s."]
    if study.baseline:
        base.append("What is missing is not at work in the baseline recordings.")
    else:
        base.append("Without baseline recordings, the effect may be at work in every run.")
    if study.settings.without:
        base.append("Not the cause, as was told: " + ", ".join(study.settings.without) + ".")
    if any(run.drive.speed_imposed for run in study.runs):
        base.append("Speed is imposed where throttle or brakes were not recorded.")
    return tuple(base)


def missing_channels(study: Study) -> tuple[tuple[str, str], ...]:
    """Channels no run has, and what each would have told apart."""
    have = {c for run in study.runs for c in run.recording.channels}
    return tuple((label, splits) for piece, label, splits in _SPLITTERS
                 if not any(piece in c for c in have)
                 and (not piece.startswith("trailer") or len(study.packed.vehicle.units) > 1))
