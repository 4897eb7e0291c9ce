"""A file of ``config/diagnosis`` as keys and values, with what it takes over from another file."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any

import yaml

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.resources import config_file
from truck_blowout_sim.yaml_numbers import load_yaml


def settings_tree(path: Path) -> dict[str, Any]:
    """The keys of a file; what it does not say is as in the file that it extends.

    Numbers of the sheet and of the method are taken over one by one, channels and forms as a
    whole.

    Raises:
        InputError: not YAML, or something said of what the other file does not have.
    """
    try:
        tree: Any = load_yaml(path.read_text(encoding="utf-8"))
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise InputError(f"not YAML: {error}", file=path) from None
    check_keys(path, "", tree)
    if "extends" not in tree:
        return dict(tree)
    base = settings_tree(config_file("diagnosis", str(tree["extends"])))
    for part in ("sheet", "method"):
        said = tree.get(part) or {}
        check_keys(path, part, said, set(base[part]))
        base[part] = {key: {**entry, **(said.get(key) or {})} for key, entry in base[part].items()}
    left_out = tree.get("without") or []
    check_keys(path, "without", dict.fromkeys(left_out), set(base["sheet"]))
    base["sheet"] = {key: entry for key, entry in base["sheet"].items() if key not in left_out}
    return {**base, **{key: tree[key] for key in tree if key not in ("sheet", "method")}}


def number_at(path: Path, where: str, entry: Mapping[str, Any], key: str) -> float:
    """A finite number under ``key``.

    Raises:
        InputError: none; says file and key.
    """
    check_keys(path, where, entry, needed={key})
    value = entry[key]
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
        raise InputError(f"{key} is {value!r}", file=path, where=where, expected="a number")
    return float(value)


def check_keys(path: Path, where: str, entry: object, known: set[str] | None = None,
               needed: Collection[str] = ()) -> None:
    """A mapping with all needed keys and none but the known ones; None: any are known.

    Raises:
        InputError: something else; says file, key and what was expected.
    """
    if not isinstance(entry, Mapping):
        raise InputError(f"{entry!r}", file=path, where=where, expected="keys with values")
    if known is not None and (unknown := set(entry) - known):
        raise InputError(f"unknown key {min(map(str, unknown))!r}", file=path, where=where,
                         expected="one of " + ", ".join(sorted(known)))
    if missing := set(needed) - set(entry):
        raise InputError(f"key {min(missing)!r} is missing", file=path, where=where,
                         expected="each of " + ", ".join(sorted(needed)))
