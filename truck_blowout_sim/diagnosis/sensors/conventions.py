"""Are signs, axes and the treatment of gravity as they are said to be? Asked before anything else.

A channel that is positive the other way, two channels that are exchanged, and accelerations that
are said to be free of gravity and are not, leave no amount to estimate: a log has them or not.
Each such reading of the log is tried, and the one under which the kinematic identities leave less
by a clear likelihood ratio is taken; then the next is sought in the log so read. Two relations
join the identities, which a mirrored instrument satisfies: a truck turns to the side to which its
hand wheel is turned, and it drives forward.

References: see `reading.py`.
Known limits: the instruments of one truck all mirrored, hand wheel included, are consistent.
Validated with: test/diagnosis/test_sensors_conventions.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.sensors.distortions import (
    Convention,
    GravityConvention,
    Sign,
    Swap,
)
from truck_blowout_sim.diagnosis.sensors.geometry import Geometry
from truck_blowout_sim.diagnosis.sensors.gravity import look_alikes
from truck_blowout_sim.diagnosis.sensors.hubs import axle_pairs
from truck_blowout_sim.diagnosis.sensors.identities import channel_names
from truck_blowout_sim.diagnosis.sensors.reading import Reading
from truck_blowout_sim.diagnosis.sensors.signals import WHEEL, Signals
from truck_blowout_sim.recordings.channels import UNITS, hub_of
from truck_blowout_sim.recordings.gravity import ACCELERATIONS

_FAMILY_P = 1e-4
_PER_CHANNEL = 2.0  # log odds that one more channel of an instrument is wired the other way
_ALIAS = 4.5  # log likelihood ratio within which two readings cannot be told apart
_EXPLAINED = 0.75  # half-way from noise alone (a half) to all of it
_MOST = 6
_DELAYS_S = np.arange(0.05, 0.65, 0.05)  # a late channel must not pass for an inverted one
_WORDS = {"x": "x position", "y": "y position", "yaw": "heading", "roll": "roll", "pitch": "pitch",
          "vx": "forward speed", "vy": "lateral speed", "r": "yaw rate", "p": "roll rate",
          "q": "pitch rate", "ax": "longitudinal acceleration",
          "ay": "lateral acceleration"}  # fmt: skip
_PAIRS = (("vx", "vy"), ("ax", "ay"), ("roll", "pitch"), ("p", "q"), ("p", "r"), ("q", "r"),
          ("x", "y"))  # fmt: skip
_GROUPS = (
    ("accelerometer", ("ax", "ay")),
    ("gyros", ("p", "q", "r")),
    ("velocity", ("vx", "vy")),
    ("lateral acceleration and speed", ("ay", "vy")),
    ("instrument with its z axis down", ("y", "vy", "ay", "yaw", "r", "pitch", "q")),
)


@dataclass(frozen=True)
class FoundConvention:
    """A reading of the log that fits better than what the log states.

    Attributes:
        convention: what to change.
        everywhere: in the baseline recordings too.
        log_ratio: log likelihood ratio against the log as stated.
        tests: how many readings were tried.
        rivals: readings that fit as well.
        amounts: names of faults with an amount that do.
    """

    convention: Convention
    everywhere: bool
    log_ratio: float
    tests: int
    rivals: tuple[Convention, ...]
    amounts: tuple[str, ...] = ()


def find_conventions(
    signals: Sequence[Signals], is_baseline: Sequence[bool], geometry: Geometry
) -> tuple[FoundConvention, ...]:
    """Signs, exchanges and gravity that are not as stated, the clearest first.

    Args:
        signals: of each recording, as measured.
        is_baseline: flag of each.
        geometry: lengths, for what both units share.
    """
    logs = [Reading.of(_with_wheel(s), geometry) for s in signals]
    flags = np.array(is_baseline)
    found: list[FoundConvention] = []
    while len(found) < _MOST:
        best = _best(logs, flags)
        if best is None:
            break
        found.append(best)
        logs = [log.read_as(best.convention) if best.everywhere or not baseline else log
                for log, baseline in zip(logs, flags.tolist(), strict=True)]  # fmt: skip
    return tuple(found)


def _best(logs: Sequence[Reading], is_baseline: NDArray[np.bool_]) -> FoundConvention | None:
    """The reading that fits best, if it fits clearly better than the log as it stands."""
    present = set.intersection(*(set(log.signals.values) for log in logs))
    pairs = set.intersection(*(set(axle_pairs(log.signals)) for log in logs))
    tried = [*_readings(present), *_exchanged_wheels(sorted(pairs))]
    scored: list[tuple[float, int, Convention, bool]] = []
    for order, convention in enumerate(tried):
        gains = np.array([log.log_ratio(convention) for log in logs])
        price = _PER_CHANNEL * (len(convention.channels) - 1)
        there = gains[is_baseline]
        everywhere = bool(there.sum() >= 0.0)
        # what even a run of the sound instrument gains, on a straight, is no sign of a fault
        here = gains[~is_baseline] - (0.0 if everywhere else max(float(there.max()), 0.0))
        total = float(here.sum()) + max(float(there.sum()), 0.0)
        scored.append((total - price, order, convention, everywhere))
    if not scored:
        return None
    scored.sort(key=lambda item: (-item[0], item[1]))
    ratio, _, convention, everywhere = scored[0]
    needed = float(np.log(len(tried) / _FAMILY_P))
    faulty = [log for log, baseline in zip(logs, is_baseline.tolist(), strict=True)
              if everywhere or not baseline]
    if ratio < needed or any(merely(faulty, convention) for merely in (
            _merely_late, _merely_quieter, _merely_noise)):  # fmt: skip
        return None
    names = (look_alikes(faulty, convention, _ALIAS)
             if isinstance(convention, GravityConvention) else ())
    if names is None:
        return None
    rivals = tuple(c for r, _, c, _ in scored[1:] if ratio - r < _ALIAS)
    return FoundConvention(convention, everywhere, ratio, len(tried), rivals, names)


def _merely_late(logs: Sequence[Reading], convention: Convention) -> bool:
    """Whether a delay of one channel does as well as another sign or axis, over all logs."""
    here = sum(log.log_ratio(convention) for log in logs)
    channels = sorted(set.union(*(log.concerned(convention) for log in logs)))
    return any(sum(log.late_gain(channel, delay_s, convention) for log in logs) > here
               for channel in channels for delay_s in _DELAYS_S.tolist())


def _merely_quieter(logs: Sequence[Reading], convention: Convention) -> bool:
    """Whether one of two exchanged channels fits worse in the other's place.

    What is exchanged fits in both places; a channel of little noise seems to fit everywhere.
    """
    if not isinstance(convention, Swap):
        return False
    one, other = convention.channels
    return any(sum(log.gain_with(a, b, convention) for log in logs) < -_ALIAS
               for a, b in ((one, other), (other, one)))


def _merely_noise(logs: Sequence[Reading], convention: Convention) -> bool:
    """Whether the change removes what is left no better than a change of noise alone would.

    Of what a wrong reading leaves, the right one explains all; of noise that enters the identities
    with either sign, it explains half by itself, and a little more by chance.
    """
    product, square = np.sum([log.share_explained(convention) for log in logs], axis=0)
    return bool(product < _EXPLAINED * square)


def _readings(present: set[str]) -> list[Convention]:
    """Every other way in which the recorded channels could be meant."""
    found: list[Convention] = []
    if WHEEL in present:
        found.append(Sign("channel_sign", "", "hand wheel", (WHEEL,)))
    for unit in ("tractor", "trailer"):
        n = channel_names(unit)
        have = {key: n[key] for key in _WORDS if n[key] in present}
        found += [Sign("channel_sign", unit, f"{unit} {_WORDS[key]}", (channel,))
                  for key, channel in have.items()]  # fmt: skip
        for label, keys in _GROUPS:
            channels = tuple(have[key] for key in keys if key in have)
            if len(channels) > 1:
                found.append(Sign("channel_sign", unit, f"{unit} {label}", channels))
        found += [
            Swap("channel_swap", unit, f"{unit} {_WORDS[a]} and {_WORDS[b]}", (have[a], have[b]))
            for a, b in _PAIRS
            if a in have and b in have
        ]
    for key in ("vx", "vy", "r", "p", "q", "ax", "ay", "roll", "pitch", "yaw"):
        both = tuple(channel_names(unit)[key] for unit in ("tractor", "trailer"))
        if set(both) <= present:
            label = f"{_WORDS[key]} of tractor and trailer"
            found.append(Swap("channel_swap", "", label, both))
    return _unlike([*found, *_treatments(present)])


def _exchanged_wheels(pairs: Sequence[tuple[str, str]]) -> list[Convention]:
    """Left and right hub speed of an axle exchanged, as by their plugs."""
    return [Swap("channel_swap", "trailer" if hub_of(left).startswith("trailer") else "tractor",
                 f"hub speeds {hub_of(left)} and {hub_of(right)}", (left, right))
            for left, right in pairs]


def _treatments(present: set[str]) -> list[Convention]:
    """Gravity treated otherwise than is said: by the accelerometers of each unit, and by all."""
    told = {unit: [f"{unit}_{stem}" for stem in ACCELERATIONS if f"{unit}_{stem}" in present]
            for unit in UNITS if f"{unit}_az_mps2" in present or any(
                f"{unit}_{angle}_rad" in present for angle in ("roll", "pitch"))}
    asked = [("", "accelerometers", [c for channels in told.values() for c in channels]),
             *((unit, f"{unit} accelerometers", channels) for unit, channels in told.items())]
    return [GravityConvention("gravity_convention", unit, words, tuple(sorted(channels)))
            for unit, words, channels in asked if channels]


def _unlike(found: Sequence[Convention]) -> list[Convention]:
    """Each reading once; a group that holds one recorded channel is that channel."""
    seen: dict[tuple[str, frozenset[str]], Convention] = {}
    for one in found:
        seen.setdefault((one.name, frozenset(one.channels)), one)
    return list(seen.values())


def _with_wheel(signals: Signals) -> Signals:
    wheel = signals.wheel_rad
    return signals if wheel is None else signals.with_values({WHEEL: wheel})
