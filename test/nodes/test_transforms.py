"""/tf: with a stand-in for tf2_msgs, which is not on PyPI."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import pytest

from truck_blowout_sim import InitialState, Truck, load_vehicle
from truck_blowout_sim.nodes.transforms import Transforms, hitch_frames

VEHICLE = load_vehicle("international_9400i_trailmobile")


class Message:
    def __init__(self, transforms: list[Any]) -> None:
        self.transforms = transforms


class Node:
    def __init__(self) -> None:
        self.sent: dict[str, list[Any]] = {}

    def resolve_topic_name(self, topic: str) -> str:
        return topic

    def create_publisher(self, _: type, topic: str, *__: object, **___: object) -> SimpleNamespace:
        return SimpleNamespace(publish=self.sent.setdefault(topic, []).append)


def test_units_stand_in_map_and_hitches_in_units() -> None:
    initial = InitialState(speed_mps=5.0, x_m=10.0, y_m=-3.0, yaw_rad=0.5)
    truck = Truck(VEHICLE, initial=initial)
    node: Any = Node()
    transforms = Transforms(node, VEHICLE, truck.output_names, Message)
    transforms.publish(2_250_000_000, truck.output_vector())
    (message,) = node.sent["/tf"]
    tractor, trailer = message.transforms
    assert (tractor.header.frame_id, tractor.child_frame_id) == ("map", "tractor/base_link")
    assert (tractor.header.stamp.sec, tractor.header.stamp.nanosec) == (2, 250_000_000)
    assert tractor.transform.translation.x == pytest.approx(10.0, abs=1e-3)
    assert 2 * math.asin(tractor.transform.rotation.z) == pytest.approx(0.5, abs=1e-3)
    assert trailer.child_frame_id == "trailer/base_link"
    (static,) = node.sent["/tf_static"]
    assert [f.child_frame_id for f in static.transforms] == [
        "tractor/fifth_wheel", "trailer/kingpin",
    ]  # fmt: skip


def test_fifth_wheel_and_kingpin_meet() -> None:
    truck = Truck(VEHICLE)
    outputs = truck.outputs()
    fifth_wheel, kingpin = hitch_frames(VEHICLE)
    front_m = outputs["tractor_x_m"] + fifth_wheel.transform.translation.x
    rear_m = outputs["trailer_x_m"] + kingpin.transform.translation.x
    assert front_m == pytest.approx(rear_m, abs=0.01)


def test_a_single_unit_has_no_hitch() -> None:
    assert hitch_frames(load_vehicle("ferrari_250lm")) == []
