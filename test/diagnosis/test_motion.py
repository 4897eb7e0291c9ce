"""The diagnosis is told the motion that is missing."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from benchmarks.motion import column, motion_table, support_of
from truck_blowout_sim.diagnosis.case.study import Study

CHANNEL = "trailer_yaw_rate_radps"


def sway(study: Study, i: int, size: float) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """A swing of one channel in a run, 100 samples a second."""
    edges = study.runs[i].edges_s
    time_s = np.arange(edges[0], edges[-1], 0.01)
    return time_s, {CHANNEL: size * np.sin(2.0 * np.pi * time_s / 1.7)}


def with_sway(study: Study, i: int, size: float) -> Study:
    run = study.runs[i]
    time_s, change = sway(study, i, size)
    middles = 0.5 * (run.edges_s[1:] + run.edges_s[:-1])
    moved = run.measured.copy()
    moved[:, run.channels.index(CHANNEL)] += np.interp(middles, time_s, change[CHANNEL])
    runs = tuple(replace(one, measured=moved) if k == i else one
                 for k, one in enumerate(study.runs))
    return replace(study, runs=runs)


def test_a_column_is_the_change_of_the_bins_in_widths(study_of: Callable[..., Study]) -> None:
    study = study_of(baseline=True)
    run = study.runs[study.train[0]]
    found = column(run, (np.arange(run.edges_s[0], run.edges_s[-1], 0.01), {
        CHANNEL: np.full(round(100 * run.length_s), 0.02)})).reshape(run.measured.shape)
    k = run.channels.index(CHANNEL)
    widths = run.color.whitened(np.full(run.measured.shape, 0.02) / run.sigma)
    assert found[:, k] == pytest.approx(np.nan_to_num(widths[:, k]))
    assert not np.delete(found, k, axis=1).any()


def test_what_is_told_is_supported_where_it_is_there(study_of: Callable[..., Study]) -> None:
    study = study_of(baseline=True)
    told = {run.recording.name: sway(study, i, 0.03) for i, run in enumerate(study.runs)}
    there, asked = support_of(with_sway(study, study.train[0], 0.03), told)
    nowhere, _ = support_of(study, told)
    assert nowhere < 2.0 < there
    assert asked > 3.84


def test_cases_are_counted_as_the_answers_are() -> None:
    def case(name: str, group: str, verdict: str, *aliased: bool) -> dict[str, Any]:
        return {"case": name, "group": group, "verdict": verdict,
                "causes": [{"aliased": one} for one in aliased]}

    each = [case("a", "unknown", "unknown", False), case("b", "unknown", "consistent", False),
            case("c", "unknown", "missing_physics", False), case("d", "single", "unknown", False),
            case("e", "pair", "missing_physics", True, True)]
    told = {name: {"case": name, "group": next(c["group"] for c in each if c["case"] == name),
                   "support": support, "asked": 6.8}
            for name, support in {"a": 1.0, "b": 9.0, "c": 2.0, "d": 7.0}.items()}
    lines = motion_table({"w1": (each, told)}).lines[2:]
    assert lines == ["| W1, of no list | 1 of 3 | 2 of 3 | 2 | 1 |",
                     "| W1, one effect | 0 of 1 | 1 of 1 | 1 | 1 |"]
