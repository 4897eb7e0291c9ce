"""Find a recording by path, or by name among those that ship with the package."""

from __future__ import annotations

import os
from pathlib import Path

from truck_blowout_sim.errors import InputError, closest, quoted
from truck_blowout_sim.resources import config_dir

_FOLDER = "recordings"


def find_recording(name: str | os.PathLike[str]) -> Path:
    """The path itself if something is there, else the shipped recording of that name.

    Raises:
        InputError: neither; says which names there are.
    """
    path = Path(name)
    if path.exists():
        return path
    shipped = config_dir() / _FOLDER / f"{path.name.removesuffix('.csv')}.csv"
    if path.parent == Path() and shipped.is_file() and shipped.stem in shipped_recordings():
        return shipped
    near = closest(path.name, shipped_recordings()) if path.parent == Path() else ""
    raise InputError(
        f"no such file or folder: {quoted(os.fspath(name))}"
        + (f" (did you mean {near!r}?)" if near else ""),
        expected="a recording's path or one of: " + ", ".join(shipped_recordings()),
    )


def shipped_recordings() -> tuple[str, ...]:
    """Names of the recordings that ship with the package."""
    found = (config_dir() / _FOLDER).glob("*.csv")
    return tuple(sorted(path.stem for path in found if "." not in path.stem))
