"""Where the files that ship with the package are: vehicles, tires, scenarios, recordings."""

from __future__ import annotations

import os
from pathlib import Path

from truck_blowout_sim.errors import InputError, closest

PACKAGE = "truck_blowout_sim"
_SETTINGS = {"diagnosis": "settings"}  # a folder whose name is no plural


def config_dir() -> Path:
    """Folder with the shipped YAML and recordings.

    The source tree comes first (a clone, also when installed editable), then the prefix that this
    very file was installed into, by pip, colcon or a distribution's package alike.

    Raises:
        InputError: the package is installed without its data.
    """
    for candidate in _candidates():
        if candidate.is_dir():
            return candidate
    raise InputError(
        "the configuration files of this installation are missing",
        file=Path(__file__).parent,
        expected="an installation by pip or colcon, or a source tree",
    )


def config_file(kind: str, name: str | os.PathLike[str]) -> Path:
    """Find a shipped file by its name, or take a path as it is.

    Args:
        kind: folder below `config_dir()`: "vehicles", "tires", "scenarios", ...
        name: the name of a shipped file, with or without `.yaml`, or a path to any file.

    Raises:
        InputError: neither a shipped name nor an existing file; says which names there are.
    """
    folder = config_dir() / kind
    text = os.fspath(name)
    for candidate in (folder / text, folder / f"{text}.yaml", Path(text)):
        if candidate.is_file():
            return candidate
    if text and Path(text).is_dir():
        raise InputError("is a folder", file=text, expected="a YAML file")
    names = config_names(kind)
    near = "" if _is_path(text) else closest(text, names)
    raise InputError(
        f"no {_SETTINGS.get(kind, kind.removesuffix('s'))} of the name {text!r} and no such file"
        + (f" (did you mean {near!r}?)" if near else ""),
        expected=f"a path or one of: {', '.join(names) or 'none shipped'}",
    )


def _is_path(text: str) -> bool:
    return Path(text).name != text or Path(text).suffix in (".yaml", ".yml", ".csv")


def config_names(kind: str) -> tuple[str, ...]:
    """Names, without suffix, of the files shipped in one folder of `config_dir()`."""
    return tuple(sorted(path.stem for path in (config_dir() / kind).glob("*.yaml")))


def code_hash() -> str:
    """Twelve digits that change with any line of this package or its configuration.

    The proof is left out: it judges answers and makes none.
    """
    import hashlib

    package = Path(__file__).resolve().parent
    total = hashlib.sha256()
    for path in sorted([*package.rglob("*.py"), *config_dir().rglob("*.yaml")]):
        if "proof" not in path.parts:
            total.update(path.read_bytes())
    return total.hexdigest()[:12]


def _candidates() -> list[Path]:
    # Installed as <prefix>/lib/python3.x/site-packages/truck_blowout_sim/resources.py; pip's
    # --target leaves out the middle, so every folder above is asked.
    above = Path(__file__).resolve().parents
    source = [above[1] / "config"] if (above[1] / "package.xml").is_file() else []
    return [*source, *(folder / "share" / PACKAGE / "config" for folder in above[1:])]
