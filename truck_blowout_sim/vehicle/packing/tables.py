"""Tables behind the parameters: force maps and steps of blown tires, shared by equal tires.

A map is `[n_slip, n_load, slip_step_rad, load_step_n]`, then lateral force, then aligning moment,
both row by row over slip angle. A table of steps is its row count, then rows of
`layout.STEP_COLUMNS`; row 0 is the inflated tire.

References: thesis tables 9 and 10 (L687, L727); form of the maps thesis L691-L711.
Known limits: the thesis prints its maps as pictures only, so a map that a file does not give is
made from the Magic Formula at the tire's set pressure.
Validated with: test/vehicle/test_tables.py.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import radians

from truck_blowout_sim.physics.layout import STEP_COLUMNS
from truck_blowout_sim.vehicle.packing.formula import aligning_nm, lateral_n, loaded_radius_m
from truck_blowout_sim.vehicle.schema.tire import (
    BlowoutSpec,
    StepTableSpec,
    TireMapSpec,
    TireSpec,
)

MAP_SLIPS, MAP_SLIP_STEP_RAD = 41, radians(0.5)
MAP_LOADS, MAP_LOAD_STEP_N = 13, 5000.0
ROW_8 = 8
RADIUS_DIGIT_M = 5e-5  # table 9 prints tenths of a millimeter


class Tables:
    """The tail of the parameter vector while it grows."""

    def __init__(self, law: BlowoutSpec) -> None:
        self.values: list[float] = []
        self._law = law
        self._steps = published_steps(law)
        self._at: dict[tuple[str, int], int] = {}

    def steps(self, tire: TireSpec) -> int:
        """Position of a tire's step table; 0 where its law has none."""
        steps = self._steps
        if self._law.law != "steps" or steps is None:
            return 0
        return self._place("steps", tire, lambda: step_table(steps, tire))

    def map(self, tire: TireSpec) -> int:
        """Position of a tire's map; 0 where its model has none."""
        if tire.model != "map":
            return 0
        return self._place("map", tire, lambda: force_map(tire))

    def _place(self, kind: str, tire: TireSpec, make: Callable[[], list[float]]) -> int:
        key = (kind, id(tire))
        if key not in self._at:
            self._at[key] = len(self.values)
            self.values += make()
        return self._at[key]


def step_table(steps: StepTableSpec, tire: TireSpec) -> list[float]:
    """The published steps for a tire.

    The first entry is the sound tire. Another size runs from its own radius to the same rim, as the
    published radii do: linearly.
    """
    columns: list[tuple[float, ...]] = [getattr(steps, name) for name in STEP_COLUMNS]
    rows = [list(row) for row in zip(*columns, strict=True)]
    radius = STEP_COLUMNS.index("radius_m")
    own = loaded_radius_m(tire, tire.reference_load_n)
    first, last = rows[0][radius], rows[-1][radius]
    if abs(own - first) > RADIUS_DIGIT_M:
        for row in rows:
            row[radius] = last + (row[radius] - last) * (own - last) / (first - last)
    return [float(len(rows)), *(value for row in rows for value in row)]


def published_steps(law: BlowoutSpec) -> StepTableSpec | None:
    """The table of steps of a law, row 8 of table 10 read as the law says.

    Nine of its ten rows are 1 + 1.5 n times the first; the eighth is printed 3 % lower.
    """
    steps = law.steps
    if steps is None or law.table_10_row_8 == "as_printed" or len(steps.rolling_spm) <= ROW_8:
        return steps
    speed = list(steps.rolling_spm)
    speed[ROW_8] = speed[0] * (1.0 + 1.5 * ROW_8)
    return replace(steps, rolling_spm=tuple(speed))


def force_map(tire: TireSpec) -> list[float]:
    """The map a file gives, or one made from the formula."""
    given = tire.map
    if given is not None:
        return _given_map(given)
    slips = [i * MAP_SLIP_STEP_RAD for i in range(MAP_SLIPS)]
    loads = [i * MAP_LOAD_STEP_N for i in range(MAP_LOADS)]
    return [
        float(MAP_SLIPS),
        float(MAP_LOADS),
        MAP_SLIP_STEP_RAD,
        MAP_LOAD_STEP_N,
        *(lateral_n(tire, slip, load) for slip in slips for load in loads),
        *(aligning_nm(tire, slip, load) for slip in slips for load in loads),
    ]


def _given_map(given: TireMapSpec) -> list[float]:
    loads = int(given.loads)
    slips = len(given.lateral_n) // loads
    head = [float(slips), float(loads), given.slip_step_rad, given.load_step_n]
    return [*head, *given.lateral_n, *given.aligning_nm]
