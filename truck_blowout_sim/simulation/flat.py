"""Tires that burst before a run begins: the truck starts settled on them.

Known limits: until the start such a tire loses its air at constant volume, and the truck settles on
what is left, as if it had rolled like this for long.
Validated with: test/simulation/test_flat.py.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import TIRE, TIRE_S
from truck_blowout_sim.physics.places import tire_params, tire_state
from truck_blowout_sim.physics.tires.gas import advance_pressure
from truck_blowout_sim.recordings import Blowout
from truck_blowout_sim.vehicle import Packed, Vehicle

Floats = NDArray[np.float64]
Flat = tuple[str, float]
"""A tire, and how long before the start it burst [s]."""
_STEP_S = 0.001
_MOST_STEPS = 100_000  # a slow leak over hours needs no finer ones


def split_at(blowouts: Iterable[Blowout], start_s: float, step_s: float
             ) -> tuple[tuple[Blowout, ...], tuple[Blowout, ...]]:
    """Blowouts before a run begins, and those on its step grid."""
    events = tuple(blowouts)
    before = tuple(b for b in events if b.time_s < start_s - 0.5 * step_s)
    return before, tuple(b for b in events if b not in before)


def flat_at(before: Iterable[Blowout], start_s: float) -> tuple[Flat, ...]:
    """The tires of blowouts before ``start_s``, each once, with the time since they burst."""
    since = {tire: start_s - b.time_s for b in reversed(tuple(before)) for tire in b.tires}
    return tuple(sorted(since.items()))


def flat_notes(flat: Iterable[Flat]) -> tuple[str, ...]:
    """That a run did not begin on whole tires."""
    return tuple(f"{tire} burst {since_s:.2f} s before the first input: the model starts settled on"
                 " it" for tire, since_s in flat)


def check_tires(vehicle: Vehicle, flat: Iterable[Flat]) -> None:
    """Refuse a flat tire that the vehicle does not have.

    Raises:
        InputError: its name.
    """
    for tire, _ in flat:
        if tire not in vehicle.tires:
            raise InputError(f"unknown tire {quoted(tire)}", file=vehicle.name,
                             expected="one of " + ", ".join(vehicle.tires))


def deflate(x: Floats, packed: Packed, flat: Iterable[Flat]) -> None:
    """Give tires the pressure they have left; on a clock that reads 0 at the start."""
    for name, since_s in flat:
        tire = packed.vehicle.tires.index(name)
        s, t = tire_state(packed.topology, tire), tire_params(packed.topology, tire)
        x[s + TIRE_S.blown_time_s] = -since_s
        x[s + TIRE_S.pressure_pa] = packed.params[t + TIRE.pressure_pa]
        x[s + TIRE_S.rim] = 0.0
        step_s = max(_STEP_S, since_s / _MOST_STEPS)
        _let_out(x, s, packed.params, t, step_s, round(since_s / step_s))


def while_settling(packed: Packed, flat: Iterable[Flat]) -> Floats:
    """Parameters under which a truck settles: nothing timed acts, and no air is lost."""
    params = packed.without_events()
    for name, _ in flat:
        t = tire_params(packed.topology, packed.vehicle.tires.index(name))
        params[t + TIRE.hole_scale] = 0.0
    return params


def set_clock(x: Floats, packed: Packed, flat: Iterable[Flat], start_s: float) -> None:
    """Move the instants of the bursts to the clock of the run."""
    for name, since_s in flat:
        tire = packed.vehicle.tires.index(name)
        x[tire_state(packed.topology, tire) + TIRE_S.blown_time_s] = start_s - since_s


@core
def _let_out(x: Floats, s: int, p: Floats, t: int, dt: float, n_steps: int) -> None:
    for _ in range(n_steps):
        advance_pressure(x, s, p, t, 0.0, dt)
        if x[s + TIRE_S.pressure_pa] <= 0.0:
            return
