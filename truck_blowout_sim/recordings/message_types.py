"""ROS message definitions without ROS: field lists, embedded texts, type hashes, QoS.

References: ROS interface definitions as shipped with `rosbags` (Jazzy; Kilted has the
same); REP 2011 type hashes; rosbag2 metadata version 9.
Known limits: message types that `rosbags` does not know need no decoding here and are skipped.
Validated with: test/recordings/test_foreign_readers.py.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache
from typing import Any

from rosbags.typesys import (
    Stores,
    TypesysError,
    get_types_from_idl,
    get_types_from_msg,
    get_typestore,
)
from rosbags.typesys.store import Typestore

ROS_DISTRO = "kilted"
_HEADER = "std_msgs/msg/Header"

_SAID_ONCE = ("robot_description", "tf_static", "blown_tires")
_FOREVER = {"sec": 9223372036, "nsec": 854775807}


@lru_cache(maxsize=1)
def typestore() -> Typestore:
    """Field lists of the standard messages."""
    return get_typestore(Stores.ROS2_JAZZY)


def store_of(definitions: Iterable[tuple[str, str]]) -> Typestore:
    """Field lists as a bag defines them, the standard ones for what it does not define.

    Args:
        definitions: message type and its text (``.msg`` or IDL, nested types included), empty
            where the bag holds none. The header is always that of ROS 2: that of ROS 1 has a
            counter more, which a conversion to CDR drops.

    Raises:
        ValueError: a text that is no definition.
    """
    types: dict[str, Any] = dict(typestore().fielddefs)
    for ros_type, text in dict(definitions).items():
        if not text or (ros_type in types and definition(ros_type).strip() == text.strip()):
            continue
        try:
            parsed = _parsed(ros_type, text)
        except (TypesysError, ValueError, KeyError, AssertionError) as error:
            raise ValueError(f"definition of {ros_type}: {error}") from None
        types.update({name: fields for name, fields in parsed.items() if name != _HEADER})
    store = get_typestore(Stores.EMPTY)
    store.register(types)
    return store


def _parsed(ros_type: str, text: str) -> dict[str, Any]:
    if "IDL: " not in text.split("\n", 2)[0] + text[:200]:
        return dict(get_types_from_msg(text, ros_type))
    types: dict[str, Any] = {}
    for part in text.split(f"{'=' * 80}\n"):
        if part.startswith("IDL: "):
            types.update(get_types_from_idl(part.partition("\n")[2]))
    return types


@lru_cache(maxsize=64)
def definition(ros_type: str) -> str:
    """Full message definition text, nested types included, as MCAP's ``ros2msg`` wants it."""
    return typestore().generate_msgdef(ros_type, ros_version=2)[0]


@lru_cache(maxsize=64)
def type_hash(ros_type: str) -> str:
    """REP 2011 hash, ``RIHS01_…``."""
    return typestore().hash_rihs01(ros_type)


def qos_profile(
    *,
    history: str = "keep_last",
    depth: int = 10,
    reliability: str = "reliable",
    durability: str = "volatile",
) -> dict[str, Any]:
    """A QoS profile as rosbag2 writes it; what no node here ever sets has rmw's default."""
    return {
        "history": history,
        "depth": depth,
        "reliability": reliability,
        "durability": durability,
        "deadline": dict(_FOREVER),
        "lifespan": dict(_FOREVER),
        "liveliness": "automatic",
        "liveliness_lease_duration": dict(_FOREVER),
        "avoid_ros_namespace_conventions": False,
    }


def offered_qos(topic: str) -> dict[str, Any]:
    """QoS profile that the simulator offers on a topic unless it is told otherwise.

    Events and what is said only once must reach late joiners, also when a bag is played later.
    """
    name = topic.rsplit("/", 1)[-1]
    if name == "blowout":
        return qos_profile(depth=100, durability="transient_local")
    if name in _SAID_ONCE:
        return qos_profile(depth=1, durability="transient_local")
    return qos_profile()
