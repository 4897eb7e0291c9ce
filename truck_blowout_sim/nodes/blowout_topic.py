"""`blowout`, the event, and `blown_tires`, the state: both true for whoever joins late."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from rclpy.node import Node
from rclpy.publisher import Publisher
from std_msgs.msg import String

from truck_blowout_sim.nodes.qos import event, in_force, publisher, state
from truck_blowout_sim.nodes.recorder import Recorder
from truck_blowout_sim.recordings.cdr import template
from truck_blowout_sim.recordings.channels import STRING

BLOWOUT, BLOWN_TIRES = "blowout", "blown_tires"


class BlowoutAnnouncer:
    """Publishes and records which tires blow and which are blown.

    A publisher cannot take back what it holds ready for late joiners. After a reset another one
    goes on, which holds nothing; it is made at the first blowout, so that every reader knows it
    long before it is needed.

    Args:
        node: owner.
        recorder: gets every message.
        now_ns: tells the simulated time.
    """

    def __init__(self, node: Node, recorder: Recorder, now_ns: Callable[[], int]) -> None:
        self._node = node
        self._recorder = recorder
        self._now_ns = now_ns
        self._events = self._make()
        self._spare: Publisher[Any] | None = None
        self._state = publisher(node, String, BLOWN_TIRES, state())
        self.topic = self._events.topic_name
        recorder.offered(self.topic, in_force(self._events))
        recorder.offered(self._state.topic_name, in_force(self._state))
        self._tell(())

    def announce(self, tire: str, blown: Sequence[str]) -> None:
        """A tire has blown; `blown` are all that are."""
        self._spare = self._spare or self._make()
        data = template(STRING, data=tire)
        self._events.publish(data)
        self._recorder.write(self.topic, STRING, self._now_ns(), data)
        self._tell(blown)

    def restart(self, blown: Sequence[str]) -> None:
        """All tires are whole again but those that begin flat."""
        if self._spare is not None:
            self._node.destroy_publisher(self._events)
            self._events, self._spare = self._spare, None
        self._tell(blown)

    def record_earlier(self, tire: str, blown_ns: int) -> None:
        """Write an event from before a bag began, at its instant: stamps begin at zero."""
        self._recorder.write(self.topic, STRING, max(blown_ns, 0), template(STRING, data=tire))

    def record(self, blown: Sequence[str]) -> None:
        """Write the state to a bag that has just begun."""
        self._recorder.write(self._state.topic_name, STRING, self._now_ns(), _joined(blown))

    def _make(self) -> Publisher[Any]:
        return publisher(self._node, String, BLOWOUT, event())

    def _tell(self, blown: Sequence[str]) -> None:
        self._state.publish(_joined(blown))
        self.record(blown)


def _joined(blown: Sequence[str]) -> bytes:
    return template(STRING, data="+".join(blown))
