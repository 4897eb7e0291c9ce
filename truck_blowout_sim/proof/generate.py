"""Have the independent truth make a set of cases, as a program of its own.

The truth is an extra of this package; it is started, never imported, so that no answer can leak
through a shared module.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from truck_blowout_sim.errors import InputError

SETS = ("dev", "test", "ci")


def generate_set(name: str, out: Path, *, limit: int = 0, workers: int = 1) -> Path:
    """Make (or go on making) a set below ``out``; returns its folder.

    Raises:
        InputError: no such set, or the generator failed; its own words went to stderr.
    """
    if name not in SETS:
        raise InputError(f"--set {name!r}", expected="one of " + ", ".join(SETS))
    folder = out / "cases" / name
    command = [sys.executable, "-m", "proving_ground", "generate", "--set", name, "-o",
               str(folder), "--cores", str(workers), "--limit", str(limit)]
    done = subprocess.run(command, stdout=sys.stderr, check=False)
    if done.returncode:
        raise InputError(f"generating the set ended with status {done.returncode}",
                         expected="the extra `prove` to be installed (pip install '.[prove]')")
    return folder
