"""Pacing, apart from any node."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from truck_blowout_sim.nodes.clock import FollowPace, PaceMeter, StepClock, WallPace, jump

MS = 1_000_000


def test_step_clock_does_not_drift() -> None:
    clock = StepClock(step_ns=MS)
    for _ in range(100_000):
        clock.advance(10)
    assert clock.now_ns == 1_000_000 * MS


def test_wall_pace_keeps_its_grid_under_jitter() -> None:
    pace = WallPace(tick_s=0.01, factor=1.0, wall_s=0.0)
    for late_s in (0.0, 0.004, 0.001, 0.009):
        due_s = pace.wait_s(0.0, 0)
        pace.ticked(due_s + late_s)
    assert pace.wait_s(0.0, 0) == pytest.approx(0.04)


def test_wall_pace_moves_its_grid_after_a_stall() -> None:
    pace = WallPace(tick_s=0.01, factor=1.0, wall_s=0.0)
    assert pace.ticked(0.5) == pytest.approx(0.5)
    assert pace.wait_s(0.5, 0) == pytest.approx(0.01)


@given(
    st.floats(0.1, 100.0),
    st.lists(st.floats(0.0, 0.1, allow_nan=False), min_size=2, max_size=50),
)
def test_no_more_ticks_than_the_wall_allows(factor: float, delays_s: list[float]) -> None:
    pace = WallPace(tick_s=0.01, factor=factor, wall_s=0.0)
    wall_s = 0.0
    for delay_s in delays_s:
        wall_s = max(wall_s, wall_s + pace.wait_s(wall_s, 0)) + delay_s
        pace.ticked(wall_s)
    simulated_s = 0.01 * len(delays_s)
    assert simulated_s <= wall_s * factor + 0.01 + 1e-9


def test_factor_zero_never_waits() -> None:
    pace = WallPace(tick_s=0.01, factor=0.0, wall_s=0.0)
    assert pace.wait_s(0.0, 0) == 0.0
    pace.ticked(7.0)
    assert pace.wait_s(7.0, 0) == 0.0


def test_follow_pace_waits_for_a_whole_tick() -> None:
    pace = FollowPace(tick_ns=10 * MS)
    assert pace.wait_s(0.0, 0) == math.inf
    pace.target_ns = 19 * MS
    assert pace.wait_s(0.0, 0) == 0.0
    assert pace.wait_s(0.0, 10 * MS) == math.inf


@pytest.mark.parametrize(
    ("now_ms", "verdict"), [(1010, ""), (990, ""), (900, "backward"), (2500, "forward")]
)
def test_jumps_are_told_from_time_that_goes_on(now_ms: int, verdict: str) -> None:
    assert jump(1000 * MS, now_ms * MS, backward_ns=50 * MS, forward_ns=1000 * MS) == verdict


def test_meter_reports_the_factor_achieved() -> None:
    meter = PaceMeter(wall_s=10.0, now_ns=0)
    meter.tick(0.001)
    meter.tick(0.003)
    report = meter.report(12.0, 1_000_000_000)
    assert (report.factor, report.ticks, report.late_worst_s) == (0.5, 2, 0.003)
    assert report.late_mean_s == pytest.approx(0.002)
    assert report.late_p99_s == 0.003
    assert meter.ticks == 0
