"""Instants at which an event is tried, and the delays between two of them."""

from __future__ import annotations

from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.effects import LIBRARY
from truck_blowout_sim.diagnosis.fit.instants import PARTS, bins_between, grid_of, spacing_s

RAMPS = [effect for effect in LIBRARY if effect.timing == "ramp"]
OTHERS = [effect for effect in LIBRARY if effect.timing in ("step", "pulse")]


def lasting(seconds: float, bin_s: float) -> Run:
    edges = 1.0 + np.arange(0.0, seconds + 0.5 * bin_s, bin_s)
    return cast(Run, SimpleNamespace(edges_s=edges, length_s=float(edges[-1] - edges[0])))


@pytest.mark.parametrize(("seconds", "bin_s"), [(7.0, 0.1), (20.0, 0.1), (31.0, 0.1), (7.0, 0.5),
                                                (600.0, 0.1), (7.0, 1.0)])
def test_delays_of_a_ramp_fill_the_time_to_the_next_instant(seconds: float, bin_s: float) -> None:
    """From none on, evenly, as near to each other as the parts of a second or of a long run."""
    run = lasting(seconds, bin_s)
    assert RAMPS
    for effect in RAMPS:
        delays, apart_s = bins_between(effect, run, bin_s), float(np.diff(grid_of(run, effect))[0])
        assert delays[0] == 0
        assert delays[-1] * bin_s < apart_s
        assert (delays[-1] + delays.step) * bin_s >= apart_s - 0.5 * bin_s
        nearest_s = max(spacing_s(run) / PARTS, bin_s)
        assert delays.step * bin_s == pytest.approx(nearest_s, abs=0.5 * bin_s)


def test_other_events_are_tried_at_their_instants_alone() -> None:
    assert {effect.timing for effect in OTHERS} == {"step", "pulse"}
    for effect in OTHERS:
        assert list(bins_between(effect, lasting(7.0, 0.1), 0.1)) == [0]
