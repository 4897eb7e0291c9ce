"""Publishers for serialised messages, made from the table of outputs."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from typing import Any

from rclpy.node import Node
from rclpy.publisher import Publisher

from truck_blowout_sim.nodes.qos import event, publisher, reliable


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
