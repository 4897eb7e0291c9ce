"""Eight trucks at once, each in a place of its own of the processor's vectors.

What comes out is what each truck gives alone, to rounding: a vector rounds as a number does, but
whether a seldom case is worked out depends on the neighbors.

References: none, this is bookkeeping.
Known limits: trucks that are not `alike` go one after the other.
Validated with: test/simulation/test_abreast.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.layout import N_INPUTS, N_WORK
from truck_blowout_sim.physics.octet import EIGHT
from truck_blowout_sim.physics.octet_arrays import room_for_eight
from truck_blowout_sim.simulation.alike import in_eights, kind_of
from truck_blowout_sim.simulation.drive import Drive, Driven, Ran, execute, names_of
from truck_blowout_sim.simulation.equilibrium import (
    held_motion,
    initial_vector,
    place,
    settle_steps,
    unsettled,
)
from truck_blowout_sim.simulation.flat import while_settling
from truck_blowout_sim.simulation.loop_abreast import run_abreast, settle_abreast
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
Number = TypeVar("Number", np.float64, np.int64)
MANY = 256  # trucks from which on it pays to compile the step once more, for eight


def execute_abreast(trucks: Sequence[Packed], drives: Sequence[Drive],
                    starts: Sequence[Floats | None] | None = None) -> list[Ran]:
    """Run prepared drives, as `drive.execute` does one, eight at once where they are alike.

    Args:
        starts: the settled trucks, where they are known already.
    """
    given: Sequence[Floats | None] = starts or [None] * len(trucks)
    ran: dict[int, Ran] = {}
    eights, alone = parts_of(trucks, drives, given)
    for part in eights:
        found = execute_alike([trucks[k] for k in part], [drives[k] for k in part],
                              [given[k] for k in part])
        ran.update(zip(part, found, strict=True))
    for k in alone:
        ran[k] = execute(trucks[k], drives[k], start=given[k])
    return [ran[k] for k in range(len(trucks))]


def execute_alike(trucks: Sequence[Packed], drives: Sequence[Drive],
                  starts: Sequence[Floats | None]) -> list[Ran]:
    """`execute_abreast` of up to eight that are known to be alike: a part of `parts_of`."""
    begun = _settled(trucks, drives, starts)
    n_outputs = len(names_of(trucks[0].vehicle))
    rows = np.full((len(drives), max(drive.n_rows for drive in drives), n_outputs), np.nan)
    return run_from(trucks, drives, begun, 0, rows)


def settle_all(trucks: Sequence[Packed], drives: Sequence[Drive]) -> list[Floats]:
    """Settled trucks, as `equilibrium.initial_vector` gives one, eight at once."""
    nothing = [None] * len(trucks)
    starts: dict[int, Floats] = {}
    eights, alone = parts_of(trucks, drives, nothing)
    for part in eights:
        found = _settled([trucks[k] for k in part], [drives[k] for k in part], nothing[:len(part)])
        starts.update(zip(part, found, strict=True))
    for k in alone:
        drive = drives[k]
        starts[k] = initial_vector(trucks[k], drive.initial, drive.step_s, drive.warm)
    return [starts[k] for k in range(len(trucks))]


def parts_of(trucks: Sequence[Packed], drives: Sequence[Drive],
             starts: Sequence[Floats | None]) -> tuple[list[list[int]], list[int]]:
    """Numbers of the drives that go abreast, up to eight a part, and of those that go alone."""
    return in_eights([kind_of(*each) for each in zip(trucks, drives, starts, strict=True)])


def side_by_side(arrays: Sequence[Floats]) -> Floats:
    """Up to eight arrays of one shape as one [..., 8]; the last fills the places that are left."""
    room = room_for_eight(*arrays[0].shape)
    for lane in range(EIGHT):
        room[..., lane] = arrays[min(lane, len(arrays) - 1)]
    return room


def _settled(trucks: Sequence[Packed], drives: Sequence[Drive], given: Sequence[Floats | None]
             ) -> list[Floats]:
    """States from which alike trucks start; those not given are settled at once."""
    first = drives[0]
    if given[0] is not None:
        return [start for start in given if start is not None]
    begun = [unsettled(truck, drive.initial, drive.warm)
             for truck, drive in zip(trucks, drives, strict=True)]
    x = side_by_side([state for state, _ in begun])
    held = [held_motion(truck, drive.initial) for truck, drive in zip(trucks, drives, strict=True)]
    params = [while_settling(truck, drive.initial.flat)
              for truck, drive in zip(trucks, drives, strict=True)]
    settle_abreast(x, side_by_side(params), trucks[0].topology,
                   side_by_side([inputs for _, inputs in begun]), first.step_s,
                   settle_steps(first.step_s, first.warm), side_by_side(held),
                   room_for_eight(N_WORK))
    states = [x[:, lane].copy() for lane in range(len(trucks))]
    for state, truck, drive in zip(states, trucks, drives, strict=True):
        place(state, truck, drive.initial)
    return states


def run_from(trucks: Sequence[Packed], drives: Sequence[Drive], starts: Sequence[Floats],
             begun: int, out: Floats) -> list[Ran]:
    """Drive up to eight alike trucks from a step on.

    Args:
        starts: their states at the step ``begun``.
        out: [trucks, rows of the longest, n_outputs]; what was before is theirs already.
    """
    driven = [Driven(truck, drive) for truck, drive in zip(trucks, drives, strict=True)]
    first = driven[0]
    inputs = _stacked([each.inputs for each in driven])
    blow_steps = _stacked([each.blow_steps for each in driven])
    counts = np.zeros((EIGHT, 6), dtype=np.int64)
    for lane, each in enumerate(driven):
        counts[lane] = (len(each.inputs), each.blow_steps.size, len(each.watch),
                        each.drive.speed.size, each.pilot.size, len(each.drive.path))
    x, ends = side_by_side(starts), room_for_eight(len(starts[0]))
    run_abreast(
        x, side_by_side([each.params for each in driven]), first.packed.topology,
        room_for_eight(N_INPUTS), first.drive.step_s, first.drive.every, begun,
        side_by_side([np.array([drive.initial.time_s]) for drive in drives]),
        side_by_side([each.rolls for each in driven]), room_for_eight(N_WORK),
        room_for_eight(out.shape[2]), room_for_eight(1), ends, counts, inputs, blow_steps,
        _stacked([each.blow_slots for each in driven]),
        _stacked([each.blow_watch for each in driven]),
        _stacked([each.blow_delays for each in driven]),
        _stacked([each.watch for each in driven]), _stacked([drive.speed for drive in drives]),
        np.array([each.mass_kg for each in driven]), _stacked([each.pilot for each in driven]),
        _stacked([drive.path for drive in drives]), out)
    for lane, each in enumerate(driven):
        each.inputs = inputs[lane, :len(each.inputs)]
        each.blow_steps = blow_steps[lane, :each.blow_steps.size]
    return [each.ran(ends[:, lane].copy(), out[lane, :each.drive.n_rows])
            for lane, each in enumerate(driven)]


def _stacked(arrays: Sequence[NDArray[Number]]) -> NDArray[Number]:
    """Arrays of several lengths as one, the shorter filled up with what is never read."""
    longest = max(len(array) for array in arrays)
    room = np.zeros((len(arrays), longest, *arrays[0].shape[1:]), dtype=arrays[0].dtype)
    for k, array in enumerate(arrays):
        room[k, :len(array)] = array
    return room
