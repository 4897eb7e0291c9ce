"""Words of the command line that change a run: `NAME=VALUE`, `TIRE@SECONDS`."""

from __future__ import annotations

import math
from collections.abc import Sequence

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.recordings import Blowout


def parse_values(words: Sequence[str]) -> dict[str, float]:
    """``NAME=VALUE`` words as a mapping.

    Raises:
        InputError: a word of another form.
    """
    values = {}
    for word in words:
        name, sign, text = word.partition("=")
        if not (name and sign):
            raise InputError(f"--set {quoted(word)}", expected="NAME=VALUE")
        values[name.strip()] = _number(text, f"--set {quoted(word)}")
    return values


def parse_blowouts(words: Sequence[str]) -> list[Blowout]:
    """``TIRE@SECONDS`` words as blowouts; the word ``none`` alone as no blowout.

    Raises:
        InputError: a word of another form.
    """
    if list(words) == ["none"]:
        return []
    events = []
    for word in words:
        tires, sign, text = word.partition("@")
        if not (tires and sign):
            raise InputError(f"--blow {quoted(word)}", expected="TIRE@SECONDS, or none")
        events.append(Blowout(_number(text, f"--blow {quoted(word)}"), tuple(tires.split("+"))))
    return events


def _number(text: str, where: str) -> float:
    try:
        value = float(text)
    except ValueError:
        raise InputError(f"{where}: {quoted(text)} is not a number") from None
    if not math.isfinite(value):
        raise InputError(f"{where}: {quoted(text)} is not finite", expected="a finite number")
    return value
