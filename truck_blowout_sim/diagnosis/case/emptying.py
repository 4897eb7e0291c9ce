"""When a gauge sees its tire begin to empty.

Known limits: a tire that loses less than three tenths of its pressure counts as one that holds it.
Validated with: test/diagnosis/test_candidates.py, test_restlessness.py.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings import Series

Floats = NDArray[np.float64]
_PRESSURE_SEEN = 0.03  # share that stands out of a gauge's noise
_FULL_S, _FEWEST_FULL = 0.2, 3  # readings that tell the pressure at the start
_FEWEST_LOW = 3  # fewer may be a gauge that slips
_PRESSURE_LOST = 0.3  # share of its pressure that is lost for good


def began_to_empty_s(pressure: Series) -> float | None:
    """The instant; None where the tire holds its air.

    Where the line through two early levels of the pressure leaves the first one.
    """
    full = max(round(_FULL_S / pressure.period_s), _FEWEST_FULL)
    start = float(np.median(pressure.value[:full]))
    low = np.flatnonzero(pressure.value < (1.0 - _PRESSURE_LOST) * start)
    if low.size < _FEWEST_LOW:
        return None
    until = low[0] + 1
    return _began(pressure.time_s[:until], pressure.value[:until] / start)


def _began(time_s: Floats, share: Floats) -> float:
    """When a pressure that ends at ``1 - _PRESSURE_LOST`` of its first level began to fall."""
    last = np.flatnonzero(share > 1.0 - _PRESSURE_SEEN)
    first = float(time_s[last[-1]] if last.size else time_s[0])
    seen, lost = _PRESSURE_SEEN, float(1.0 - share[-1])
    return max(first - (float(time_s[-1]) - first) * seen / max(lost - seen, seen),
               float(time_s[0]))
