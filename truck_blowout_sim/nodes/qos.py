"""Publishers and subscriptions whose quality of service can be overridden by parameters.

`qos_overrides.<absolute topic>.publisher.reliability`, `.depth`, `.history`, and the same with
`.subscription`, as every rclcpp node takes them.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rcl_interfaces.msg import SetParametersResult
from rclpy.exceptions import ParameterException
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from rclpy.qos_overriding_options import InvalidQosOverridesError, QoSOverridingOptions
from rclpy.subscription import Subscription

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings.message_types import qos_profile

EXPECTED = "reliability reliable or best_effort, history keep_last or keep_all, depth 1 or more"


def reliable(depth: int = 10) -> QoSProfile:
    """Every reader matches it, a best-effort one too."""
    return QoSProfile(depth=depth, reliability=ReliabilityPolicy.RELIABLE)


def state() -> QoSProfile:
    """For what a late joiner must know the present value of."""
    return QoSProfile(
        depth=1,
        reliability=ReliabilityPolicy.RELIABLE,
        durability=DurabilityPolicy.TRANSIENT_LOCAL,
    )


def event() -> QoSProfile:
    """For what late joiners must still hear of."""
    return QoSProfile(
        depth=100,
        reliability=ReliabilityPolicy.RELIABLE,
        durability=DurabilityPolicy.TRANSIENT_LOCAL,
    )


def latest() -> QoSProfile:
    """For what only the last reading of counts; a best-effort reader matches every writer."""
    return QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)


def publisher(node: Node, kind: type[Any], topic: str, qos: QoSProfile) -> Publisher[Any]:
    """A publisher. `qos` is not to be shared: rclpy writes the overrides into it.

    Raises:
        InputError: an override makes no sense.
    """
    prefix = f"qos_overrides.{node.resolve_topic_name(topic)}.publisher"
    options = _options(node, prefix)
    return _checked(
        lambda: node.create_publisher(kind, topic, qos, qos_overriding_options=options), prefix
    )


def subscription(
    node: Node,
    kind: type[Any],
    topic: str,
    take: Callable[[Any], None],
    qos: QoSProfile,
    *,
    raw: bool = False,
) -> Subscription[Any]:
    """A subscription, as `publisher`; `raw` gives serialised messages.

    Raises:
        InputError: an override makes no sense.
    """
    prefix = f"qos_overrides.{node.resolve_topic_name(topic)}.subscription"
    options = _options(node, prefix)
    return _checked(
        lambda: node.create_subscription(
            kind, topic, take, qos, raw=raw, qos_overriding_options=options
        ),
        prefix,
    )


def in_force(end: Publisher[Any] | Subscription[Any]) -> dict[str, Any]:
    """The profile of a publisher or subscription, overrides included, as rosbag2 writes it."""
    qos = end.qos_profile
    return qos_profile(
        history=qos.history.name.lower(),
        depth=qos.depth,
        reliability=qos.reliability.name.lower(),
        durability=qos.durability.name.lower(),
    )


def _options(node: Node, prefix: str) -> QoSOverridingOptions | None:
    # Declared only where somebody overrides something: `ros2 param list` would otherwise show
    # three parameters a topic.
    given = getattr(node, "_parameter_overrides", {})  # rclpy has no public name for them
    asked = any(name.startswith(f"{prefix}.") for name in given)
    if not asked:
        return None
    return QoSOverridingOptions.with_default_policies(callback=_judge)


def _judge(qos: QoSProfile) -> SetParametersResult:
    # Keep-last with no place to keep anything, or a history that no middleware knows.
    fits = qos.history is HistoryPolicy.KEEP_ALL or qos.depth >= 1
    return SetParametersResult(successful=fits, reason="" if fits else f"depth {qos.depth}")


def _checked(create: Callable[[], Any], where: str) -> Any:  # noqa: ANN401  # publisher or subscription
    try:
        return create()
    except (InvalidQosOverridesError, ParameterException) as error:
        raise _refusal(error, where) from error
    except RuntimeError as error:
        # rclpy has no class of its own for a policy it does not know
        if "QoS override" not in str(error):
            raise
        raise _refusal(error, where) from error


def _refusal(error: Exception, where: str) -> InputError:
    return InputError(str(error), file="parameter", where=where, expected=EXPECTED)
