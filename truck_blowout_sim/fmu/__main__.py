"""`python -m truck_blowout_sim.fmu [VEHICLE] -o FOLDER`: write Truck.fmu."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.fmu.build import build_fmu


def main(words: list[str] | None = None) -> int:
    """Entry point; 0 done, 2 bad usage or bad input."""
    parser = argparse.ArgumentParser(prog="python -m truck_blowout_sim.fmu", description=__doc__)
    parser.add_argument("vehicle", nargs="?", default="international_9400i_trailmobile",
                        help="vehicle file, by name or path (default: %(default)s)")
    parser.add_argument("-o", "--output", type=Path, default=Path(),
                        help="folder for Truck.fmu (default: here)")
    parser.add_argument("--force", action="store_true", help="replace an existing Truck.fmu")
    given = parser.parse_args(words)
    try:
        print(build_fmu(given.vehicle, given.output, force=given.force))
    except InputError as error:
        print(f"truck_blowout_sim.fmu: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
