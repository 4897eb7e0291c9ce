"""The player's time: its stamps fit the clock through pauses and jumps."""

# ruff: noqa: ANN401 (a stand-in for a node)
from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from rosgraph_msgs.msg import Clock

from truck_blowout_sim.nodes import playtime
from truck_blowout_sim.nodes.playtime import ClockTime, WallTime

NS = 1_000_000_000
START_S = 5.0


class Wall:
    """A wall clock, and a ROS clock that reads the same, moved on by hand."""

    def __init__(self) -> None:
        self.now_s = 1000.0
        self.heard: list[Any] = []

    def node(self) -> Any:
        clock = SimpleNamespace(now=lambda: SimpleNamespace(nanoseconds=round(self.now_s * NS)))
        return SimpleNamespace(get_clock=lambda: clock)

    def pass_by(self, seconds: float) -> None:
        self.now_s += seconds
        for take in self.heard:
            sec, nanosec = divmod(round(self.now_s * NS), NS)
            message = Clock()
            message.clock.sec, message.clock.nanosec = sec, nanosec
            take(message)


@pytest.fixture(params=[WallTime, ClockTime])
def playing(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Any:
    """A wall, and a playback at twice the speed that began 2 s ago."""
    wall = Wall()
    monkeypatch.setattr(playtime, "monotonic", lambda: wall.now_s)
    monkeypatch.setattr(playtime, "subscription", lambda *given: wall.heard.append(given[3]))
    time = request.param(wall.node(), 2.0)
    time.move_to(START_S)
    spinning = SimpleNamespace(spin_once=lambda timeout_sec: wall.pass_by(timeout_sec))
    time.begin(spinning, None, START_S, print)
    time.start()
    wall.pass_by(2.0)
    return wall, time


def stamp_now_s(time: Any) -> float:
    return float(time.stamp_ns(time.position_s) / NS)


def test_while_it_plays_the_stamps_fit_the_clock(playing: Any) -> None:
    wall, time = playing
    assert time.position_s == pytest.approx(START_S + 4.0)
    assert stamp_now_s(time) == pytest.approx(wall.now_s)


def test_after_a_pause_they_fit_again(playing: Any) -> None:
    wall, time = playing
    time.hold()
    wall.pass_by(60.0)
    time.go()
    wall.pass_by(1.0)
    assert time.position_s == pytest.approx(START_S + 6.0)
    assert stamp_now_s(time) == pytest.approx(wall.now_s)


@pytest.mark.parametrize("target_s", [START_S, START_S + 100.0])
def test_a_jump_moves_the_recording_and_not_the_stamps(playing: Any, target_s: float) -> None:
    wall, time = playing
    before_s = stamp_now_s(time)
    time.move_to(target_s)
    assert stamp_now_s(time) == pytest.approx(before_s)
    wall.pass_by(0.5)
    assert time.position_s == pytest.approx(target_s + 1.0)
    assert stamp_now_s(time) == pytest.approx(wall.now_s)


def test_a_jump_while_paused_is_stamped_when_it_is_played(playing: Any) -> None:
    wall, time = playing
    time.hold()
    wall.pass_by(10.0)
    time.move_to(START_S + 1.0)
    assert time.position_s == START_S + 1.0
    assert stamp_now_s(time) == pytest.approx(wall.now_s)
