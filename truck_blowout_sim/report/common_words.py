"""What several names share, for an axis, and what tells them apart, for a legend."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import takewhile

_JOINTS = ("of", "the", "in", ",")


def shared_words(names: Sequence[str]) -> tuple[str, list[str]]:
    """Split names into the words at their beginning and end that all share, and the rest.

    Args:
        names: e.g. ``yaw rate of the tractor`` and ``yaw rate of the trailer``.

    Returns:
        What is shared (``yaw rate``; empty if nothing is), and the own words of each
        (``tractor``, ``trailer``). One name is shared as a whole.
    """
    split = [re.findall(r"[^\s,]+|,", name) for name in names]
    if len(set(names)) < 2:
        return (names[0] if names else "", list(names))
    first = _same(split)
    rest = [words[first:] for words in split]
    last = _same([words[::-1] for words in rest])
    own = [words[:len(words) - last] for words in rest]
    end = rest[0][len(rest[0]) - last:]
    start = split[0][:first]
    shared = start + end if end and end[0] != "," else _trimmed(start) + end
    if not shared or not all(own):
        return "", list(names)
    return _joined(shared), [_joined(words) for words in own]


def _same(split: Sequence[Sequence[str]]) -> int:
    """Words that all have in common from the start on."""
    return len(list(takewhile(lambda column: len(set(column)) == 1, zip(*split, strict=False))))


def _trimmed(words: list[str]) -> list[str]:
    while words and words[-1] in _JOINTS:
        words = words[:-1]
    return words


def _joined(words: Sequence[str]) -> str:
    return " ".join(words).replace(" ,", ",")
