"""Options of every verb that reads a recording: ``--map``, ``--blow``, ``--also``."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import typer

from truck_blowout_sim.cli.settings import parse_blowouts
from truck_blowout_sim.recordings import Blowout, Recording, read_recording

MAP: Any = typer.Option(
    None, "--map", "-m", metavar="FILE", help="Mapping file: which column or topic becomes "
    "which channel (`inspect LOG --write-map FILE` writes a first one)."
)  # fmt: skip
BLOW: Any = typer.Option(
    [], "--blow", metavar="TIRE@SECONDS", help="A blowout that the log does not mark, on the "
    "recording's clock, e.g. steer_left@4.92; repeat for more."
)  # fmt: skip
ALSO: Any = typer.Option(
    [], "--also", metavar="FILE", help="A further file of the same test; repeat for more."
)


def read(
    path: str | Path,
    *,
    mapping: Path | None,
    blow: Sequence[str],
    also: Iterable[Path] = (),
    hubs: Iterable[str] = (),
    tires: Iterable[str] = (),
    **how: Any,  # noqa: ANN401 -- handed on as it is
) -> Recording:
    """Read a recording as the options say; arguments beyond them as in `read_recording`.

    Raises:
        InputError: one line: file, place, value, expectation.
    """
    events: list[Blowout] = parse_blowouts(blow)
    return read_recording(path, mapping=mapping, blow=events, also=also, hubs=hubs, tires=tires,
                          **how)  # fmt: skip
