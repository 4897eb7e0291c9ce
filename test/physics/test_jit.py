"""The compiled core: plain Python underneath, one object of each entry, a cache of its own."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import llvmlite.binding as llvm
import numba
import numpy as np
import pytest
from numba import float64, int64, types

from truck_blowout_sim.physics import cache, jit
from truck_blowout_sim.physics.step import step
from truck_blowout_sim.physics.tires.tire import tire_pass
from truck_blowout_sim.physics.vectors import prefer_vectors

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


def test_a_compiled_caller_holds_the_symbol_of_the_step_and_no_copy() -> None:
    """So the process that compiles and all later ones run the same machine code."""
    program = """
@core
def caller(x, p, topo, inputs, dt, work):
    step(x, p, topo, inputs, dt, work)
"""
    floats, integers = float64[::1], int64[::1]
    scope: dict[str, Any] = {"step": step, "core": lambda f: jit.njit(f, fastmath=True)}
    exec(program, scope)
    caller = scope["caller"]
    caller.compile((floats, floats, integers, floats, float64, floats))
    [code] = caller.inspect_llvm().values()
    assert f'declare void @{step.symbol}(' in code
    assert "fmul" not in code


def test_compiled_callers_and_python_reach_the_same_step() -> None:
    step.load()
    assert llvm.address_of_symbol(step.symbol) == step._compiled.address


def test_an_entry_refuses_arrays_it_would_misread() -> None:
    wrong = np.zeros(10, dtype=np.float32)
    with pytest.raises(TypeError, match="contiguous array of float64"):
        step(wrong, wrong, wrong, wrong, 0.001, wrong)


def test_the_cache_follows_the_sources() -> None:
    # in a process of its own: numba reads its environment anew where a test has changed it
    asked = "import truck_blowout_sim.physics.jit, numba; print(numba.config.CACHE_DIR)"
    done = subprocess.run([sys.executable, "-c", asked], capture_output=True, text=True, check=True)
    assert cache.digest() in done.stdout


def test_a_shared_folder_is_used_only_if_it_is_this_users_alone(tmp_path: Path) -> None:
    usual = tmp_path / f"truck_blowout_sim-{os.getuid()}"
    assert cache.private_folder(tmp_path) == usual
    assert usual.stat().st_mode & 0o077 == 0
    assert cache.private_folder(tmp_path) == usual
    # others may write there: what they left is not loaded
    usual.chmod(0o777)
    found = cache.private_folder(tmp_path)
    assert found != usual
    assert found.stat().st_mode & 0o077 == 0
    # nor is a link followed
    usual.chmod(0o700)
    usual.rename(tmp_path / "elsewhere")
    usual.symlink_to(tmp_path / "elsewhere")
    assert cache.private_folder(tmp_path) != usual


def test_the_pass_over_all_tires_is_compiled_to_vectors() -> None:
    prefer_vectors()
    floats = types.CPointer(float64)
    alone = numba.njit((floats, int64, int64, floats, int64, float64), fastmath=True,
                       error_model="numpy")(tire_pass.py_func)  # type: ignore[attr-defined]
    [code] = alone.inspect_asm().values()
    vectors = re.findall(r"\bv?divpd\b|\bfdiv\s+v\d+\.2d", code)
    assert len(vectors) > 10, len(vectors)
