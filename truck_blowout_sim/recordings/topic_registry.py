"""Topics of a bag being written: channel numbers, with schema and QoS described in the file."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from mcap import records

from truck_blowout_sim.recordings.bag_metadata import qos_text
from truck_blowout_sim.recordings.chunk import Chunk
from truck_blowout_sim.recordings.mcap_file import Contents, to_bytes
from truck_blowout_sim.recordings.message_types import definition, offered_qos, type_hash


class TopicRegistry:
    """Numbers topics and message types, each described in the chunk in which it first appears.

    Args:
        contents: what the file holds so far.
        qos: QoS profile by absolute topic; the simulator's default where none is given.
    """

    def __init__(
        self, contents: Contents, qos: Mapping[str, Mapping[str, Any]] | None = None
    ) -> None:
        self._contents = contents
        self._qos = dict(qos or {})
        self._topics: dict[str, int] = {}
        self._types: dict[str, int] = {}

    def number(self, topic: str, ros_type: str, chunk: Chunk) -> int:
        """Channel number of an absolute topic name; a new one is described in the chunk.

        Raises:
            ValueError: the topic is known with another type.
        """
        if topic not in self._topics:
            self._topics[topic] = self._add_topic(topic, ros_type, chunk)
        number = self._topics[topic]
        if self._contents.channels[number].schema_id != self._types.get(ros_type):
            raise ValueError(f"topic {topic} is not of type {ros_type}")
        return number

    def _add_topic(self, topic: str, ros_type: str, chunk: Chunk) -> int:
        if ros_type not in self._types:
            self._types[ros_type] = self._add_type(ros_type, chunk)
        channel = records.Channel(
            id=len(self._topics) + 1,
            topic=topic,
            message_encoding="cdr",
            metadata={
                "offered_qos_profiles": qos_text(self._qos.get(topic) or offered_qos(topic)),
                "topic_type_hash": type_hash(ros_type),
            },
            schema_id=self._types[ros_type],
        )
        self._contents.channels[channel.id] = channel
        chunk.add_record(to_bytes(channel))
        return channel.id

    def _add_type(self, ros_type: str, chunk: Chunk) -> int:
        text = definition(ros_type).encode()
        schema = records.Schema(
            id=len(self._types) + 1, data=text, encoding="ros2msg", name=ros_type
        )
        self._contents.schemas[schema.id] = schema
        chunk.add_record(to_bytes(schema))
        return schema.id
