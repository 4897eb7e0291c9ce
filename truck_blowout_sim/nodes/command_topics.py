"""Subscriptions to the commands: bytes in, a guarded value out."""

from __future__ import annotations

import struct
from collections.abc import Callable
from time import monotonic
from typing import Any, cast

from rclpy.node import Node
from rclpy.subscription import Subscription
from std_msgs.msg import Float64

from truck_blowout_sim.nodes.inputs import Input
from truck_blowout_sim.nodes.qos import in_force, reliable, subscription
from truck_blowout_sim.nodes.recorder import Recorder
from truck_blowout_sim.recordings.channels import FLOAT64

_WARN_EVERY_S = 5.0
_LITTLE_ENDIAN = b"\x00\x01\x00\x00"


def float64_bytes(value: float) -> bytes:
    """A serialised std_msgs/Float64."""
    return _LITTLE_ENDIAN + struct.pack("<d", value)


class CommandTopic:
    """One subscription.

    Args:
        node: owner.
        guarded: the input it feeds.
        now_ns: tells the simulated time.
        recorder: gets every value that applies.
    """

    def __init__(
        self, node: Node, guarded: Input, now_ns: Callable[[], int], recorder: Recorder
    ) -> None:
        self.guarded = guarded
        self._log = node.get_logger()
        self._now_ns = now_ns
        self._write = recorder.write
        self._next_warning_s = 0.0
        self._shared: list[tuple[Subscription[Any], Callable[[Any], None]]] = []
        self._subscription = subscription(
            node, Float64, guarded.topic, self._take, reliable(), raw=True
        )
        self.topic = self._subscription.topic_name
        # Its writers may come and go; whoever offers this, is read.
        recorder.offered(self.topic, in_force(self._subscription))

    def share(self, other: Subscription[Any], take: Callable[[Any], None]) -> None:
        """Let another topic feed the same input; `take` gets its messages."""
        self._shared.append((other, take))

    def drain(self) -> None:
        """Take every message that has arrived, without asking the executor.

        A turn of the executor costs as much as the physics of a tick even if nothing has arrived.
        """
        _drain(self._subscription, self._take, raw=True)
        for other, take in self._shared:
            _drain(other, take, raw=False)

    def record(self, value: float) -> None:
        """Write a value that applies from now on although no message brought it."""
        self._write(self.topic, FLOAT64, self._now_ns(), float64_bytes(value))

    def take(self, value: float, via: str = "") -> None:
        """Offer a value to the input; record it, or warn of it now and then.

        Args:
            value: in the input's unit.
            via: the topic that it came from, if it is another one.
        """
        refusal = self.guarded.offer(value, self._now_ns())
        if not refusal:
            self.record(value)
        elif monotonic() >= self._next_warning_s:
            self._next_warning_s = monotonic() + _WARN_EVERY_S
            origin = f"{via}, as " if via else ""
            self._log.warning(f"{origin}{refusal}; the last good value holds")

    def _take(self, data: bytes) -> None:
        order = "<" if data[1] else ">"
        self.take(struct.unpack_from(f"{order}d", data, 4)[0])


def _drain(source: Subscription[Any], take: Callable[[Any], None], *, raw: bool) -> None:
    handle = source.handle
    while True:
        with handle:
            # typed as if a message always came
            taken = cast("tuple[Any, object] | None", handle.take_message(Float64, raw))
        if taken is None:
            return
        take(taken[0])
