"""Pictures drawn in two processes are the bytes that one would draw."""

from __future__ import annotations

from concurrent.futures import Executor, Future

import numpy as np

from truck_blowout_sim.report.drawing import draw_all, second_hand
from truck_blowout_sim.report.style import Picture, new_axes, styled


@styled
def picture(k: int) -> Picture:
    figure, axes = new_axes(y="speed (m/s)")
    axes.plot(np.linspace(0.0, 9.0, 50), np.sin(np.arange(50.0) * k), label="model")
    axes.legend()
    return Picture(f"p{k}", f"Picture {k}", "A wave.", figure)


def test_a_second_process_draws_the_same_bytes() -> None:
    alone, shared = ([picture(k) for k in range(1, 7)] for _ in range(2))
    with second_hand(True) as hand:
        draw_all(shared, hand)
    assert [p.svg() for p in shared] == [p.svg() for p in alone]
    assert len({p.svg() for p in alone}) == 6


def test_what_the_other_hand_has_begun_is_left_to_it() -> None:
    """One that never lets go of a job has to draw them all; the caller keeps what it made."""
    class Greedy(Executor):
        def submit(self, _: object, /, one: Picture) -> Future[bytes]:  # type: ignore[override]
            done: Future[bytes] = Future()
            done.set_running_or_notify_cancel()
            done.set_result(b"made by " + one.name.encode())
            return done

    pictures = [picture(k) for k in (1, 2)]
    draw_all(pictures, Greedy())
    assert [p.svg() for p in pictures] == [b"made by p1", b"made by p2"]


def test_without_a_second_hand_pictures_are_drawn_when_asked_for() -> None:
    one = picture(3)
    with second_hand(False) as hand:
        assert hand is None
        draw_all([one], hand)
    assert one.svg().startswith(b"<?xml")
    assert one.svg() is one.svg()
