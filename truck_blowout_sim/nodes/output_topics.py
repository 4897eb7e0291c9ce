"""Everything the simulator publishes about the truck, tick by tick."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rclpy.node import Node
from rclpy.publisher import Publisher

from truck_blowout_sim.display.scene import (
    LATCHED,
    ROBOT_DESCRIPTION,
    TF,
    TF_STATIC,
    TIRE_FORCES,
    TYPES,
    Scene,
)
from truck_blowout_sim.nodes.blowout_topic import BlowoutAnnouncer
from truck_blowout_sim.nodes.clock import NS
from truck_blowout_sim.nodes.clock_topics import CLOCK, CLOCK_TYPE, clock_bytes
from truck_blowout_sim.nodes.outputs import Batch, OutputTable
from truck_blowout_sim.nodes.plant import Plant
from truck_blowout_sim.nodes.publishing import Readers, make_publishers, message_class
from truck_blowout_sim.nodes.qos import in_force, publisher, reliable, state
from truck_blowout_sim.nodes.recorder import Recorder
from truck_blowout_sim.nodes.simulator_parameters import Timing, Values

FloatArray = NDArray[np.float64]


class OutputTopics:
    """Publishes and records each batch of messages when it is due.

    What nobody reads and no bag takes is not made.
    """

    def __init__(
        self, node: Node, plant: Plant, timing: Timing, values: Values, recorder: Recorder
    ) -> None:
        names = plant.output_names
        self._log = node.get_logger()
        self._plant = plant
        self._timing = timing
        self._recorder = recorder
        self._table = OutputTable(plant.vehicle, names, timing.group_every)
        self._scene = Scene(
            plant.vehicle, names, joints=values["tf_of_joints"], display=self._table.display
        )
        self._publishers = make_publishers(node, self._table.types)
        self._publishers |= self._make_scene_publishers(node, tf=values["publish_tf"])
        self._readers = Readers(self._publishers)
        for made in self._publishers.values():
            recorder.offered(made.topic_name, in_force(made))
        self._blowouts_shared = bool(values["blowout_input"])
        self._blowouts = BlowoutAnnouncer(node, recorder, lambda: plant.now_ns)
        self._types = {**self._table.types, **TYPES, CLOCK: CLOCK_TYPE}
        self._names = {topic: node.resolve_topic_name(topic) for topic in self._types}
        self._read: frozenset[str] = frozenset()
        self._read_batches: tuple[Batch, ...] = ()
        self._read_display = False
        self._no_display = np.zeros(len(self._table.display.channels))
        self._others: list[Callable[[int], None]] = []
        self._tick = 0
        self._last_ns: int | None = None
        for said in self._scene.latched:
            if said.topic in self._publishers:
                self._publishers[said.topic].publish(said.data)

    @property
    def topics(self) -> tuple[str, ...]:
        """Absolute names of what this node alone should publish."""
        events = () if self._blowouts_shared else (self._blowouts.topic,)
        return (*(self._names[topic] for topic in self._table.types), *events)

    def publish(self, *, everything: bool = False) -> None:
        """One tick has passed: publish what is due.

        Args:
            everything: publish all, whether due or not (at the start and after a reset), without
                counting a tick.
        """
        if not everything:
            self._tick += 1
        self._look_for_readers()
        whole_period = everything or self._tick % self._timing.publish_every == 0
        batches = self._table.batches if self._recorder.active else self._read_batches
        due = [b for b in batches if everything or self._tick % b.every == 0]
        frames = whole_period and self._wanted(TF)
        arrows = self._arrows_due(everything) and self._wanted(TIRE_FORCES)
        now_ns = self._plant.now_ns
        if due or frames or arrows:
            outputs = self._plant.outputs()
            shown = frames or self._recorder.active or self._read_display
            display = self._display(now_ns, outputs) if shown else self._no_display
            values = self._table.values(outputs, display)
            for batch in due:
                for topic, data in batch.encoder.messages(now_ns, values).items():
                    self._send(topic, now_ns, data)
            if frames:
                self._send(TF, now_ns, self._scene.frames(now_ns, outputs, display))
            if arrows:
                self._send(TIRE_FORCES, now_ns, self._arrows(now_ns, outputs))
        if whole_period and self._recorder.active:
            self._write(CLOCK, now_ns, clock_bytes(now_ns))
        if whole_period:
            for report in self._others:
                report(now_ns)

    def also(self, report: Callable[[int], None]) -> None:
        """Call something at every publishing period, with the stamp."""
        self._others.append(report)

    def record(self) -> None:
        """Write the present state to the bag, which has just begun, and what late joiners hear."""
        now_ns = self._plant.now_ns
        outputs = self._plant.outputs()
        display = self._table.display.values(outputs, 0.0)
        values = self._table.values(outputs, display)
        for said in self._scene.latched:
            self._write(said.topic, now_ns, said.data)
        for batch in self._table.batches:
            for topic, data in batch.encoder.messages(now_ns, values).items():
                self._write(topic, now_ns, data)
        self._write(CLOCK, now_ns, clock_bytes(now_ns))
        self._write(TF, now_ns, self._scene.frames(now_ns, outputs, display))
        self._write(TIRE_FORCES, now_ns, self._arrows(now_ns, outputs))
        for tire, blown_ns in self._plant.blown_ns.items():
            self._blowouts.record_earlier(tire, blown_ns)
        self._blowouts.record(tuple(self._plant.blown_ns))

    def announce_blowout(self, tire: str) -> None:
        """Publish and record the event."""
        self._blowouts.announce(tire, tuple(self._plant.blown_ns))

    def restart(self) -> None:
        """The truck was put back: no rates across that gap, and no tire is blown."""
        self._last_ns = None
        self._blowouts.restart(tuple(self._plant.blown_ns))

    def _display(self, now_ns: int, outputs: FloatArray) -> FloatArray:
        elapsed_s = (now_ns - self._last_ns) / NS if self._last_ns is not None else 0.0
        self._last_ns = now_ns
        return self._table.display.values(outputs, elapsed_s)

    def _make_scene_publishers(self, node: Node, *, tf: bool) -> dict[str, Publisher[Any]]:
        topics = [ROBOT_DESCRIPTION, TIRE_FORCES, *((TF, TF_STATIC) if tf else ())]
        made, missing = {}, dict[str, list[str]]()
        for topic in topics:
            qos = state() if topic in LATCHED else reliable(100 if topic == TF else 10)
            try:
                made[topic] = publisher(node, message_class(TYPES[topic]), topic, qos)
            except ModuleNotFoundError as error:
                missing.setdefault(str(error.name), []).append(topic)
        for package, absent in missing.items():
            self._log.info(
                f"{package} is not installed: {' and '.join(absent)} are written to bags, but not"
                " published"
            )
        return made

    def _arrows(self, now_ns: int, outputs: FloatArray) -> bytes:
        return self._scene.arrows(now_ns, outputs, tuple(self._plant.blown_ns))

    def _arrows_due(self, everything: bool) -> bool:
        every = self._timing.marker_every
        return bool(every) and (everything or self._tick % every == 0)

    def _wanted(self, topic: str) -> bool:
        return self._recorder.active or topic in self._read

    def _look_for_readers(self) -> None:
        read = self._readers.topics()
        if read != self._read:
            self._read = read
            self._read_batches = self._table.read_by(read)
            self._read_display = self._table.needs_display(self._read_batches)

    def _send(self, topic: str, now_ns: int, data: bytes) -> None:
        if topic in self._read:
            self._publishers[topic].publish(data)
        if self._recorder.active:
            self._write(topic, now_ns, data)

    def _write(self, topic: str, now_ns: int, data: bytes) -> None:
        self._recorder.write(self._names[topic], self._types[topic], now_ns, data)
