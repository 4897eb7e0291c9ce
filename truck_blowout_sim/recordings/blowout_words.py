"""Blowouts as a person writes them: `TIRE@SECONDS`."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

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


def second_burst(events: Sequence[Blowout], run_of: Callable[[float], int] = lambda time_s: 0
                 ) -> tuple[int, str] | None:
    """Position of the first event that bursts a tire again, and what is wrong; None if none does.

    ``run_of``: which run an instant is in; in another one the tire is whole again.
    """
    blown_s: dict[tuple[int, str], float] = {}
    for position, event in enumerate(events):
        for tire in event.tires:
            key = (run_of(event.time_s), tire)
            if key in blown_s:
                first_s, second_s = sorted((blown_s[key], event.time_s))
                return position, f"{tire} bursts at {first_s:g} s and again at {second_s:g} s"
            blown_s[key] = event.time_s
    return None


def _number(text: str, where: str) -> float:
    try:
        value = float(text)
    except ValueError:
        raise InputError(f"{where}: {quoted(text)} is not a number", expected=_EXPECTED) from None
    if not math.isfinite(value):
        raise InputError(f"{where}: {quoted(text)} is not finite", expected="a finite number")
    return value
