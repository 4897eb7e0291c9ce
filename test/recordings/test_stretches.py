"""Unbroken stretches of samples."""

from __future__ import annotations

import numpy as np
import pytest

from truck_blowout_sim.recordings.stretches import unbroken


@pytest.mark.parametrize(("chosen", "found"), [
    ("", []), ("000", []), ("111", [(0, 3)]), ("0110", [(1, 3)]), ("10011", [(0, 1), (3, 5)]),
])
def test_stretches_are_told_by_their_ends(chosen: str, found: list[tuple[int, int]]) -> None:
    assert unbroken(np.array([one == "1" for one in chosen], dtype=np.bool_)) == found
