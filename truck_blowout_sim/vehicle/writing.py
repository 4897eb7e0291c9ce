"""Writing a vehicle that differs from another by some parameters: what a diagnosis leaves."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from pathlib import Path

import yaml

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.resources import config_names
from truck_blowout_sim.vehicle.document import Place
from truck_blowout_sim.vehicle.loading import load_vehicle
from truck_blowout_sim.vehicle.packing.names import parameter_index, unknown_parameter
from truck_blowout_sim.vehicle.vehicle import Vehicle


def write_vehicle(
    path: str | os.PathLike[str],
    base: Vehicle | str | os.PathLike[str],
    values: Mapping[str, float],
    sources: Mapping[str, str] | None = None,
    *,
    title: str | None = None,
) -> Vehicle:
    """Write a vehicle file that extends another and sets parameters by their packed names.

    The file is complete or not there: it is written beside its place, read back, then moved.

    Args:
        path: file to write; its folder must exist.
        base: the vehicle it extends: loaded, the name of a shipped one, or a path.
        values: SI values by packed name, such as `hub.trailer_2_left.brake_gain`.
        sources: where each value comes from, by the same names.
        title: the line a person reads; the base's with "changed" where it is not given.

    Returns:
        The vehicle, loaded from the new file.

    Raises:
        InputError: an unknown parameter, a value it cannot have, or a file that cannot be written.
    """
    target = Path(path)
    parent = base if isinstance(base, Vehicle) else load_vehicle(base)
    if target.exists() and target.samefile(parent.path):
        raise InputError("would be its own base", file=target, expected="another file to write")
    _refuse_unknown(parent, target, values)
    text = _document(parent, target, values, sources or {}, title or f"{parent.title}, changed")
    # in the same folder, so that `extends` finds the same base
    draft = target.with_name(f".{target.name}.{os.getpid()}.draft")
    try:
        draft.write_text(text, encoding="utf-8")
        _check(draft, target)
        draft.replace(target)
    except OSError as error:
        raise InputError(
            f"cannot be written: {error.strerror}", file=target, expected="a folder to write to"
        ) from error
    finally:
        draft.unlink(missing_ok=True)
    return load_vehicle(target)


def _check(draft: Path, target: Path) -> None:
    """Load what will be the target, and name the target if it cannot be."""
    try:
        load_vehicle(draft)
    except InputError as error:
        file = target if error.file and Path(error.file) == draft else error.file
        raise InputError(error.problem, file=file, where=error.where,
                         expected=error.expected) from error


def _refuse_unknown(parent: Vehicle, target: Path, values: Mapping[str, float]) -> None:
    index = parameter_index(parent)
    for name, value in values.items():
        if name not in index:
            raise unknown_parameter(Place(str(target), 1, "effects"), name, index)
        if math.isnan(value):
            raise InputError(f"{name} is not a number (NaN)", expected="a number")


def _document(
    parent: Vehicle,
    target: Path,
    values: Mapping[str, float],
    sources: Mapping[str, str],
    title: str,
) -> str:
    effects = {
        name: {"value": float(value), "source": _one_line(sources.get(name, "not stated"))}
        for name, value in values.items()
    }
    content = {
        "extends": _reference(parent, target),
        "title": _one_line(title),
        "effects": effects,
    }
    return yaml.safe_dump(content, sort_keys=False, allow_unicode=True, width=100)


def _reference(parent: Vehicle, target: Path) -> str:
    """How the new file names its base: shipped ones by name, others by a path from its folder."""
    shipped = parent.path.stem in config_names("vehicles")
    if shipped and load_vehicle(parent.path.stem).path.samefile(parent.path):
        return parent.path.stem
    return os.path.relpath(parent.path.resolve(), target.resolve().parent)


def _one_line(words: str) -> str:
    """Words without line breaks and control characters, which YAML would not give back."""
    return " ".join("".join(c if c.isprintable() else " " for c in words).split())
