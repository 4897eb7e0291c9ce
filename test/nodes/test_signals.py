"""Which signals end a node, by what the process was started with."""

from __future__ import annotations

import signal
from collections.abc import Iterator

import pytest

from truck_blowout_sim.nodes.signals import CAUGHT, StopFlag


@pytest.fixture(autouse=True)
def _handlers_as_before() -> Iterator[None]:
    before = {number: signal.getsignal(number) for number in CAUGHT}
    yield
    for number, handler in before.items():
        signal.signal(number, handler)


def test_under_nohup_the_end_of_the_terminal_ends_nothing() -> None:
    signal.signal(signal.SIGHUP, signal.SIG_IGN)
    with StopFlag() as stop:
        signal.raise_signal(signal.SIGHUP)
        assert not stop
        signal.raise_signal(signal.SIGTERM)
        assert stop
    assert signal.getsignal(signal.SIGHUP) == signal.SIG_IGN


def test_without_nohup_it_ends_the_node() -> None:
    signal.signal(signal.SIGHUP, signal.SIG_DFL)
    with StopFlag() as stop:
        signal.raise_signal(signal.SIGHUP)
        assert stop.reason == "SIGHUP"


def test_a_background_job_of_a_script_still_ends_by_sigint() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with StopFlag() as stop:
        signal.raise_signal(signal.SIGINT)
        assert stop.reason == "SIGINT"
