"""Draw the pictures of a page two at a time: drawing is what a page costs.

The second pair of hands is a process of its own; the files are the same bytes either way.

Known limits: a script that asks for it must be importable (``if __name__ == "__main__"``).
Validated with: test/report/test_drawing.py.
"""

from __future__ import annotations

import signal
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_context

from truck_blowout_sim.report.style import Picture


@contextmanager
def second_hand(wanted: bool) -> Iterator[Executor | None]:
    """A process that is ready to draw, where wanted; it starts while the caller goes on."""
    if not wanted:
        yield None
        return
    with ProcessPoolExecutor(1, get_context("spawn"), initializer=_deaf_to_interrupts) as pool:
        pool.submit(_ready)
        yield pool
        pool.shutdown(cancel_futures=True)


def draw_all(pictures: Sequence[Picture], hand: Executor | None) -> None:
    """Draw every picture as SVG, one pair of hands from the front, the other from the back."""
    if hand is None:
        return
    jobs = [hand.submit(_svg, picture) for picture in pictures]
    theirs = []
    for picture, job in zip(reversed(pictures), reversed(jobs), strict=True):
        if job.cancel():
            picture.svg()
        else:
            theirs.append((picture, job))
    for picture, job in theirs:
        picture.keep_svg(job.result())


def _svg(picture: Picture) -> bytes:
    return picture.svg()


def _ready() -> None:
    """Nothing: to be asked makes the process start and import what it needs."""


def _deaf_to_interrupts() -> None:
    """Whoever started it hears the interrupt and ends it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
