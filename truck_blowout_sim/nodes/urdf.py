"""`ros2 run truck_blowout_sim urdf [VEHICLE] [-o FILE] [--force]`: a robot description."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from truck_blowout_sim.display.urdf import urdf_of
from truck_blowout_sim.errors import InputError, StorageError
from truck_blowout_sim.nodes.runtime import OneLineParser
from truck_blowout_sim.nodes.simulator_parameters import DEFAULT_VEHICLE
from truck_blowout_sim.recordings.atomic import replacing
from truck_blowout_sim.recordings.claims import claim
from truck_blowout_sim.vehicle import load_vehicle


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    try:
        given = _parser().parse_args(arguments)
        if given.output is None:
            sys.stdout.write(urdf_of(load_vehicle(given.vehicle)))
        else:
            _write(given.vehicle, given.output, given.force)
    except (InputError, StorageError) as error:
        print(f"urdf: {error}", file=sys.stderr)
        return 2
    return 0


def _write(vehicle: str, output: Path, force: bool) -> None:
    if output.exists() and Path(vehicle).exists() and output.samefile(vehicle):
        raise InputError("would be written onto the vehicle file", file=output,
                         expected="another file")  # fmt: skip
    claim(output, force=force, one_file=True)
    text = urdf_of(load_vehicle(vehicle))
    with replacing(output) as temporary:
        temporary.write_text(text, encoding="utf-8")


def _parser() -> argparse.ArgumentParser:
    parser = OneLineParser(prog="urdf", description="Writes the robot description of a vehicle.")
    parser.add_argument("vehicle", nargs="?", default=DEFAULT_VEHICLE,
                        help="name of a shipped vehicle, or path of a vehicle file")  # fmt: skip
    parser.add_argument("-o", "--output", type=Path, help="file to write (default: print it)")
    parser.add_argument("--force", action="store_true", help="replace what already exists")
    return parser


if __name__ == "__main__":
    raise SystemExit(main())
