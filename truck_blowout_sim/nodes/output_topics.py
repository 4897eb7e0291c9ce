"""Everything the simulator publishes about the truck, tick by tick."""

from __future__ import annotations

from collections.abc import Callable

from rclpy.node import Node
from visualization_msgs.msg import MarkerArray

from truck_blowout_sim.nodes.clock import NS
from truck_blowout_sim.nodes.markers import ForceMarkers
from truck_blowout_sim.nodes.outputs import OutputTable
from truck_blowout_sim.nodes.plant import Plant
from truck_blowout_sim.nodes.publishing import make_publishers
from truck_blowout_sim.nodes.qos import in_force, publisher, reliable
from truck_blowout_sim.nodes.recorder import Recorder
from truck_blowout_sim.nodes.simulator_parameters import Timing, Values
from truck_blowout_sim.nodes.transforms import Transforms, tf_message_class
from truck_blowout_sim.recordings.cdr import template
from truck_blowout_sim.recordings.channels import STRING

BLOWOUT = "blowout"


class OutputTopics:
    """Publishes and records each batch of messages when it is due."""

    def __init__(
        self, node: Node, plant: Plant, timing: Timing, values: Values, recorder: Recorder
    ) -> None:
        names = plant.truck.output_names
        self._plant = plant
        self._timing = timing
        self._recorder = recorder
        self._table = OutputTable(plant.vehicle, names, timing.group_every)
        types = {slot.topic: slot.ros_type for b in self._table.batches for slot in b.encoder.slots}
        self._types = {**types, BLOWOUT: STRING}
        self._publishers = make_publishers(node, self._types)
        for made in self._publishers.values():
            recorder.offered(made.topic_name, in_force(made))
        self._markers = ForceMarkers(plant.vehicle, names)
        self._marker_publisher = publisher(node, MarkerArray, "tire_forces", reliable(1))
        message = tf_message_class() if values["publish_tf"] else None
        self._transforms = Transforms(node, plant.vehicle, names, message) if message else None
        self._others: list[Callable[[int], None]] = []
        self._tick = 0
        self._last_ns: int | None = None

    def publish(self, *, everything: bool = False) -> None:
        """One tick has passed: publish what is due.

        Args:
            everything: publish all, whether due or not (at the start and after a reset), without
                counting a tick.
        """
        if not everything:
            self._tick += 1
        due = [b for b in self._table.batches if everything or self._tick % b.every == 0]
        markers = self._markers_due(everything)
        if not (due or markers):
            return
        now_ns = self._plant.now_ns
        outputs = self._plant.outputs()
        elapsed_s = (now_ns - self._last_ns) / NS if self._last_ns is not None else 0.0
        self._last_ns = now_ns
        values = self._table.values(outputs, elapsed_s)
        for batch in due:
            for topic, data in batch.encoder.messages(now_ns, values).items():
                self._send(topic, now_ns, data)
        if self._transforms and (everything or self._tick % self._timing.publish_every == 0):
            self._transforms.publish(now_ns, outputs)
        if everything or self._tick % self._timing.publish_every == 0:
            for report in self._others:
                report(now_ns)
        if markers:
            blown = tuple(self._plant.blown_ns)
            self._marker_publisher.publish(self._markers.fill(now_ns, outputs, blown))

    def also(self, report: Callable[[int], None]) -> None:
        """Call something at every publishing period, with the stamp."""
        self._others.append(report)

    def record(self) -> None:
        """Write the present state to the bag, which has just begun."""
        now_ns = self._plant.now_ns
        values = self._table.values(self._plant.outputs(), 0.0)
        for batch in self._table.batches:
            for topic, data in batch.encoder.messages(now_ns, values).items():
                self._write(topic, now_ns, data)

    def announce_blowout(self, tire: str) -> None:
        """Publish and record the event."""
        self._send(BLOWOUT, self._plant.now_ns, template(STRING, data=tire))

    def restart(self) -> None:
        """The truck was put back: no rates across that gap."""
        self._last_ns = None

    def _send(self, topic: str, now_ns: int, data: bytes) -> None:
        self._publishers[topic].publish(data)
        if self._recorder.active:
            self._write(topic, now_ns, data)

    def _write(self, topic: str, now_ns: int, data: bytes) -> None:
        name = self._publishers[topic].topic_name
        self._recorder.write(name, self._types[topic], now_ns, data)

    def _markers_due(self, everything: bool) -> bool:
        every = self._timing.marker_every
        if not every or not (everything or self._tick % every == 0):
            return False
        return bool(self._marker_publisher.get_subscription_count() > 0)
