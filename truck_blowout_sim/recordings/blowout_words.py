"""Blowouts as a person writes them: `TIRE@SECONDS`."""

from __future__ import annotations

import math
from collections.abc import Sequence

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.recordings.recording import Blowout

ONCE = "each tire at most once"
_EXPECTED = "TIRE@SECONDS; tires that burst together are joined by +"


def parse_blowouts(words: Sequence[str]) -> list[Blowout]:
    """``TIRE@SECONDS`` words as blowouts; tires that burst together are joined by ``+``.

    Raises:
        InputError: a word of another form.
    """
    events = []
    for word in words:
        tires, sign, text = word.partition("@")
        if not (tires and sign):
            raise InputError(f"--blow {quoted(word)}", expected=_EXPECTED)
        events.append(Blowout(_number(text, f"--blow {quoted(word)}"), tuple(tires.split("+"))))
    return events


def bursts_twice(tire: str, one_s: float, other_s: float) -> str:
    """What is wrong with two events of the same tire, earlier instant first."""
    first_s, second_s = sorted((one_s, other_s))
    return f"{tire} bursts at {first_s:g} s and again at {second_s:g} s"


def _number(text: str, where: str) -> float:
    try:
        value = float(text)
    except ValueError:
        raise InputError(f"{where}: {quoted(text)} is not a number", expected=_EXPECTED) from None
    if not math.isfinite(value):
        raise InputError(f"{where}: {quoted(text)} is not finite", expected="a finite number")
    return value
