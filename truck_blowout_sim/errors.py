"""Errors a user can act on: each is one line."""

from __future__ import annotations

import difflib
import errno
import re
from collections.abc import Iterable
from pathlib import Path

_LONGEST_VALUE = 200
_SIMILAR = 0.5
_MOST_NAMES = 8


class InputError(Exception):
    """Bad input: says which file, where in it, what is wrong, and what was expected.

    Args:
        problem: what was found, with the value.
        file: the file (or the name of the argument) the input came from.
        where: place in it: ``line 12, column tractor_vx_mps``, ``byte 4096``, ``key mass_kg``;
            empty if the whole file is meant.
        expected: what would have been right.

    ``str()`` is one line, whatever the arguments contain.
    """

    def __init__(
        self,
        problem: str,
        *,
        file: str | Path | None = None,
        where: str | None = None,
        expected: str | None = None,
    ) -> None:
        self.file = _one_line(str(file)) if file is not None else ""
        self.where = _one_line(where or "")
        self.problem = _one_line(problem)
        self.expected = _one_line(expected or "")
        super().__init__(str(self))

    def __str__(self) -> str:
        place = ", ".join(part for part in (self.file, self.where) if part)
        line = f"{place}: {self.problem}" if place else self.problem
        return f"{line}; expected {self.expected}" if self.expected else line

    def __reduce__(self) -> tuple[object, ...]:
        # keyword-only arguments: the default would call InputError(str) in another process
        return _rebuild_input_error, (self.problem, self.file, self.where, self.expected)


class StorageError(OSError):
    """A file could not be written (disk full, no permission); what was written stays readable.

    Args:
        problem: the operating system's words.
        file: the file being written.
        number: the ``errno`` behind it.
        saved: what of the file is kept; empty where that is not said, or nothing is.
    """

    def __init__(self, problem: str, *, file: str | Path, number: int = errno.EIO,
                 saved: str = "") -> None:
        self.problem = _one_line(problem)
        self.saved = _one_line(saved)
        super().__init__(number, self.problem, _one_line(str(file)))

    def __str__(self) -> str:
        return f"{self.filename}: {'; '.join(filter(None, (self.problem, self.saved)))}"

    def __reduce__(self) -> tuple[object, ...]:
        return _rebuild_storage_error, (self.problem, self.filename, self.errno, self.saved)


def quoted(value: object) -> str:
    """The value as found in a file, quoted, on one line, shortened if it is very long."""
    text = _one_line(repr(value))
    return text if len(text) <= _LONGEST_VALUE else text[: _LONGEST_VALUE - 4] + "...'"


def nearest(name: str, known: Iterable[str], otherwise: str = "") -> str:
    """The known name that resembles this one most, as words for ``expected``.

    Args:
        name: what was asked for.
        known: what there is.
        otherwise: what to say if nothing resembles it.
    """
    names = list(known)
    if near := closest(name, names):
        return f"{near} (the nearest)"
    return otherwise or ", ".join(names[:_MOST_NAMES]) + (" …" if len(names) > _MOST_NAMES else "")


def closest(name: str, known: Iterable[str], similar: float = _SIMILAR) -> str:
    """The known name that a person means who wrote this one; empty if none is like it.

    The same words in another order come first, then a name that holds what was written, then
    the one of the most equal letters.

    Args:
        name: what was written.
        known: what there is; of equally near names the first one is taken.
        similar: least share of equal letters, 0 to 1.
    """
    written = name.lower()[:_LONGEST_VALUE]
    lowered = {one.lower(): one for one in reversed(list(known))}
    names = list(reversed(lowered))
    same = [one for one in names if _words(one) == _words(written)]
    holding = [one for one in names if written and written in one]
    if near := same or sorted(holding, key=len):
        return lowered[near[0]]
    alike = difflib.get_close_matches(written, names, len(names) or 1, similar)
    if not alike:
        return ""
    shares = {one: difflib.SequenceMatcher(None, one, written).ratio() for one in alike}
    return lowered[max((one for one in names if one in shares), key=shares.__getitem__)]


def _words(name: str) -> list[str]:
    return sorted(re.findall(r"[^\W_]+", name))


def _rebuild_input_error(problem: str, file: str, where: str, expected: str) -> InputError:
    return InputError(problem, file=file or None, where=where, expected=expected)


def _rebuild_storage_error(problem: str, file: str, number: int, saved: str) -> StorageError:
    return StorageError(problem, file=file, number=number, saved=saved)


def _one_line(text: str) -> str:
    return " ".join("".join(c if c.isprintable() else " " for c in text).split())
