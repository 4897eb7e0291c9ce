"""Frames, description and arrows as messages: read by `rosbags`, and they agree with the truck."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ElementTree
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mcap.reader import make_reader
from numpy.typing import NDArray

from truck_blowout_sim import (
    Blowout,
    InitialState,
    Inputs,
    Recording,
    Series,
    Truck,
    load_vehicle,
    read_recording,
    write_recording,
)
from truck_blowout_sim.display.arrows import MARKERS
from truck_blowout_sim.display.frames import TF_MESSAGE, fixed_frames
from truck_blowout_sim.display.scene import LATCHED, ROBOT_DESCRIPTION, TF_STATIC, Scene, beside
from truck_blowout_sim.recordings.channels import STRING
from truck_blowout_sim.recordings.message_types import typestore
from truck_blowout_sim.vehicle.places import hub_places

VEHICLE = load_vehicle("international_9400i_trailmobile")
STAMP_NS = 2_250_000_000
Matrix = NDArray[np.float64]


def read(data: bytes, ros_type: str) -> Any:  # noqa: ANN401  # a message of rosbags
    return typestore().deserialize_cdr(data, ros_type)


def matrix(transform: Any) -> Matrix:  # noqa: ANN401
    q, t = transform.rotation, transform.translation
    assert math.hypot(q.x, q.y, q.z, q.w) == pytest.approx(1.0, abs=1e-12)
    out = np.eye(4)
    out[:3, :3] = np.array([
        [1 - 2 * (q.y**2 + q.z**2), 2 * (q.x * q.y - q.z * q.w), 2 * (q.x * q.z + q.y * q.w)],
        [2 * (q.x * q.y + q.z * q.w), 1 - 2 * (q.x**2 + q.z**2), 2 * (q.y * q.z - q.x * q.w)],
        [2 * (q.x * q.z - q.y * q.w), 2 * (q.y * q.z + q.x * q.w), 1 - 2 * (q.x**2 + q.y**2)],
    ])  # fmt: skip
    out[:3, 3] = t.x, t.y, t.z
    return out


class Tree:
    """A tf buffer of one instant."""

    def __init__(self, *messages: Any) -> None:  # noqa: ANN401
        frames = [frame for message in messages for frame in message.transforms]
        self.parent = {f.child_frame_id: (f.header.frame_id, matrix(f.transform)) for f in frames}
        assert len(self.parent) == len(frames)  # a frame has one parent

    def in_map(self, frame: str) -> Matrix:
        if frame == "map":
            return np.eye(4)
        parent, own = self.parent[frame]
        return self.in_map(parent) @ own


@pytest.fixture(scope="module")
def truck() -> Truck:
    """In a turn, the left steer tire flat."""
    made = Truck(VEHICLE, initial=InitialState(speed_mps=15.0, x_m=10.0, y_m=-3.0, yaw_rad=0.5))
    made.advance(Inputs(2.0), 1000)
    made.blow("steer_left")
    made.advance(Inputs(2.0), 1000)
    return made


@pytest.fixture(scope="module")
def scene(truck: Truck) -> Scene:
    return Scene(VEHICLE, truck.output_names)


@pytest.fixture(scope="module")
def tree(truck: Truck, scene: Scene) -> Tree:
    latched = {said.topic: said for said in scene.latched}
    moving = read(scene.frames(STAMP_NS, truck.output_vector()), TF_MESSAGE)
    assert {(f.header.stamp.sec, f.header.stamp.nanosec) for f in moving.transforms} == {
        (2, 250_000_000)
    }
    return Tree(moving, read(latched[TF_STATIC].data, TF_MESSAGE))


def test_every_link_of_the_description_has_a_place_in_map(scene: Scene, tree: Tree) -> None:
    said = {one.topic: one for one in scene.latched}
    assert tuple(said) == LATCHED
    text = read(said[ROBOT_DESCRIPTION].data, STRING).data
    links = [str(link.get("name")) for link in ElementTree.fromstring(text).findall("link")]
    assert len(links) > 40
    for link in links:
        assert np.isfinite(tree.in_map(link)).all()


def test_units_stand_where_the_outputs_say(truck: Truck, tree: Tree) -> None:
    outputs = truck.outputs()
    for unit in VEHICLE.units:
        place = tree.in_map(f"{unit}/base_link")[:3, 3]
        assert place == pytest.approx([outputs[f"{unit}_{axis}_m"] for axis in "xyz"], abs=1e-9)


def test_the_trailer_of_the_model_stands_on_its_frame(tree: Tree) -> None:
    # the fifth wheel gives a little, a display's joint does not
    gap = tree.in_map("trailer/chassis") - tree.in_map("trailer/base_link")
    assert np.abs(gap[:3, 3]).max() < 0.05
    assert np.abs(gap[:3, :3]).max() < 0.005


def test_steered_wheels_turn_with_the_steering(truck: Truck, tree: Tree) -> None:
    knuckle = np.linalg.inv(tree.in_map("steer_left/carrier")) @ tree.in_map("steer_left/knuckle")
    steer_rad = truck.outputs()["steer_left_steer_rad"]
    assert math.atan2(knuckle[1, 0], knuckle[0, 0]) == pytest.approx(steer_rad, abs=1e-9)
    assert steer_rad > 0.02


def test_arrows_carry_the_weight_and_a_blown_tire_is_red(truck: Truck, scene: Scene) -> None:
    data = scene.arrows(STAMP_NS, truck.output_vector(), truck.blown)
    markers = read(data, MARKERS).markers
    assert [m.text for m in markers] == [
        tire for hub in hub_places(VEHICLE) for tire, _, _ in hub.tires
    ]
    weight_n = sum(20000.0 * (m.points[1].z - m.points[0].z) for m in markers)
    assert weight_n == pytest.approx(23600 * 9.81, rel=0.05)
    red = {m.text for m in markers if m.color.r > m.color.g}
    assert red == {"steer_left"}
    whole = read(scene.arrows(STAMP_NS, truck.output_vector(), ()), MARKERS).markers
    assert not [m.text for m in whole if m.color.r > m.color.g]


def test_fifth_wheel_and_kingpin_meet(tree: Tree) -> None:
    gap_m = tree.in_map("tractor/fifth_wheel")[:3, 3] - tree.in_map("trailer/kingpin")[:3, 3]
    assert np.abs(gap_m).max() < 0.05


def test_without_joints_only_the_units_move(truck: Truck) -> None:
    bare = Scene(VEHICLE, truck.output_names, joints=False)
    moving = read(bare.frames(STAMP_NS, truck.output_vector()), TF_MESSAGE)
    assert [f.child_frame_id for f in moving.transforms] == [
        "tractor/base_link", "trailer/base_link",
    ]  # fmt: skip


def test_a_car_has_no_hitch() -> None:
    frames = read(fixed_frames(load_vehicle("ferrari_250lm")), TF_MESSAGE).transforms
    assert [f.child_frame_id for f in frames] == ["tractor/chassis"]


def test_masses_of_all_links_are_the_trucks(scene: Scene) -> None:
    text = read(scene.latched[0].data, STRING).data
    root = ElementTree.fromstring(text)
    masses_kg = [float(str(m.get("value"))) for m in root.iter("mass")]
    spec = VEHICLE.spec
    sprung_kg = sum(
        unit.body.mass_kg + sum(box.mass_kg for box in unit.payload.values())
        for unit in VEHICLE.unit_specs.values()
    )
    axles_kg = sum(axle.mass_kg for axle in spec.axles.values())
    assert sum(masses_kg) == pytest.approx(sprung_kg + axles_kg, rel=1e-5)
    for inertia in root.iter("inertia"):
        ixx, iyy, izz = (float(str(inertia.get(k))) for k in ("ixx", "iyy", "izz"))
        assert ixx + iyy > izz > 0  # a body can have these
        assert iyy + izz > ixx > 0


def test_a_bag_of_a_run_shows_the_truck_by_itself(truck: Truck, tmp_path: Path) -> None:
    times_s = np.array([-0.05, 0.0, 0.05, 0.10])
    rows = np.repeat(truck.output_vector()[None, :], 4, axis=0)
    channel = Series(times_s, np.full(4, 15.0))
    recording = Recording("run", {"tractor_vx_mps": channel}, (Blowout(0.05, ("steer_left",)),))
    extra = beside(VEHICLE, truck.output_names, times_s, rows, recording.blowouts)
    write_recording(recording, tmp_path / "run.mcap", beside=extra)
    with (tmp_path / "run.mcap").open("rb") as stream:
        found = [(c.topic, m.log_time, m.data) for _, c, m in make_reader(stream).iter_messages()]
    count = Counter(topic for topic, _, _ in found)
    assert (count["/tf"], count["/clock"], count["/tf_static"]) == (4, 4, 1)
    assert count["/truck/robot_description"] == 1
    assert [stamp for topic, stamp, _ in found if topic == "/tf"] == [
        0, 50_000_000, 100_000_000, 150_000_000,
    ]  # fmt: skip
    arrows = [read(data, MARKERS) for topic, _, data in found if topic == "/truck/tire_forces"]
    red = [{m.text for m in one.markers if m.color.r > m.color.g} for one in arrows]
    assert red == [set(), {"steer_left"}]
    assert read_recording(tmp_path / "run.mcap").blowouts == recording.blowouts
