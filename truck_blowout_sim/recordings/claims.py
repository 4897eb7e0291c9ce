"""Nothing that exists is overwritten unasked, and no output lands on an input."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from os import PathLike
from pathlib import Path

from truck_blowout_sim.errors import InputError


def claim(output: str | PathLike[str], *, force: bool = False,
          inputs: Iterable[str | PathLike[str]] = (), writes: Sequence[str] = (),
          one_file: bool = False, instead: str = "a new name, or --force to replace it") -> Path:
    """Check, before any work is done, that an output may be written.

    Args:
        output: the file or folder that the user named.
        force: the user allows what exists to be replaced (`--force`).
        inputs: what the verb reads: paths, or names of shipped files (those are left alone, as
            they are no paths).
        writes: names of the files and folders written inside ``output``. Empty: ``output`` itself
            is written whole, as a file or a bag.
        one_file: ``output`` becomes a file, never a bag.
        instead: what is expected where it exists.

    Returns:
        ``output`` as a path.

    Raises:
        InputError: the output lies on, in or around an input, even with ``force``; or it exists
            and ``force`` is not given; or it is a folder in place of a file; or nothing can be
            written there.
    """
    target = Path(output)
    if not writes and target.name in ("", ".."):
        raise InputError("is a folder that exists", file=target, expected="a new name in it")
    written = [target / name for name in writes] if writes else [target]
    for source in (Path(i) for i in inputs):
        for path in written:
            if source.exists() and _overlap(source, path):
                raise InputError(f"would be written onto the input {source}", file=path,
                                 expected="an output apart from every input")
    if writes and target.exists() and not target.is_dir():
        raise InputError("is a file", file=target, expected="a folder to write into")
    if one_file and target.is_dir():
        raise InputError("is a folder", file=target, expected="a file to write")
    if not force:
        for path in written:
            if path.exists() and not (path.is_dir() and not any(path.iterdir())):
                raise InputError("exists already", file=path, expected=instead)
    _check_writable(target)
    return target


def _overlap(source: Path, written: Path) -> bool:
    """Whether one path is the other, or lies inside it; links are followed."""
    a, b = source.resolve(), written.resolve()
    return a == b or (b.is_dir() and b in a.parents) or (a.is_dir() and a in b.parents)


def _check_writable(target: Path) -> None:
    place = target if target.is_dir() else target.parent
    while not place.exists() and place != place.parent:
        place = place.parent
    problem = "is no folder" if not place.is_dir() else ""
    if not problem and not os.access(place, os.W_OK | os.X_OK):
        problem = "cannot be written to: permission denied"
    if problem:
        raise InputError(f"{place} {problem}", file=target,
                         expected="an output in a folder that you may write to")
