"""Guessed signs: from gravity, a compass, and what must go together in a turn.

    yaw rate             = d(heading)/dt
    lateral acceleration = speed * yaw rate

References: SAE J670 (z down, y right), ISO 8855 (z up, y left); a compass counts clockwise from
north.
Known limits: where neither gravity nor a compass is recorded, axes that are all turned over look
like ours.
Validated with: test/recordings/test_proposing.py, test/recordings/test_guessed_signs.py.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings.channels import UNITS
from truck_blowout_sim.recordings.logs.log import Column, Log
from truck_blowout_sim.recordings.mapping.vocabulary import words_of
from truck_blowout_sim.recordings.units import GRAVITY_MPS2, find_unit

if TYPE_CHECKING:
    from truck_blowout_sim.recordings.mapping.proposing import Proposal

FloatArray = NDArray[np.float64]

_DOWNWARD = ("vy_mps", "y_m", "yaw_rad", "yaw_rate_radps", "pitch_rad", "pitch_rate_radps",
             "ay_mps2", "az_mps2")  # fmt: skip
_BY_GRAVITY = "sign: the vertical acceleration reads downward (SAE axes)"
_BY_COMPASS = "sign: the compass heading turns with the yaw rate, so right is positive (SAE axes)"
_AGAINST = "sign: it turns against the yaw rate"
_HALF = 0.5  # of gravity: between an acceleration with it and one without
_MOSTLY = 0.3  # correlation that a sign needs
_COMPASS = re.compile(r"\b(heading|course|cog|track|kurs)\b")
_ON_EARTH = re.compile(r"\b(utm\w*|north\w*)\b")
_COMPASS_DEG = 90.0

Pairs = Iterable[tuple["Proposal", Column]]


def with_signs(
    pairs: list[tuple[Proposal, Column]], together: Mapping[str, float]
) -> list[Proposal]:
    """Proposals with the signs that the numbers tell.

    Args:
        pairs: proposals with their columns, units settled.
        together: by channel, correlation of a heading's change, or of a lateral acceleration, with
            the yaw rate as recorded.
    """
    down = {unit: why for unit in UNITS if (why := _downward(pairs, unit, together))}
    rates = {p.channel: column for p, column in pairs if p.channel.endswith("yaw_rate_radps")}
    out = []
    for proposal, column in pairs:
        unit, _, stem = proposal.channel.partition("_")
        sign, why = 1.0, ""
        if unit in down and stem in _DOWNWARD and not _ON_EARTH.search(words_of(proposal.column)):
            sign, why = -1.0, down[unit]
        reference = rates.get("tractor_yaw_rate_radps")
        alike = together.get(proposal.channel, 0.0)
        if proposal.channel == "steering_wheel_angle_rad" and reference is not None:
            unit, alike = "tractor", _correlation(column, reference)
        if abs(alike) > _MOSTLY:
            turned = -1.0 if (alike < 0.0) != (unit in down) else 1.0
            why = why if turned == sign else _AGAINST * (turned < 0.0)
            sign = turned
        out.append(_signed(proposal, sign, why, known=abs(alike) > _MOSTLY))
    return out


def _signed(proposal: Proposal, sign: float, why: str, *, known: bool) -> Proposal:
    """A proposal with its sign; a compass's heading with its offset."""
    offset = 0.0
    if _is_compass(proposal) and (sign < 0.0 or not known):
        sign, offset = -1.0, -_COMPASS_DEG
        why = "sign and offset: a compass heading, clockwise from north"
    reasons = (*proposal.why, why) if why else proposal.why
    return replace(proposal, sign=sign, offset=offset, why=reasons)


def _is_compass(proposal: Proposal) -> bool:
    named = bool(_COMPASS.search(words_of(proposal.column)))
    return named and proposal.channel.endswith("yaw_rad")


def _downward(pairs: Pairs, unit: str, together: Mapping[str, float]) -> str:
    """Why z points down in a unit's instrument; empty where nothing says so."""
    upward = upward_g(pairs, unit)
    if upward < -_HALF:
        return _BY_GRAVITY
    alike = together.get(f"{unit}_yaw_rad", 0.0)
    if upward > _HALF or alike <= _MOSTLY:
        return ""
    return _BY_COMPASS if any(
        _is_compass(p) and p.channel.startswith(unit) and _full_circle(p, column)
        for p, column in pairs
    ) else ""  # fmt: skip


def _full_circle(proposal: Proposal, column: Column) -> bool:
    """Degrees from 0 to 360, as of a compass; a heading of a computer may be negative."""
    stated = find_unit(proposal.unit or column.unit)
    return stated is not None and stated.name == "deg" and float(np.nanmin(column.values)) >= 0.0


def upward_g(pairs: Pairs, unit: str) -> float:
    """Median vertical acceleration of a unit: 1; -1 where z points down; 0 or NaN."""
    for proposal, column in pairs:
        stated = find_unit(proposal.unit or column.unit)
        if proposal.channel == f"{unit}_az_mps2" and stated is not None:
            return float(np.nanmedian(column.values)) * stated.factor / GRAVITY_MPS2
    return np.nan


def gravity_is_removed(log: Log, proposals: Iterable[Proposal]) -> bool:
    """Whether the vertical accelerations say that gravity is not in them, as CarSim's."""
    pairs = [(one, log.column(one.column)) for one in proposals if one.channel.endswith("_az_mps2")]
    return any(abs(upward_g(pairs, unit)) < _HALF for unit in UNITS)


def _correlation(one: Column, other: Column) -> float:
    """Correlation of two columns; 0 where they cannot be laid side by side."""
    a, b = one.values, other.values
    if one.times and other.times:
        ta, tb = (next(iter(c.times.values())) for c in (one, other))
        if ta.size < 2 or tb.size < 2:
            return 0.0
        b, a = np.interp(ta, tb, b), a
    elif a.size != b.size:
        return 0.0
    there = np.isfinite(a) & np.isfinite(b)
    a, b = a[there], b[there]
    if a.size < 3 or np.std(a) == 0.0 or np.std(b) == 0.0:
        return 0.0
    return float(np.corrcoef(a, b)[0, 1])
