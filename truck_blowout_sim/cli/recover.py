"""`truck-blowout recover`: a bag whose writer was killed gets its index back."""

from __future__ import annotations

from pathlib import Path

import typer

from truck_blowout_sim.cli.outputs import FORCE, JSON, say
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings.claims import claim
from truck_blowout_sim.recordings.recover import Recovered, recover


def command(
    bag: Path = typer.Argument(help=".mcap file or rosbag2 folder."),
    output: Path | None = typer.Option(
        None, "-o", "--output", help="Write there; by default the bag is replaced."
    ),
    force: bool = FORCE,
    as_json: bool = JSON,
) -> None:
    """Repair a damaged bag, or one whose writer was killed; every whole chunk is kept.

    Example: truck-blowout recover killed_bag
    """
    if not bag.exists():
        raise InputError(
            "no such file or directory", file=bag, expected="an .mcap file or a rosbag2 folder"
        )
    if output is not None:
        claim(output, inputs=[bag], force=force, one_file=not bag.is_dir())
    saved = recover(bag, output)
    result = {"output": str(saved.path), "messages": saved.messages,
              "lost_bytes": saved.lost_bytes, "lost": dict(saved.lost)}  # fmt: skip
    say(as_json, result, [f"{saved.path}: {saved.messages} messages{_loss(saved)}"])


def _loss(saved: Recovered) -> str:
    if not saved.lost_bytes:
        return ""
    kinds = [f"{count} {kind}{'s' * (count > 1)}" for kind, count in saved.lost.items()]
    return f"; lost: {', '.join([*kinds, f'{saved.lost_bytes} bytes in all'])}"
