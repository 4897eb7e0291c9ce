"""Processor time until the first step of a new process, compiled anew and from the cache."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile

from benchmarks.page import Table

PROGRAM = """
from hashlib import sha256
from time import process_time
from truck_blowout_sim import Inputs, Truck, load_vehicle
vehicle = load_vehicle({vehicle!r})
loaded = process_time()
truck = Truck(vehicle)
truck.advance(Inputs(), 1)
print(loaded, process_time() - loaded, sha256(truck.state.tobytes()).hexdigest())
"""


def first_step(table: Table, vehicle: str) -> None:
    """Rows of a process with an empty cache and of one with a filled one."""
    bits: list[str] = []
    program = PROGRAM.format(vehicle=vehicle)
    with tempfile.TemporaryDirectory() as cache:
        environment = {**os.environ, "NUMBA_CACHE_DIR": cache}
        for words in ("compiling", "from the cache"):
            done = subprocess.run([sys.executable, "-c", program], env=environment, check=True,
                                  capture_output=True, text=True)
            load, first, state = done.stdout.split()
            bits.append(state)
            same = f", {'same' if state == bits[0] else 'OTHER'} bits" if bits[1:] else ""
            table.row(f"first step, {words}", f"{float(first):.1f} s of a core{same}")
    table.row("Python, imports, vehicle file before it", f"{float(load):.1f} s")
