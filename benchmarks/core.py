"""How fast a truck is simulated on one core, beside a well-known vehicle model on the same core.

Processor time of the thread is counted, best of several rounds, so that a busy machine disturbs
little. The peer is the multi-body passenger car of commonroad-vehicle-models (29 states, 4 tires,
plain Python), stepped by explicit Euler at the same step; install it to see its row.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import partial
from importlib.metadata import version
from importlib.util import find_spec
from time import perf_counter, thread_time

import numpy as np
from numpy.typing import NDArray

from benchmarks.first_step import first_step
from benchmarks.page import Page, Place, Table, number
from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import N_INPUTS, N_WORK
from truck_blowout_sim.physics.octet import EIGHT
from truck_blowout_sim.physics.octet_arrays import octets, room_for_eight
from truck_blowout_sim.physics.step import advance
from truck_blowout_sim.simulation import (
    InitialState,
    Inputs,
    Truck,
    load_scenario,
    prepare,
    run_batch,
    run_drive,
)
from truck_blowout_sim.simulation.abreast import execute_abreast, side_by_side
from truck_blowout_sim.simulation.equilibrium import settle_steps
from truck_blowout_sim.vehicle import load_vehicle, pack

Floats, Integers = NDArray[np.float64], NDArray[np.int64]
VEHICLE = "international_9400i_trailmobile"
PEER = "commonroad-vehicle-models"
PAIR = ("trailer_1_left_outer", "trailer_1_left_inner")
STEP_S = 0.001
ROUNDS, STEPS = 40, 2000
SOUGHT = "500, better 650"
# what, vehicle, its blown tires
ROWS: tuple[tuple[str, str, tuple[str, ...]], ...] = (
    ("tires intact", VEHICLE, ()),
    ("both duals of a trailer hub blown", VEHICLE, PAIR),
    ("thesis vehicle (force maps, table of steps), steer tire blown", f"{VEHICLE}_thesis",
     ("steer_left",)),
    ("car of four linear tires", "bmw_320i", ()),
)


def best_seconds(*works: Callable[[], object], clock: Callable[[], float] = thread_time
                 ) -> list[float]:
    """Least time of each work in rounds that do all of them in turns; by default processor time."""
    times = []
    for _ in range(ROUNDS):
        edges = [clock()]
        for work in works:
            work()
            edges.append(clock())
        times.append(np.diff(edges))
    return [float(seconds) for seconds in np.min(times, axis=0)]


def turning(vehicle: str, blown: tuple[str, ...]) -> tuple[Truck, Inputs]:
    """A vehicle in a turn at 50 km/h for a second, then with blown tires."""
    truck = Truck(load_vehicle(vehicle), initial=InitialState(speed_mps=13.9))
    turn = Inputs(1.0, 0.35)
    truck.advance(turn, 1000)
    for tire in blown:
        truck.blow(tire)
    return truck, turn


def speeds() -> Table:
    """Processor time of a step, a row each vehicle, alone and eight abreast."""
    cars = [turning(vehicle, blown) for _, vehicle, blown in ROWS]
    works: list[Callable[[], object]] = [partial(car.advance, turn, STEPS) for car, turn in cars]
    works += [eight(*turning(vehicle, blown)) for _, vehicle, blown in ROWS]
    rows = [(f"{EIGHT} abreast: {what}" if trucks > 1 else what, len(car.vehicle.tires), trucks)
            for trucks in (1, EIGHT) for (what, _, _), (car, _) in zip(ROWS, cars, strict=True)]
    if find_spec("vehiclemodels"):
        works.append(peer())
        rows.append((f"{PEER} {version(PEER)} (plain Python, four tires)", 4, 1))
    table = Table("", "a step", "a tire-step", "times real time")
    for (what, tires, trucks), seconds in zip(rows, best_seconds(*works), strict=True):
        step_s = seconds / STEPS / trucks
        table.row(what, f"{1e6 * step_s:.2f} µs", f"{1e9 * step_s / tires:,.0f} ns",
                  number(STEP_S / step_s))
    table.row("sought for the default truck", "", "", SOUGHT)
    return table


@core
def advance_eight(x: Floats, p: Floats, topo: Integers, inputs: Floats, dt: float, n_steps: int,
                  work: Floats) -> None:
    """`step.advance` of eight trucks; every array but ``topo`` is [..., 8]."""
    advance(octets(x), octets(p), topo, octets(inputs), dt, n_steps, octets(work))


def eight(truck: Truck, turn: Inputs) -> Callable[[], object]:
    """What takes as many steps with eight of a truck, as it now is, side by side."""
    x, p = (side_by_side([one] * EIGHT) for one in (truck.state, truck.packed.params))
    inputs, work = room_for_eight(N_INPUTS), room_for_eight(N_WORK)
    inputs[:] = np.array(turn)[:, None]
    return partial(advance_eight, x, p, truck.packed.topology, inputs, STEP_S, STEPS, work)


def peer() -> Callable[[], None]:
    """What takes as many steps with the peer."""
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

    return step


def batch(table: Table) -> None:
    """Trucks side by side, against one after the other, by the clock on the wall."""
    packed, drive, _ = prepare(pack(load_vehicle(VEHICLE)), load_scenario("fishhook"))
    trucks = [packed.with_values({"steering.ratio": 20.0 + k}) for k in range(16)]
    alone = [run_drive(truck, drive) for truck in trucks]
    same = all(map(np.array_equal, alone, run_batch(trucks, drive)))
    one_by_one, together = best_seconds(lambda: [run_drive(truck, drive) for truck in trucks],
                                        lambda: run_batch(trucks, drive), clock=perf_counter)
    table.row(f"{len(trucks)} trucks in {os.cpu_count()} threads", f"{one_by_one / together:.2f} "
              f"times the throughput of one, {'same' if same else 'OTHER'} bits")


def abreast(table: Table) -> None:
    """Eight trucks abreast, against one after the other, from settling to the last row."""
    packed, drive, _ = prepare(pack(load_vehicle(VEHICLE)), load_scenario("fishhook"))
    trucks = [packed.with_values({"steering.ratio": 20.0 + k}) for k in range(EIGHT)]
    one_by_one, together = best_seconds(lambda: [run_drive(truck, drive) for truck in trucks],
                                        lambda: execute_abreast(trucks, [drive] * EIGHT))
    steps = len(drive.inputs) + settle_steps(drive.step_s, drive.warm)
    table.row(f"{EIGHT} whole runs abreast",
              f"{one_by_one / together:.2f} times the throughput of one,"
              f" {1e6 * together / EIGHT / steps:.2f} µs a truck-step")


def main(page: Page = None) -> None:
    """All figures of the core."""
    place = Place(page, "core")
    table = speeds()
    others = Table("", "measured")
    first_step(others, VEHICLE)
    batch(others)
    abreast(others)
    place.put(table, others)
