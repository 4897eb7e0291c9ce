"""Faults put into real recordings, and what the diagnosis says of each.

    python -m benchmarks.cars.faults NAME TRAIN HOLDOUT VEHICLE [--settings NAME]
        [--baseline FILE] [--map FILE] [-o docs/proof_cars.md]

TRAIN and HOLDOUT get the same fault; the baseline run, if there is one, stays as it was recorded.
NAME is that of the marks on the page, ``faults_NAME``.

Validated with: test/benchmarks/test_cars.py.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import radians
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from benchmarks.page import Page, Place, Table, start_function
from truck_blowout_sim import Recording, Series, diagnose, read_recording
from truck_blowout_sim.diagnosis import QUICK
from truck_blowout_sim.diagnosis.result import Diagnosis, Effect, amount_text, label_of

Change = Callable[[Recording], Recording]
YAW_RATE, HAND_WHEEL, SPEED = (
    "tractor_yaw_rate_radps", "steering_wheel_angle_rad", "tractor_vx_mps")
AX, AY = "tractor_ax_mps2", "tractor_ay_mps2"


def line(channel: str, gain: float, zero: float = 0.0) -> Change:
    """A channel that reads ``gain`` times the truth, and a constant."""
    return lambda r: r.with_channels(
        {channel: Series(r[channel].time_s, gain * r[channel].value + zero)})


def late(channel: str, by_s: float) -> Change:
    """A channel whose samples arrive late, on the instants that it had."""
    return lambda r: r.with_channels({channel: Series(r[channel].time_s, np.interp(
        r[channel].time_s - by_s, r[channel].time_s, r[channel].value))})


def exchanged(one: str, other: str) -> Change:
    """Two channels under each other's names."""
    return lambda r: r.with_channels({one: r[other], other: r[one]})


FAULTS: Mapping[str, Change] = {
    "none": lambda r: r,
    "yaw rate 0.2 s late": late(YAW_RATE, 0.2),
    "yaw rate times 1.08": line(YAW_RATE, 1.08),
    "yaw rate of the other sign": line(YAW_RATE, -1.0),
    "steering angle off by 1 deg": line(HAND_WHEEL, 1.0, radians(1.0)),
    "speed times 1.05": line(SPEED, 1.05),
    "lateral acceleration times 1.10": line(AY, 1.10),
    "lateral acceleration of the other sign": line(AY, -1.0),
    "accelerations exchanged": exchanged(AX, AY),
}


def said(answer: Diagnosis, before: Diagnosis | None = None) -> str:
    """What was named, with amounts and what explains it as well; else the verdict.

    ``before``: of the recordings as they are; what was named of these is left out.
    """
    known = {_kind(effect): label_of(effect, before.effects) for effect in before.effects
             } if before else {}
    words = []
    for effect, aliases in zip(answer.effects, answer.alias_sets, strict=True):
        if _kind(effect) in known:
            continue
        amounts = ", ".join(amount_text(*one) for one in effect.parameters.items())
        others = [name for name in dict.fromkeys(aliases.names) if name != effect.name]
        words.append(": ".join(filter(None, (label_of(effect, answer.effects), amounts)))
                     + (f" (or {', '.join(others)})" if others else ""))
    kept = {_kind(effect) for effect in answer.effects}
    lost = [label for kind, label in known.items() if kind not in kept]
    text = "; ".join(words) or ("nothing" if before else f"{answer.verdict}, nothing named")
    return f"{text}; no longer {', '.join(lost)}" if lost else text


def _kind(effect: Effect) -> tuple[object, ...]:
    return effect.name, effect.where, effect.channels


def measure(name: str, train: Path, holdout: Path, vehicle: str, settings: str = "default",
            baseline: Annotated[Path | None, typer.Option(help="The same car, before.")] = None,
            mapping: Annotated[Path | None, typer.Option("--map", help="Mapping file.")] = None,
            page: Page = None) -> None:
    """A row each fault."""
    place = Place(page, f"faults_{name}")
    seen, unseen = (read_recording(path, mapping=mapping) for path in (train, holdout))
    before = [] if baseline is None else [read_recording(baseline, mapping=mapping)]
    made, as_it_is = Table("put in", "stated (in the other rows: in addition to the first)"), None
    for words, change in FAULTS.items():
        answer, _ = diagnose([change(seen)], baseline=before, holdout=[change(unseen)],
                             vehicle=vehicle, settings=settings, effort=QUICK)
        made.row(words, said(answer, as_it_is))
        as_it_is = as_it_is or answer
    place.write(made)


if __name__ == "__main__":
    start_function(measure)
