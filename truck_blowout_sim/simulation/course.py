"""A drive that is left at an instant: what begins late need not be driven from the start again.

The truck of a course is driven once and its state kept every so often. A truck that differs from it
only after some instant branches off there, with the same bits as if it had been driven whole.

Eight that are alike go abreast, to rounding.

Known limits: no drive with a driver or with conditions, whose memory is not kept.
Validated with: test/simulation/test_course.py (every timed effect of the diagnosis, bit for bit).
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.simulation.abreast import run_from
from truck_blowout_sim.simulation.alike import kind_of
from truck_blowout_sim.simulation.drive import Drive, Driven, names_of
from truck_blowout_sim.simulation.equilibrium import initial_vector
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
KEPT_EVERY_S = 0.5


@dataclass(frozen=True, eq=False)
class Course:
    """A driven truck.

    Attributes:
        drive: what drove it; ``out`` [n_rows, n_outputs] what came out.
        steps: of the kept states, ascending from 0; ``states`` [k, n_state].
    """

    drive: Drive
    out: Floats
    steps: tuple[int, ...]
    states: Floats

    def left_at(self, packed: Packed, since_s: float) -> Floats:
        """Outputs [n_rows, n_outputs] of a truck that is another only from ``since_s`` on."""
        k = self.kept_before(since_s)
        out = np.empty_like(self.out)
        self.note_before(self.steps[k], out)
        Driven(packed, self.drive).steps(self.states[k].copy(), self.steps[k],
                                         self.drive.inputs.shape[0], out)
        return out

    def kept_before(self, since_s: float) -> int:
        """Number of the last kept state before an instant."""
        last = (since_s - self.drive.initial.time_s) / self.drive.step_s
        return max(int(np.searchsorted(self.steps, last, side="left")) - 1, 0)

    def note_before(self, step: int, out: Floats) -> None:
        """Set ``out`` to the rows before a step; what follows may be a failure, and is NaN."""
        n = -(-step // self.drive.every)
        out[:n] = self.out[:n]
        out[n:] = np.nan

    def kind_of(self, packed: Packed) -> Hashable:
        """What must be the same for trucks to leave their courses abreast."""
        if np.isnan(self.out[-1]).all():  # it failed before its end: its clocks stand still
            return object()
        return self.drive.initial.time_s, kind_of(packed, self.drive, self.states[0])


def drive_course(packed: Packed, drive: Drive) -> Course:
    """Drive a truck and keep its state on the way.

    Raises:
        ValueError: the drive has a driver, or events that wait for a condition.
    """
    if drive.pilot.size or drive.watch.size:
        raise ValueError("the memory of a driver or a condition is not kept")
    n, part = drive.inputs.shape[0], max(round(KEPT_EVERY_S / drive.step_s), 1)
    steps = tuple(range(0, max(n, 1), part))
    x = initial_vector(packed, drive.initial, drive.step_s, drive.warm)
    out = np.full((drive.n_rows, len(names_of(packed.vehicle))), np.nan)
    states = np.empty((len(steps), x.size))
    driven, going = Driven(packed, drive), True
    for k, first in enumerate(steps):
        states[k] = x
        going = going and driven.steps(x, first, min(first + part, n), out)
    return Course(drive, out, steps, states)


def left_abreast(courses: Sequence[Course], trucks: Sequence[Packed], since_s: float
                 ) -> list[Floats]:
    """`Course.left_at` of up to eight trucks of one `Course.kind_of`, all left at one instant."""
    k = min(course.kept_before(since_s) for course in courses)
    step = courses[0].steps[k]
    longest = max(courses, key=lambda course: len(course.out))
    out = np.empty((len(courses), *longest.out.shape))
    for course, rows in zip(courses, out, strict=True):
        course.note_before(step, rows)
    ran = run_from(trucks, [course.drive for course in courses],
                   [course.states[k] for course in courses], step, out)
    return [each.out for each in ran]
