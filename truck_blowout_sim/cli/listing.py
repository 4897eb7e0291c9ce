"""`--list`: the shipped files that a verb takes by name, and names for shell completion."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import typer
import yaml

from truck_blowout_sim.cli.outputs import say
from truck_blowout_sim.recordings.shipped import shipped_recordings
from truck_blowout_sim.resources import config_dir, config_names

_RECORDINGS = "recordings"
_FOLDERS = {"settings": "diagnosis"}
_TEST = "# test: "  # the line of a recording's head that says what was tested


def list_option(*kinds: str) -> Any:  # noqa: ANN401 (what Typer takes as a default)
    """An option `--list` that prints the shipped files of some kinds and ends the program."""

    def show(context: typer.Context, wanted: bool) -> None:
        if wanted:
            # options that stand behind this one are not parsed yet: look at the words themselves
            as_json = "--json" in (context.obj or ())
            say(as_json, titles(*kinds), listing(*kinds))
            raise typer.Exit

    return typer.Option(False, "--list", callback=show, is_eager=True,
                        help=f"List the shipped {_joined(kinds)}, and exit.")  # fmt: skip


def listing(*kinds: str) -> Iterator[str]:
    """Names with titles, kind by kind."""
    for kind, found in titles(*kinds).items():
        width = max(map(len, found), default=0)
        yield f"{kind}:"
        for name, title in found.items():
            yield f"  {name:{width}}  {title}".rstrip()


def titles(*kinds: str) -> dict[str, dict[str, str]]:
    """Title of each shipped file by kind and name."""
    return {kind: {name: _title(kind, name) for name in _names(kind)} for kind in kinds}


def names_of(kind: str) -> Callable[[str], list[str]]:
    """Shipped names of a kind that begin with what was typed, for shell completion."""

    def complete(incomplete: str) -> list[str]:
        return [name for name in _names(kind) if name.startswith(incomplete)]

    return complete


def _joined(kinds: Sequence[str]) -> str:
    return " and ".join(filter(None, (", ".join(kinds[:-1]), kinds[-1])))


def _names(kind: str) -> tuple[str, ...]:
    return shipped_recordings() if kind == _RECORDINGS else config_names(_FOLDERS.get(kind, kind))


def _title(kind: str, name: str) -> str:
    """The title of a file, without reading what it extends."""
    folder = config_dir() / _FOLDERS.get(kind, kind)
    if kind == _RECORDINGS:
        lines = (folder / f"{name}.csv").read_text(encoding="utf-8").splitlines()
        return next((line.removeprefix(_TEST) for line in lines if line.startswith(_TEST)), "")
    content = yaml.safe_load((folder / f"{name}.yaml").read_text(encoding="utf-8"))
    return str(content.get("title", "")) if isinstance(content, dict) else ""
