"""Where the program `truck-blowout` begins: a Ctrl-C during the imports ends in one line, too."""

from __future__ import annotations

import sys


def main() -> int:
    """Run the process's own command line and return its exit status; see `cli.main`."""
    try:
        from truck_blowout_sim.cli import main as program

        return program.main()
    except KeyboardInterrupt:
        print("truck-blowout: interrupted", file=sys.stderr)
        return 130
