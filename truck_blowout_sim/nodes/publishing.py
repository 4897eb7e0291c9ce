"""Publishers for serialised messages, made from the table of outputs."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from typing import Any

from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.qos_overriding_options import QoSOverridingOptions

EVENT_QOS = QoSProfile(
    depth=100,
    reliability=ReliabilityPolicy.RELIABLE,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
)
"""For what late joiners must still hear of."""


def message_class(ros_type: str) -> type[Any]:
    """The Python class of `package/msg/Name`.

    Raises:
        ModuleNotFoundError: the message package is not installed.
    """
    package, kind, name = ros_type.split("/")
    return getattr(import_module(f"{package}.{kind}"), name)


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
    # Reliable, so that every reader matches; `qos_overrides` makes it what a network needs.
    state = QoSProfile(depth=depth, reliability=ReliabilityPolicy.RELIABLE)
    return {
        topic: node.create_publisher(
            message_class(ros_type),
            prefix + topic,
            EVENT_QOS if topic.rsplit("/", 1)[-1] == "blowout" else state,
            qos_overriding_options=QoSOverridingOptions.with_default_policies(),
        )
        for topic, ros_type in types.items()
    }
