"""Ticks at round numbers of a unit, on axes that are drawn in meters.

Validated with: test/report/test_run_page.py.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axis import Axis
from matplotlib.ticker import Formatter, FuncFormatter, MaxNLocator

_STEPS = (1, 2, 2.5, 5, 10)


class _RoundIn(MaxNLocator):
    """Places of the ticks in meters, round in a unit of which so many are a meter."""

    def __init__(self, per_m: float) -> None:
        super().__init__(nbins="auto", steps=_STEPS)
        self._per_m = per_m

    def tick_values(self, vmin: float, vmax: float) -> Sequence[float]:
        values = super().tick_values(vmin * self._per_m, vmax * self._per_m)
        return list(np.asarray(values) / self._per_m)


def tick_in(axis: Axis, per_m: float) -> None:
    """Let an axis in meters show another unit.

    Args:
        axis: whose ticks are set.
        per_m: number of the unit in one meter.
    """
    axis.set_major_locator(_RoundIn(per_m))
    axis.set_major_formatter(FuncFormatter(
        lambda value, _: Formatter.fix_minus(f"{value * per_m:.6g}")))
