"""What the simulator serves: blowouts, pause, resume, step, reset, record."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Protocol

from rclpy.node import Node
from std_srvs.srv import SetBool, Trigger

Reply = tuple[bool, str]


class Served(Protocol):
    """What the services call; every reply is success and one sentence."""

    def blow(self, part: str) -> Reply:
        """Blow a tire, or all tires of a hub."""

    def ready(self) -> Reply:
        """Whether the truck is there, or why not yet."""

    def pause(self) -> Reply:
        """Stop time."""

    def resume(self) -> Reply:
        """Let time run."""

    def step(self) -> Reply:
        """Advance by `step_periods` publishing periods, while paused."""

    def reset(self) -> Reply:
        """Return to the initial state."""

    def record(self, wanted: bool) -> Reply:
        """Start or stop a bag."""

    def is_recording(self) -> Reply:
        """Whether a bag is open, and the path that was asked for it."""


def serve(node: Node, served: Served, parts: Iterable[str]) -> None:
    """Create all services, relative names."""
    for part in parts:
        _trigger(node, f"blowout/{part}", once_ready(served, _blow(served, part)))
    _trigger(node, "ready", served.ready)
    _trigger(node, "pause", once_ready(served, served.pause))
    _trigger(node, "resume", once_ready(served, served.resume))
    _trigger(node, "step", once_ready(served, served.step))
    _trigger(node, "reset", once_ready(served, served.reset))
    _trigger(node, "is_recording", served.is_recording)

    def record(request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        act = once_ready(served, lambda: served.record(request.data))
        response.success, response.message = act()
        return response

    node.create_service(SetBool, "record", record)


class _Startable(Protocol):
    def ready(self) -> Reply:
        """Whether the truck is there, or why not yet."""


def once_ready(served: _Startable, act: Callable[[], Reply]) -> Callable[[], Reply]:
    """What `act` does, but refused as long as the simulator is not ready."""

    def guarded() -> Reply:
        there, words = served.ready()
        return act() if there else (False, words)

    return guarded


def _blow(served: Served, part: str) -> Callable[[], Reply]:
    return lambda: served.blow(part)


def _trigger(node: Node, name: str, act: Callable[[], Reply]) -> None:
    def answer(request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        response.success, response.message = act()
        return response

    node.create_service(Trigger, name, answer)
