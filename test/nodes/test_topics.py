"""Every topic of the interface: name, type, rate, frames, units."""

# ruff: noqa: ANN401 (fixtures and messages come from rclpy, which has no types for them)
from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import FluidPressure, Imu, JointState
from std_msgs.msg import Float64, String
from std_srvs.srv import Trigger
from visualization_msgs.msg import MarkerArray

from truck_blowout_sim import load_vehicle
from truck_blowout_sim.display.urdf import urdf_of

VEHICLE = load_vehicle("international_9400i_trailmobile")
UNITS = ("tractor", "trailer")
SPEED_MPS = 20.0
ATMOSPHERE_PA = 101325.0
PUBLISHED = {
    **{f"/truck/{unit}/odometry": "nav_msgs/msg/Odometry" for unit in UNITS},
    **{f"/truck/{unit}/imu": "sensor_msgs/msg/Imu" for unit in UNITS},
    **{f"/truck/{unit}/yaw_rate": "std_msgs/msg/Float64" for unit in UNITS},
    "/truck/joint_states": "sensor_msgs/msg/JointState",
    **{f"/truck/tires/{t}/pressure": "sensor_msgs/msg/FluidPressure" for t in VEHICLE.tires},
    **{f"/truck/brake_chambers/{h}/pressure": "sensor_msgs/msg/FluidPressure"
       for h in VEHICLE.hubs},
    "/truck/blowout": "std_msgs/msg/String",
    "/truck/blown_tires": "std_msgs/msg/String",
    "/truck/robot_description": "std_msgs/msg/String",
    "/truck/tire_forces": "visualization_msgs/msg/MarkerArray",
    "/clock": "rosgraph_msgs/msg/Clock",
    "/diagnostics": "diagnostic_msgs/msg/DiagnosticArray",
}  # fmt: skip
SUBSCRIBED = {
    "/truck/steering_wheel_angle",
    "/truck/road_wheel_angle",
    "/truck/throttle",
    "/truck/brake_pressure/steer",
    "/truck/brake_pressure/drive",
    "/truck/brake_pressure/trailer",
}


@pytest.fixture(scope="module")
def simulator(start: Any) -> Any:
    node = start("simulator", "--initial-speed-mps", SPEED_MPS)
    node.wait_for("ready")
    return node


@pytest.fixture
def fresh(simulator: Any, client: Any) -> Any:
    """The client, with the truck at its initial speed: it coasts meanwhile."""
    client.call(Trigger, "/truck/reset")
    return client


def stamp_s(message: Any) -> float:
    return message.header.stamp.sec + message.header.stamp.nanosec * 1e-9


def test_topics_of_the_interface_exist_with_their_types(simulator: Any, client: Any) -> None:
    def found() -> dict[str, str]:
        topics = client.node.get_topic_names_and_types()
        return {name: types[0] for name, types in topics}

    client.until(lambda: PUBLISHED.keys() <= found().keys(), what="all topics")
    assert {name: found()[name] for name in PUBLISHED} == PUBLISHED
    assert {name: found()[name] for name in SUBSCRIBED} == dict.fromkeys(
        SUBSCRIBED, "std_msgs/msg/Float64"
    )


# where the messages of other stacks are installed (docs/ros.md)
OF_ADAPTERS = {"/truck/ackermann_cmd", "/truck/simulate_steps/_action/feedback",
               "/truck/simulate_steps/_action/status"}  # fmt: skip


def test_nothing_undocumented_is_published_below_the_namespace(simulator: Any, client: Any) -> None:
    client.until(lambda: client.node.count_publishers("/truck/tractor/imu"), what="the simulator")
    names = {name for name, _ in client.node.get_topic_names_and_types()}
    ours = {name for name in names if name.startswith("/truck/")}
    extra = ours - PUBLISHED.keys() - SUBSCRIBED - OF_ADAPTERS
    assert extra == set()


@pytest.mark.parametrize("unit", UNITS)
def test_odometry_gives_pose_in_map_and_twist_in_the_unit(fresh: Any, unit: str) -> None:
    message = fresh.first(Odometry, f"/truck/{unit}/odometry")
    assert (message.header.frame_id, message.child_frame_id) == ("map", f"{unit}/base_link")
    assert message.twist.twist.linear.x == pytest.approx(SPEED_MPS, abs=2.0)
    turn = message.pose.pose.orientation
    assert math.hypot(turn.x, turn.y, turn.z, turn.w) == pytest.approx(1.0, abs=1e-9)
    variances = np.diag(message.pose.covariance.reshape(6, 6))
    assert (variances > 0).all()


@pytest.mark.parametrize("unit", UNITS)
def test_imu_reads_gravity_as_a_strapdown_instrument(
    simulator: Any, client: Any, unit: str
) -> None:
    message = client.first(Imu, f"/truck/{unit}/imu")
    assert message.header.frame_id == f"{unit}/base_link"
    assert message.linear_acceleration.z == pytest.approx(9.81, abs=0.1)
    assert message.orientation_covariance[0] >= 0.0


def test_yaw_rate_equals_the_imus(fresh: Any) -> None:
    wheel = fresh.talk(Float64, "/truck/steering_wheel_angle")
    rates = fresh.listen(Float64, "/truck/tractor/yaw_rate")
    imu = fresh.listen(Imu, "/truck/tractor/imu")

    def turning() -> bool:
        wheel.publish(Float64(data=1.0))
        return bool(imu) and imu[-1].angular_velocity.z > 0.03

    fresh.until(turning, what="a turn to the left")
    fresh.spin(0.3)
    fresh.call(Trigger, "/truck/reset")
    both = {one.data for one in rates} & {one.angular_velocity.z for one in imu}
    assert max(both, default=0.0) > 0.03


def test_joint_states_name_spin_steer_and_articulation(fresh: Any) -> None:
    message = fresh.first(JointState, "/truck/joint_states")
    wanted = {f"{hub}_spin" for hub in VEHICLE.hubs}
    wanted |= {"steer_left_steer", "steer_right_steer", "articulation"}
    assert wanted <= set(message.name)
    assert len(message.name) == len(message.position) == len(message.velocity)
    spin = dict(zip(message.name, message.velocity, strict=True))
    radius_m = SPEED_MPS / spin["steer_left_spin"]
    assert 0.4 < radius_m < 0.6


def test_pressures_are_absolute_and_say_whose_they_are(simulator: Any, client: Any) -> None:
    tire = client.first(FluidPressure, "/truck/tires/drive_1_left_inner/pressure")
    chamber = client.first(FluidPressure, "/truck/brake_chambers/trailer_2_right/pressure")
    assert tire.header.frame_id == "drive_1_left_inner"
    assert tire.fluid_pressure == pytest.approx(758e3 + ATMOSPHERE_PA, rel=0.02)
    assert chamber.header.frame_id == "trailer_2_right"
    assert chamber.fluid_pressure == pytest.approx(ATMOSPHERE_PA, abs=1.0)


def test_outputs_come_at_100_hz_of_simulation_time(simulator: Any, client: Any) -> None:
    heard = client.listen(Imu, "/truck/tractor/imu")
    clock = client.listen(Clock, "/clock")
    client.until(lambda: len(heard) > 100 and len(clock) > 100, what="a second of messages")
    steps = np.diff([stamp_s(message) for message in heard])
    assert np.allclose(steps, 0.01, atol=1e-9)
    times = [message.clock.sec + message.clock.nanosec * 1e-9 for message in clock]
    assert np.allclose(np.diff(times), 0.01, atol=1e-9)


def test_diagnostics_tell_pace_inputs_recorder_and_state(simulator: Any, client: Any) -> None:
    message = client.first(DiagnosticArray, "/diagnostics")
    names = {status.name.split(": ")[1] for status in message.status}
    assert names == {"pace", "inputs", "recorder", "state", "clock", "outputs"}
    pace = next(status for status in message.status if status.name.endswith("pace"))
    values = {pair.key: pair.value for pair in pace.values}
    assert {"real_time_factor", "lateness_worst_ms", "simulation_time_s"} <= values.keys()


def test_markers_show_one_arrow_a_tire(simulator: Any, client: Any) -> None:
    message = client.first(MarkerArray, "/truck/tire_forces")
    assert {marker.text for marker in message.markers} == set(VEHICLE.tires)
    weight_n = sum(20000.0 * (m.points[1].z - m.points[0].z) for m in message.markers)
    assert weight_n == pytest.approx(23600 * 9.81, rel=0.03)


def test_robot_description_is_there_for_a_late_joiner(simulator: Any, client: Any) -> None:
    text = client.first(String, "/truck/robot_description", client.latched).data
    assert text == urdf_of(VEHICLE)


def test_a_road_wheel_angle_steers_as_the_hand_wheel_does(fresh: Any) -> None:
    steer = fresh.talk(Float64, "/truck/road_wheel_angle")
    states = fresh.listen(JointState, "/truck/joint_states")

    def steered() -> bool:
        steer.publish(Float64(data=0.03))
        return len(states) > 200

    fresh.until(steered, what="two seconds")
    fresh.call(Trigger, "/truck/reset")
    last = [dict(zip(one.name, one.position, strict=True)) for one in states[100:200]]
    wheels_rad = [at["steer_left_steer"] / 2 + at["steer_right_steer"] / 2 for at in last]
    # the linkage gives up a third under load
    assert np.mean(wheels_rad) == pytest.approx(0.021, abs=0.005)


def test_blowout_event_reaches_a_late_joiner(simulator: Any, client: Any) -> None:
    client.call(Trigger, "/truck/blowout/trailer_2_right_outer")
    event = client.first(String, "/truck/blowout", client.latched)
    assert event.data == "trailer_2_right_outer"


def test_after_reset_nobody_is_told_of_whole_tires(simulator: Any, client: Any) -> None:
    early = client.listen(String, "/truck/blowout", client.latched)
    client.call(Trigger, "/truck/blowout/steer_left")
    client.until(lambda: "steer_left" in [one.data for one in early], what="the blowout")
    client.call(Trigger, "/truck/reset")
    late = client.listen(String, "/truck/blowout", client.latched)
    assert client.first(String, "/truck/blown_tires", client.latched).data == ""
    client.spin(0.5)
    assert late == []
    client.call(Trigger, "/truck/blowout/drive_1_left")
    client.until(lambda: len(late) == 2, what="the blowouts of this run")
    assert {one.data for one in late} == {"drive_1_left_outer", "drive_1_left_inner"}
    state = client.first(String, "/truck/blown_tires", client.latched).data
    assert set(state.split("+")) == {"drive_1_left_outer", "drive_1_left_inner"}
    assert [one.data for one in early[-2:]] == [one.data for one in late]
    client.call(Trigger, "/truck/reset")


def test_a_second_publisher_of_an_output_is_pointed_out_once(simulator: Any, client: Any) -> None:
    client.node.create_publisher(Imu, "/truck/tractor/imu", 10)
    # a node that DDS has just discovered may have no name yet
    words = simulator.wait_for(" publishes 1 of this node's outputs", 20.0)
    assert "/truck/tractor/imu" in words
    client.spin(2.5)
    assert simulator.output.count(" publishes 1 of this node's outputs") == 1
