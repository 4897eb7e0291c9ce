"""The key that a person means who mistyped one: of any file of a study, in the unit he wrote."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from difflib import SequenceMatcher, get_close_matches

from truck_blowout_sim.vehicle.units import in_unit_of, si_key

_SIMILAR, _TRIED, _LONGEST = 0.6, 20, 120


def suggestion(text: str, known: Iterable[str], is_key: Callable[[str], bool]) -> str:
    """The nearest key, as it may be given; empty if none is like it.

    Args:
        text: the key as it was written.
        known: dotted keys in SI, of equally near ones the likeliest first.
        is_key: whether a key can be given so.
    """
    asked = si_key(text[:_LONGEST].lower())[0]
    candidates = list(dict.fromkeys(one for key in known for one in _forms(key, asked)))
    near = [one for one in candidates if _holds(one, asked)] + sorted(
        get_close_matches(asked, candidates, _TRIED, _SIMILAR),
        key=lambda one: (-_likeness(asked, one), candidates.index(one)))
    spelled = (in_unit_of(text, one) for one in near)
    return next((one for one in spelled if is_key(one)), "")


def _holds(key: str, asked: str) -> bool:
    """Whether a key has every word that was asked for, in this order: sections were left out."""
    words = iter(key.split("."))
    return all(word in words for word in asked.split("."))


def _forms(key: str, asked: str) -> Iterator[str]:
    """A key, also with the stars of the written one."""
    yield key
    words, given = key.split("."), asked.split(".")
    if "*" in given and len(words) == len(given):
        yield ".".join("*" if star == "*" else word
                       for word, star in zip(words, given, strict=True))


def _likeness(asked: str, key: str) -> float:
    """Share of equal letters: word by word where there are as many, else of the whole."""
    ours, theirs = asked.split("."), key.split(".")
    whole = SequenceMatcher(None, key, asked).ratio()
    if len(ours) != len(theirs):
        return whole - 0.1
    shares = [SequenceMatcher(None, b, a).ratio() for a, b in zip(ours, theirs, strict=True)]
    return (whole + sum(shares) / len(shares)) / 2.0
