"""Bags of other storages than plain MCAP, by `rosbags`: SQLite, compressed ones, ROS 1.

References: rosbag2 storage plugins; ROS 1 bag format 2.0.
Known limits: every message is held in memory.
Validated with: test/recordings/test_logs_bags.py.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from rosbags.interfaces import Connection, MessageDefinitionFormat

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings.mcap_scan import Topic
from truck_blowout_sim.recordings.message_types import store_of


def read_storage(path: Path) -> dict[str, Topic]:
    """All topics of a bag with their messages, as CDR.

    Args:
        path: a rosbag2 folder, a ``.db3`` file, or a ROS 1 ``.bag``.

    Raises:
        InputError: damaged, or of a storage or compression that no library here reads.
    """
    ros1 = path.suffix == ".bag"
    try:
        with _reader(path, ros1) as reader:
            topics = _topics(reader.connections, path)
            for connection, log_time_ns, data in reader.messages(connections=reader.connections):
                topic = topics[f"/{connection.topic.strip('/')}"]
                topic.log_times_ns.append(log_time_ns)
                topic.data.append(bytes(data))
        if ros1:
            _convert(topics)
    except InputError:
        raise
    except Exception as error:  # noqa: BLE001 -- the library names damage in many ways
        words = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise InputError(words, file=path, expected="an undamaged bag") from None
    return {name: topic for name, topic in topics.items() if topic.data}


def _reader(path: Path, ros1: bool) -> Any:  # noqa: ANN401 -- two classes of one shape
    if ros1:
        from rosbags.rosbag1 import Reader as Reader1

        return Reader1(path)
    from rosbags.rosbag2 import Reader

    return Reader(path)


def _topics(connections: Iterable[Connection], path: Path) -> dict[str, Topic]:
    """Empty topics by absolute name; several nodes may have written to one."""
    topics: dict[str, Topic] = {}
    for connection in connections:
        name = f"/{connection.topic.strip('/')}"
        topics.setdefault(name, _topic(connection)).require_type(connection.msgtype, path)
    return topics


def _topic(connection: Connection) -> Topic:
    stated = connection.msgdef.format != MessageDefinitionFormat.NONE
    definition = connection.msgdef.data if stated else ""
    return Topic(connection.topic, connection.msgtype, "cdr", definition)


def _convert(topics: dict[str, Topic]) -> None:
    """ROS 1 messages become CDR of the same fields."""
    store = store_of((topic.ros_type, topic.definition) for topic in topics.values())
    for topic in topics.values():
        topic.data = [bytes(store.ros1_to_cdr(data, topic.ros_type)) for data in topic.data]
