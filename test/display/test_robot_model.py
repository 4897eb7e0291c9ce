"""The robot description: frames and joints agree with what the simulator publishes."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from truck_blowout_sim import InitialState, Inputs, Truck, load_vehicle
from truck_blowout_sim.display.urdf import urdf_of
from truck_blowout_sim.nodes.outputs import GROUPS, OutputTable
from truck_blowout_sim.recordings.encoder import RowEncoder
from truck_blowout_sim.vehicle.places import hub_places

ROOT = Path(__file__).resolve().parents[2]
NAME = "international_9400i_trailmobile"
Matrix = NDArray[np.float64]


def rotation(axis: NDArray[np.float64], angle: float) -> Matrix:
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    out = np.eye(4)
    out[:3, :3] = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    return out


def moved(place: NDArray[np.float64]) -> Matrix:
    out = np.eye(4)
    out[:3, 3] = place
    return out


class RobotModel:
    """Forward kinematics of a URDF, as robot_state_publisher does it."""

    def __init__(self, text: str) -> None:
        self.root = ElementTree.fromstring(text)
        self.joints = {joint.find("child").get("link"): joint for joint in self.root.iter("joint")}  # type: ignore[union-attr]

    def pose(self, link: str, positions: dict[str, float]) -> Matrix:
        """Pose of a link in the root's frame."""
        if link not in self.joints:
            return np.eye(4)
        joint = self.joints[link]
        parent, origin, axis = joint.find("parent"), joint.find("origin"), joint.find("axis")
        assert parent is not None
        assert origin is not None
        out = self.pose(str(parent.get("link")), positions)
        out = out @ moved(np.array([float(v) for v in str(origin.get("xyz")).split()]))
        if axis is None:
            return out
        direction = np.array([float(v) for v in str(axis.get("xyz")).split()])
        value = positions.get(str(joint.get("name")), 0.0)
        if joint.get("type") == "prismatic":
            return out @ moved(direction * value)
        return out @ rotation(direction, value)


def body_pose(outputs: dict[str, float], unit: str) -> Matrix:
    out = moved(np.array([outputs[f"{unit}_{axis}_m"] for axis in "xyz"]))
    for axis, angle in ((2, "yaw"), (1, "pitch"), (0, "roll")):
        out = out @ rotation(np.eye(3)[axis], outputs[f"{unit}_{angle}_rad"])
    return out


def joint_positions(table: OutputTable, truck: Truck) -> dict[str, float]:
    outputs = truck.output_vector()
    values = table.values(outputs, table.display.values(outputs, 0.01))
    encoder: RowEncoder = table.batches[0].encoder
    return {
        channel.place.field.split("[")[1][:-1]: float(value)
        for channel, value in zip(encoder.channels, values, strict=True)
        if channel.place and channel.place.field.startswith("position[")
    }


@pytest.fixture(scope="module")
def blown() -> Truck:
    """In a turn, the left steer tire flat: everything is tilted."""
    truck = Truck(load_vehicle(NAME), initial=InitialState(speed_mps=18.0))
    truck.advance(Inputs(2.0), 3000)
    truck.blow("steer_left")
    truck.advance(Inputs(2.0), 2000)
    return truck


@pytest.fixture(scope="module")
def table(blown: Truck) -> OutputTable:
    return OutputTable(blown.vehicle, blown.output_names, dict.fromkeys(GROUPS, 1))


def test_the_shipped_description_is_the_vehicles() -> None:
    shipped = ROOT / "config" / "urdf" / f"{NAME}.urdf"
    assert shipped.read_text() == urdf_of(load_vehicle(NAME))


def test_every_moving_joint_is_published(blown: Truck, table: OutputTable) -> None:
    root = ElementTree.fromstring(urdf_of(blown.vehicle))
    moving = {str(j.get("name")) for j in root.iter("joint") if j.get("type") != "fixed"}
    assert moving == set(joint_positions(table, blown))


def test_links_form_one_tree_and_carry_the_frames_of_the_messages(blown: Truck) -> None:
    model = RobotModel(urdf_of(blown.vehicle))
    links = [str(link.get("name")) for link in model.root.findall("link")]
    assert len(links) == len(set(links))
    assert [link for link in links if link not in model.joints] == ["tractor/base_link"]
    # frame_id of pressures; trailer/base_link is /tf's alone
    assert {*blown.vehicle.tires, *blown.vehicle.hubs} <= set(links)
    assert "trailer/base_link" not in links


def test_the_trailer_stands_where_the_simulator_has_it(blown: Truck, table: OutputTable) -> None:
    outputs = blown.outputs()
    model = RobotModel(urdf_of(blown.vehicle))
    shown = body_pose(outputs, "tractor") @ model.pose(
        "trailer/chassis", joint_positions(table, blown)
    )
    wanted = body_pose(outputs, "trailer")
    # the fifth wheel gives a little, a display's joint does not
    assert np.abs(shown[:3, 3] - wanted[:3, 3]).max() < 0.05
    assert np.abs(shown[:3, :3] - wanted[:3, :3]).max() < 0.005


def test_the_dropped_corner_shows(blown: Truck, table: OutputTable) -> None:
    outputs = blown.outputs()
    model = RobotModel(urdf_of(blown.vehicle))
    positions = joint_positions(table, blown)
    heights_m = {}
    for hub in hub_places(blown.vehicle):
        if hub.unit == "tractor":
            pose = body_pose(outputs, "tractor") @ model.pose(hub.hub, positions)
            heights_m[hub.hub] = pose[2, 3]
    loaded_m = {hub: outputs[f"tire_loaded_radius_{_first(hub, blown)}_m"] for hub in heights_m}
    offset_m = np.median([heights_m[hub] - loaded_m[hub] for hub in heights_m])
    for hub, height_m in heights_m.items():
        assert height_m - offset_m == pytest.approx(loaded_m[hub], abs=0.01)
    assert heights_m["steer_right"] - heights_m["steer_left"] > 0.05


def _first(hub: str, truck: Truck) -> str:
    return truck.vehicle.tires_of_hub(hub)[0]


@pytest.mark.parametrize("name", ["ferrari_250lm", "rigid_truck", f"{NAME}_thesis"])
def test_any_vehicle_has_a_description(name: str) -> None:
    vehicle = load_vehicle(name)
    model = RobotModel(urdf_of(vehicle))
    places = np.array([model.pose(hub, {})[:3, 3] for hub in vehicle.hubs])
    assert ((places[:, 1] > 0.5) == [hub.endswith("left") for hub in vehicle.hubs]).all()
    assert len({tuple(place) for place in places.round(3)}) == len(vehicle.hubs)
