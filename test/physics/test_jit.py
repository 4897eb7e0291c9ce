"""The compiled core is plain Python underneath: the same numbers without the compiler."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np

from truck_blowout_sim.physics import jit

PROGRAM = """
import sys
import numpy as np
from truck_blowout_sim.physics.layout import N_WORK, TIRE_S, TOPOLOGY
from truck_blowout_sim.physics.step import advance
from truck_blowout_sim.vehicle import load_vehicle, pack
packed = pack(load_vehicle("international_9400i_trailmobile"))
x = np.load(sys.argv[1])
u = np.array([0.5, 0.3, 0.0, 0.0, 2e5])
advance(x, packed.params, packed.topology, u, 0.001, 30, np.zeros(N_WORK))
np.save(sys.argv[2], x)
"""


def run(start: Path, end: Path, **environment: str) -> np.ndarray:
    subprocess.run([sys.executable, "-c", PROGRAM, start, end], check=True,
                   env={**os.environ, **environment})
    return np.load(end)


def test_the_same_numbers_without_the_compiler(tmp_path: Path) -> None:
    from truck_blowout_sim.physics.layout import TIRE_S, TOPOLOGY
    from truck_blowout_sim.simulation import InitialState, Truck
    from truck_blowout_sim.vehicle import load_vehicle

    truck = Truck(load_vehicle("international_9400i_trailmobile"),
                  initial=InitialState(speed_mps=20.0))
    truck.state[truck.packed.topology[TOPOLOGY.state_tire_at] + TIRE_S.blown_time_s] = 0.0
    np.save(tmp_path / "start.npy", truck.state)
    compiled = run(tmp_path / "start.npy", tmp_path / "a.npy")
    plain = run(tmp_path / "start.npy", tmp_path / "b.npy", NUMBA_DISABLE_JIT="1")
    finite = np.isfinite(plain)
    assert np.array_equal(np.isfinite(compiled), finite)
    scale = np.maximum(np.abs(plain[finite]), 1.0)
    assert (np.abs(compiled[finite] - plain[finite]) / scale).max() < 1e-9


def test_the_cache_follows_the_sources() -> None:
    import numba

    if not os.environ.get("NUMBA_CACHE_DIR"):
        assert jit._digest() in str(numba.config.CACHE_DIR)
