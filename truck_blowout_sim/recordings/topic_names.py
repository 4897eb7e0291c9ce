"""Which topics of a bag are which rows of the table: namespaces and foreign names."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Mapping

from truck_blowout_sim.errors import InputError, nearest, quoted
from truck_blowout_sim.recordings.channels import (
    BLOWOUT_EVENT,
    DEFAULT_NAMESPACE,
    FLOAT64,
    FLUID_PRESSURE,
    STRING,
    WRENCH,
    channels_for,
)
from truck_blowout_sim.recordings.names import parts_of

_TIRE = re.compile(r"tires/(\w+)/pressure")
_TIRE_FORCE = re.compile(r"tires/(\w+)/force")
_TIRE_RADIUS = re.compile(r"tires/(\w+)/loaded_radius")
_CHAMBER = re.compile(r"brake_chambers/(\w+)/pressure")
_FIXED = {
    **{c.topic: c.ros_type for c in channels_for((), ()) if c.place},
    **{p.topic: p.ros_type for c in channels_for((), ()) for p in c.places},
    "joint_states": "sensor_msgs/msg/JointState",
    BLOWOUT_EVENT.topic: STRING,
}


def type_of(topic: str) -> str | None:
    """Message type that the table has for a relative topic name, None if it has no such topic."""
    if _TIRE.fullmatch(topic) or _CHAMBER.fullmatch(topic):
        return FLUID_PRESSURE
    if _TIRE_FORCE.fullmatch(topic):
        return WRENCH
    if _TIRE_RADIUS.fullmatch(topic):
        return FLOAT64
    return _FIXED.get(topic)


def channel_names(topics: Iterable[str]) -> list[str]:
    """Channel names that relative topics imply, to collect tires, hubs and units from."""
    names = []
    for topic in topics:
        tire, chamber = _TIRE.fullmatch(topic), _CHAMBER.fullmatch(topic)
        if tire:
            names.append(f"tire_pressure_{tire[1]}_pa")
        elif force := _TIRE_FORCE.fullmatch(topic):
            names.append(f"tire_fz_{force[1]}_n")
        elif radius := _TIRE_RADIUS.fullmatch(topic):
            names.append(f"tire_loaded_radius_{radius[1]}_m")
        elif chamber:
            names.append(f"brake_chamber_{chamber[1]}_pa")
        elif "/" in topic:
            names.append(topic.replace("/", "_"))
    return names


def channels_on(topics: Iterable[str], names: Iterable[str] = ()) -> set[str]:
    """Channels that topics of the table carry, for the parts that further channels speak of."""
    relative = {topic.removeprefix(DEFAULT_NAMESPACE).strip("/") for topic in topics}
    table = parts_of([*names, *channel_names(relative)]).table()
    return {c.name for c in table if any(place.topic in relative for place in c.places)}


def joint_channel_names(joints: Iterable[str]) -> list[str]:
    """Channel names that joint names imply."""
    names = []
    for joint in joints:
        part, _, kind = joint.rpartition("_")
        if kind == "spin":
            names.append(f"hub_speed_{part}_radps")
        elif kind == "steer":
            names.append(f"{part}_steer_rad")
        elif joint == "articulation":
            names.append("articulation_rad")
    return names


def relative_names(
    topics: Iterable[str], namespace: str | None, remap: Mapping[str, str]
) -> dict[str, str]:
    """Map relative names of the table to the bag's topics.

    Args:
        topics: absolute names in the bag.
        namespace: prefix of the truck's topics; None takes ``/truck`` if it is there, else the
            prefix under which most topics of the table are found.
        remap: foreign topic name to the table's, as ``from: to`` of ROS remapping; ``to`` may be
            relative or absolute.
    """
    bag_topics = ["/" + topic.strip("/") for topic in topics]
    prefix = _prefix(bag_topics) if namespace is None else "/" + namespace.strip("/")
    prefix = prefix.rstrip("/")
    found: dict[str, str] = {}
    for topic in bag_topics:
        relative = topic.removeprefix(prefix + "/")
        if topic.startswith(prefix + "/") and type_of(relative):
            found[relative] = topic
    for source, target in remap.items():
        absolute = "/" + source.strip("/")
        relative = target.removeprefix(DEFAULT_NAMESPACE + "/").lstrip("/")
        _check_remap(absolute, relative, bag_topics)
        found[relative] = absolute
    return found


def _check_remap(source: str, target: str, topics: list[str]) -> None:
    if source not in topics:
        raise InputError(
            f"no topic {source} in the bag", expected=nearest(source, topics, "a topic of the bag")
        )
    if type_of(target) is None:
        raise InputError(
            f"{quoted(target)} is no topic of the table",
            expected=nearest(target, _FIXED, "as tractor/odometry"),
        )


def _prefix(topics: list[str]) -> str:
    votes: Counter[str] = Counter()
    for topic in topics:
        parts = topic.split("/")
        for cut in range(1, len(parts)):
            if type_of("/".join(parts[cut:])):
                votes["/".join(parts[:cut])] += 1
    if votes[DEFAULT_NAMESPACE] or not votes:
        return DEFAULT_NAMESPACE
    return max(votes, key=lambda prefix: (votes[prefix], -len(prefix)))
