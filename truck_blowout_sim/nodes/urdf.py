"""`ros2 run truck_blowout_sim urdf [VEHICLE] [-o FILE]`: a vehicle's robot description."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from truck_blowout_sim.display.urdf import urdf_of
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.nodes.simulator_parameters import DEFAULT_VEHICLE
from truck_blowout_sim.vehicle import load_vehicle


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    words = list(sys.argv[1:] if arguments is None else arguments)
    target = None
    if "-o" in words[:-1]:
        at = words.index("-o")
        target = Path(words[at + 1])
        del words[at : at + 2]
    try:
        text = urdf_of(load_vehicle(words[0] if words else DEFAULT_VEHICLE))
    except InputError as error:
        print(f"urdf: {error}", file=sys.stderr)
        return 2
    if target is None:
        sys.stdout.write(text)
    else:
        target.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
