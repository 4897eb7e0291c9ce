"""How a run may end before its time: rolled over, out of the model's range, not finite.

References: a body comes to rest on its wheels only while its center of gravity stands inside
them: tan(roll) = half track / height (static stability factor; Gillespie, Fundamentals of Vehicle
Dynamics, ch. 9).
Known limits: a side that touches the ground is out of scope, so a run ends where a unit rolls over.
Validated with: test/simulation/test_ending.py.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.choose import where
from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import GLOBAL_S, STATE_UNIT_AT, UNIT_S
from truck_blowout_sim.physics.places import unit_state
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]

GOING, NOT_FINITE, OUT_OF_RANGE, ROLLED_OVER = 0, 1, 2, 3  # ROLLED_OVER + number of the unit
# Beyond these nothing that the model knows keeps a truck; real ones stay far below.
_FASTEST_MPS = 150.0  # no road vehicle
_FASTEST_TURN_RADPS = 2.0 * math.pi  # one turn a second; a spinning truck makes half a one
_STEEPEST_PITCH_RAD = math.radians(60.0)
# Roll against the road from which no unit comes back, and that no suspension reaches on its wheels.
_LEAST_ROLLED_OVER_RAD = math.radians(45.0)


@dataclass(frozen=True)
class Ending:
    """How a run ended before its time.

    Attributes:
        kind: `NOT_FINITE`, `OUT_OF_RANGE` or `ROLLED_OVER`.
        time_s: instant, on the run's clock.
        unit: the unit that rolled over or left the range; empty where it is not one unit's doing.
        words: what was found, for a person.
    """

    kind: int
    time_s: float
    unit: str
    words: str

    @property
    def rolled_over(self) -> bool:
        """Whether this is a result of physics, not a failure of the model."""
        return self.kind == ROLLED_OVER


def rolled_over_rad(packed: Packed) -> Floats:
    """Per unit: roll [rad] against the road at which it counts as rolled over.

    45 degrees, or, for a unit so wide and low that it still stands there, the angle at which its
    center of gravity stands above its outermost tires.
    """
    angles = []
    for unit in packed.names.units:
        axles = [a for a in packed.names.axles if packed.vehicle.spec.axles[a].unit == unit]
        half_m = max(0.5 * (packed.vehicle.spec.axles[a].track_m
                            + packed.vehicle.spec.axles[a].dual_spacing_m) for a in axles)
        angles.append(math.atan2(half_m, packed[f"unit.{unit}.cg_height_m"]))
    return np.maximum(np.array(angles), _LEAST_ROLLED_OVER_RAD)


@core
def ended(x: Floats, rolls: Floats) -> int:
    """0 while a truck runs, else how it ended (`NOT_FINITE`, `OUT_OF_RANGE`, `ROLLED_OVER` + u).

    ``x``: state; ``rolls``: of `rolled_over_rad`.
    """
    end = GOING
    for k in range(rolls.size):
        u = rolls.size - 1 - k  # what is found on the first unit counts
        s = unit_state(u)
        speed = max(abs(x[s + UNIT_S.u_mps]), abs(x[s + UNIT_S.v_mps]), abs(x[s + UNIT_S.w_mps]))
        turn = max(abs(x[s + UNIT_S.p_radps]), abs(x[s + UNIT_S.q_radps]),
                   abs(x[s + UNIT_S.r_radps]))
        in_range = ((speed <= _FASTEST_MPS) & (turn <= _FASTEST_TURN_RADPS)
                    & (abs(x[s + UNIT_S.pitch_rad]) <= _STEEPEST_PITCH_RAD))
        end = where(in_range, end, OUT_OF_RANGE)
        end = where(abs(x[s + UNIT_S.roll_rad]) > rolls[u], ROLLED_OVER + u, end)
    return where(x[GLOBAL_S.nonfinite] > 0.0, NOT_FINITE, end)


def stands(x: Floats, packed: Packed) -> bool:
    """Whether a truck in state ``x`` can be driven on."""
    return ended(x, rolled_over_rad(packed)) == GOING


def ending_of(x: Floats, packed: Packed, rolls: Floats, time_s: float, start_s: float
              ) -> Ending | None:
    """How the truck in state ``x`` ended; None while it runs.

    A truck that lies on its side at ``start_s`` was never driven: it diverged while it settled.
    """
    code = ended(x, rolls)
    if code == GOING:
        return None
    bodies = x[STATE_UNIT_AT:unit_state(rolls.size)]
    if time_s <= start_s and (code >= ROLLED_OVER or not np.isfinite(bodies).all()):
        return Ending(OUT_OF_RANGE, time_s, "", "the truck found no equilibrium to start from")
    if code == NOT_FINITE:
        return Ending(NOT_FINITE, time_s, "", "the state was no longer finite")
    if code >= ROLLED_OVER:
        unit = packed.names.units[code - ROLLED_OVER]
        roll = math.degrees(x[unit_state(code - ROLLED_OVER) + UNIT_S.roll_rad])
        side = "right" if roll > 0.0 else "left"
        return Ending(ROLLED_OVER, time_s, unit, f"the {unit} rolled over to the {side}")
    return _out_of_range(x, packed, time_s)


def _out_of_range(x: Floats, packed: Packed, time_s: float) -> Ending:
    """Names the quantity that is farthest out."""
    found = []
    for u, unit in enumerate(packed.names.units):
        s = unit_state(u)
        speed = np.abs(x[s + UNIT_S.u_mps:s + UNIT_S.w_mps + 1]).max()
        turn = np.abs(x[s + UNIT_S.p_radps:s + UNIT_S.r_radps + 1]).max()
        pitch = abs(x[s + UNIT_S.pitch_rad])
        found += [
            (speed / _FASTEST_MPS, unit, f"the {unit} moved at {speed:.0f} m/s"),
            (turn / _FASTEST_TURN_RADPS, unit,
             f"the {unit} turned at {math.degrees(turn):.0f} deg/s"),
            (pitch / _STEEPEST_PITCH_RAD, unit,
             f"the {unit} pitched {math.degrees(pitch):.0f} deg"),
        ]
    _, unit, words = max(found)
    return Ending(OUT_OF_RANGE, time_s, unit, words)
