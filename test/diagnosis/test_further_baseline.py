"""Which further baseline run would show more."""

from __future__ import annotations

from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.answer import further_baseline as room
from truck_blowout_sim.diagnosis.answer.further_baseline import further_baseline
from truck_blowout_sim.diagnosis.case.study import Study


def case(names: str, baseline: tuple[int, ...]) -> Study:
    runs = [SimpleNamespace(recording=SimpleNamespace(name=name)) for name in names.split()]
    train = tuple(k for k in range(len(runs)) if k not in baseline)
    return cast(Study, SimpleNamespace(runs=runs, baseline=baseline, train=train))


def test_the_run_is_named_that_no_baseline_run_is_like(monkeypatch: pytest.MonkeyPatch) -> None:
    def manners(study: Study) -> list[np.ndarray[tuple[int], np.dtype[np.float64]]]:
        """The last one is of the holdout."""
        return [np.array(v) for v in ((1.0, 0.0), (0.95, 0.312), (0.6, 0.8), (0.0, 1.0))]

    monkeypatch.setattr(room, "driven", manners)
    said = further_baseline(case("straight turn limit", (0,)))
    assert "driven as limit was" in said
    assert "0.60 of 1" in said
    monkeypatch.setattr(room, "driven", lambda study: manners(study)[:2])
    assert further_baseline(case("straight turn", (0,))) == ""


def test_without_baseline_runs_some_are_asked_for() -> None:
    assert "without such baseline runs" in further_baseline(case("turn limit", ()))
