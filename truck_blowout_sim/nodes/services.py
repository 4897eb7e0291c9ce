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

    def pause(self) -> Reply:
        """Stop time."""

    def resume(self) -> Reply:
        """Let time run."""

    def step(self) -> Reply:
        """Advance one publishing period, while paused."""

    def reset(self) -> Reply:
        """Return to the initial state."""

    def record(self, wanted: bool) -> Reply:
        """Start or stop a bag."""


def serve(node: Node, served: Served, parts: Iterable[str]) -> None:
    """Create all services, relative names."""
    for part in parts:
        _trigger(node, f"blowout/{part}", _blow(served, part))
    _trigger(node, "pause", served.pause)
    _trigger(node, "resume", served.resume)
    _trigger(node, "step", served.step)
    _trigger(node, "reset", served.reset)

    def record(request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        response.success, response.message = served.record(request.data)
        return response

    node.create_service(SetBool, "record", record)


def _blow(served: Served, part: str) -> Callable[[], Reply]:
    return lambda: served.blow(part)


def _trigger(node: Node, name: str, act: Callable[[], Reply]) -> None:
    def answer(request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        response.success, response.message = act()
        return response

    node.create_service(Trigger, name, answer)
