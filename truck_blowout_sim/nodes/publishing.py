"""Publishers for serialised messages, made from the table of outputs, and who reads them."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from time import monotonic
from typing import Any

from rclpy.node import Node
from rclpy.publisher import Publisher

from truck_blowout_sim.nodes.qos import event, publisher, reliable

_LOOK_EVERY_S = 0.02  # discovery takes longer than this to tell a reader of us


class Readers:
    """Which topics somebody reads; asking at every tick would cost as much as publishing.

    Args:
        publishers: by topic.
    """

    def __init__(self, publishers: Mapping[str, Publisher[Any]]) -> None:
        self._publishers = publishers
        self._topics: frozenset[str] = frozenset()
        self._look_at_s = 0.0

    def topics(self) -> frozenset[str]:
        """Topics that were read at the last look, which is at most 20 ms old."""
        now_s = monotonic()
        if now_s >= self._look_at_s:
            self._look_at_s = now_s + _LOOK_EVERY_S
            self._topics = frozenset(topic for topic, made in self._publishers.items()
                                     if made.get_subscription_count() > 0)  # fmt: skip
        return self._topics


def message_class(ros_type: str) -> type[Any]:
    """The Python class of `package/msg/Name`.

    Raises:
        ModuleNotFoundError: the message package is not installed.
    """
    package, kind, name = ros_type.split("/")
    module = import_module(f"{package}.{kind}")
    if not hasattr(module, name):
        # a folder of definitions that stands in the working folder looks like a package
        raise ModuleNotFoundError(f"{package} holds no {name}", name=package)
    return getattr(module, name)


def make_publishers(
    node: Node, types: Mapping[str, str], *, prefix: str = "", depth: int = 10
) -> dict[str, Publisher[Any]]:
    """One publisher for each relative topic.

    Args:
        node: owner.
        types: message type by relative topic.
        prefix: put before every topic.
        depth: messages kept for a reader that lags behind.
    """
    return {
        topic: publisher(
            node,
            message_class(ros_type),
            prefix + topic,
            event() if topic.rsplit("/", 1)[-1] == "blowout" else reliable(depth),
        )
        for topic, ros_type in types.items()
    }
