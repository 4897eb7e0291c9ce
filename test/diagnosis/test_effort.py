"""Three levels of effort, and one's own."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest

from truck_blowout_sim.diagnosis import QUICK, THOROUGH, USUAL, Effort, diagnose
from truck_blowout_sim.diagnosis.prove import next_test
from truck_blowout_sim.recordings import Recording


def test_more_effort_looks_at_more_and_closer() -> None:
    levels = (QUICK, USUAL, THOROUGH)
    assert [e.most_effects for e in levels] == [1, 3, 4]
    assert QUICK.step_s == USUAL.step_s > THOROUGH.step_s
    assert QUICK.refits < USUAL.refits
    assert QUICK.coarse
    assert THOROUGH.profile


@pytest.mark.parametrize("effort", [QUICK, replace(QUICK, most_effects=0)])
def test_no_more_is_named_than_asked_for(
    effort: Effort, drive_it: Callable[..., Recording], monkeypatch: pytest.MonkeyPatch
) -> None:
    """And what is left out is not simulated."""
    def refuse(*_: object) -> None:
        raise AssertionError("no next run was asked for")
    monkeypatch.setattr(next_test, "best_test", refuse)
    answer, _ = diagnose([drive_it()], effort=effort)
    assert len(answer.effects) <= effort.most_effects
