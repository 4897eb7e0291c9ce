"""How fast a truck is simulated on one core, beside a well-known vehicle model on the same core.

Processor time of the thread is counted, best of several rounds, so that a busy machine disturbs
little. The peer is the multi-body passenger car of commonroad-vehicle-models (29 states, 4 tires,
plain Python), stepped by explicit Euler at the same step; install it to see its lines.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Callable
from importlib.metadata import version
from importlib.util import find_spec
from time import perf_counter, thread_time

import numpy as np

from truck_blowout_sim.simulation import (
    InitialState,
    Inputs,
    Truck,
    load_scenario,
    prepare,
    run_batch,
    run_drive,
)
from truck_blowout_sim.vehicle import load_vehicle, pack

VEHICLE = "international_9400i_trailmobile"
STEP_S = 0.001
ROUNDS, STEPS = 10, 2000
REQUIRED, SOUGHT = 500.0, 650.0
FIRST_CALL = f"""
from time import perf_counter
start = perf_counter()
from truck_blowout_sim import Truck, load_vehicle
vehicle = load_vehicle({VEHICLE!r})
loaded = perf_counter()
truck = Truck(vehicle)
from truck_blowout_sim import Inputs
truck.advance(Inputs(), 1)
from hashlib import sha256
print(loaded - start, perf_counter() - loaded, sha256(truck.state.tobytes()).hexdigest())
"""


def best_seconds(work: Callable[[], object]) -> float:
    """Least processor time of several rounds [s]."""
    times = []
    for _ in range(ROUNDS):
        start = thread_time()
        work()
        times.append(thread_time() - start)
    return min(times)


def line(what: str, value: str) -> None:
    print(f"{what:<52}{value:>24}")


def core_speed() -> float:
    """Simulated seconds a second of one core, in a turn with two blown tires."""
    truck = Truck(load_vehicle(VEHICLE), initial=InitialState(speed_mps=13.9))
    turn = Inputs(1.0, 0.35)
    truck.advance(turn, 1000)
    for tire in ("trailer_1_left_outer", "trailer_1_left_inner"):
        truck.blow(tire)
    seconds = best_seconds(lambda: truck.advance(turn, STEPS)) / STEPS
    tires = len(truck.vehicle.tires)
    line(f"{tires}-tire truck, one step of 1 ms", f"{1e6 * seconds:.2f} us")
    line("  a tire-step", f"{1e6 * seconds / tires:.3f} us")
    speed = STEP_S / seconds
    line("  simulated seconds a second, one core", f"{speed:.0f}")
    line(f"  required {REQUIRED:.0f}, sought {SOUGHT:.0f}",
         "met" if speed >= REQUIRED else "not met")
    return seconds / tires


def peer_speed() -> float | None:
    """Processor time a tire-step of the peer [s]; None where it is not installed."""
    if find_spec("vehiclemodels") is None:
        line("peer: commonroad-vehicle-models", "not installed")
        return None
    from vehiclemodels.init_mb import init_mb
    from vehiclemodels.parameters_vehicle2 import parameters_vehicle2
    from vehiclemodels.vehicle_dynamics_mb import vehicle_dynamics_mb

    parameters = parameters_vehicle2()
    state = np.array(init_mb([0.0, 0.0, 0.0, 15.0, 0.0, 0.0, 0.0], parameters))

    def step() -> None:
        nonlocal state
        for _ in range(STEPS):
            rate = vehicle_dynamics_mb(state, [0.0, 0.0], parameters)
            state = state + STEP_S * np.array(rate)

    seconds = best_seconds(step) / STEPS
    line(f"peer: commonroad-vehicle-models {version('commonroad-vehicle-models')}, one step",
         f"{1e6 * seconds:.2f} us")
    line("  a tire-step", f"{1e6 * seconds / 4.0:.3f} us")
    return seconds / 4.0


def batch_speed() -> None:
    """Trucks side by side, against one after the other."""
    packed, drive, _ = prepare(pack(load_vehicle(VEHICLE)), load_scenario("fishhook"))
    trucks = [packed.with_values({"steering.ratio": 20.0 + k}) for k in range(16)]
    run_drive(trucks[0], drive)  # compiled and loaded
    start = perf_counter()
    alone = [run_drive(truck, drive) for truck in trucks]
    one_by_one = perf_counter() - start
    start = perf_counter()
    batch = run_batch(trucks, drive)
    together = perf_counter() - start
    same = all(np.array_equal(a, b) for a, b in zip(alone, batch, strict=True))
    line(f"batch of {len(trucks)} on {os.cpu_count()} cores, times as fast",
         f"{one_by_one / together:.2f}")
    line("  same bits as single runs", "yes" if same else "NO")


def first_call() -> None:
    """Seconds until the first step, with an empty cache and with a filled one."""
    bits = set()
    with tempfile.TemporaryDirectory() as cache:
        environment = {**os.environ, "NUMBA_CACHE_DIR": cache}
        for words in ("compiling (once)", "from the cache"):
            done = subprocess.run([sys.executable, "-c", FIRST_CALL], env=environment, check=True,
                                  capture_output=True, text=True)
            *seconds, state = done.stdout.split()
            load, first = map(float, seconds)
            bits.add(state)
            line(f"first step, {words}", f"{first:.1f} s")
        line("  same bits after compiling as from the cache", "yes" if len(bits) == 1 else "NO")
        line("import and vehicle file", f"{load:.1f} s")


def main() -> None:
    """All figures of the core."""
    ours = core_speed()
    theirs = peer_speed()
    if theirs is not None:
        line("  our tire-step is cheaper by", f"{theirs / ours:.0f} times")
    batch_speed()
    first_call()


if __name__ == "__main__":
    main()
