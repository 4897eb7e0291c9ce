"""The lane keeper holds the truck in its lane through a blowout, by topics alone."""

# ruff: noqa: ANN401 (fixtures and messages come from rclpy, which has no types for them)
from __future__ import annotations

from typing import Any

import pytest
from nav_msgs.msg import Odometry
from std_msgs.msg import Float64
from std_srvs.srv import Trigger

from truck_blowout_sim import InitialState, Inputs, Truck, load_vehicle
from truck_blowout_sim.nodes.adapters.longitudinal import speed_controller
from truck_blowout_sim.nodes.lane_control import CruiseControl, Lane, LaneKeeper

SPEED_MPS = 22.0
LANE_HALF_M = 1.85  # a 3.7 m lane
TRUCK_HALF_M = 1.3


@pytest.mark.parametrize("tire", ["steer_left", "steer_right", "drive_1_left_outer"])
def test_the_law_keeps_the_lane(tire: str) -> None:
    vehicle = load_vehicle("international_9400i_trailmobile")
    truck = Truck(vehicle, initial=InitialState(speed_mps=SPEED_MPS))
    keeper, cruise = LaneKeeper(Lane(0.0, 0.0, 0.0)), CruiseControl(SPEED_MPS)
    offsets_m = []
    for tick in range(1500):
        now = truck.outputs()
        pose = now["tractor_x_m"], now["tractor_y_m"], now["tractor_yaw_rad"]
        motion = now["tractor_vx_mps"], now["tractor_vy_mps"], now["tractor_yaw_rate_radps"]
        wheel_rad = keeper.update(pose, *motion, elapsed_s=0.01)
        throttle = cruise.update(now["tractor_vx_mps"], 0.01) if tick < 500 else 0.0
        truck.advance(Inputs(wheel_rad, throttle), 10)
        if tick == 500:
            truck.blow(tire)
        offsets_m.append(abs(now["tractor_y_m"]))
    # the widest excursion may cross a lane marking for a moment, the end may not
    assert max(offsets_m) < 1.2
    assert offsets_m[-1] < LANE_HALF_M - TRUCK_HALF_M


def test_without_steering_the_truck_leaves_the_lane() -> None:
    vehicle = load_vehicle("international_9400i_trailmobile")
    truck = Truck(vehicle, initial=InitialState(speed_mps=SPEED_MPS))
    truck.blow("steer_left")
    truck.advance(Inputs(), 8000)
    assert abs(truck.outputs()["tractor_y_m"]) > LANE_HALF_M


def test_lane_offset_and_heading_follow_the_lane() -> None:
    lane = Lane(1.0, 2.0, 1.5707963267948966)
    offset_m, heading = lane.errors(0.0, 5.0, 1.6707963267948966)
    assert offset_m == pytest.approx(1.0)
    assert heading == pytest.approx(0.1)


def test_speed_controller_reaches_and_holds_a_speed() -> None:
    vehicle = load_vehicle("international_9400i_trailmobile")
    controller = speed_controller(vehicle)
    truck = Truck(vehicle, initial=InitialState(speed_mps=15.0))
    for wanted_mps, duration_s in ((18.0, 30.0), (12.0, 15.0)):
        for _ in range(round(duration_s / 0.05)):
            speed = truck.outputs()["tractor_vx_mps"]
            throttle, brake_pa = controller.pedals(speed, wanted_mps)
            truck.advance(Inputs(0.0, throttle, brake_pa, brake_pa, brake_pa), 50)
        assert truck.outputs()["tractor_vx_mps"] == pytest.approx(wanted_mps, abs=0.5)


def test_the_node_keeps_the_lane_over_dds(start: Any, client: Any) -> None:
    # at half of real time a machine that is busy makes the driver no worse
    slowly = ("--start-paused", "--real-time-factor", 0.5)
    simulator = start("simulator", "--initial-speed-mps", SPEED_MPS, *slowly)
    keeper = start("lane_keeper", "--speed-mps", SPEED_MPS)
    simulator.wait_for("ready")
    keeper.wait_for("ready")
    odometry = client.listen(Odometry, "/truck/tractor/odometry")
    client.until(
        lambda: client.node.count_publishers("/truck/steering_wheel_angle"), what="lane keeper"
    )
    client.meet("/truck/simulator")
    client.call(Trigger, "/truck/resume")

    def driven_m() -> float:
        return odometry[-1].pose.pose.position.x if odometry else 0.0

    client.until(lambda: driven_m() > 60.0, 60.0, "60 m")
    client.call(Trigger, "/truck/blowout/steer_left")
    client.until(lambda: driven_m() > 220.0, 120.0, "220 m")
    offsets_m = [abs(message.pose.pose.position.y) for message in odometry]
    assert max(offsets_m) < 1.5
    assert offsets_m[-1] < LANE_HALF_M - TRUCK_HALF_M
    keeper.wait_for("blown: steer_left")
    _is_put_back(client, keeper)
    assert keeper.stop() == 0
    assert simulator.stop() == 0


def _is_put_back(client: Any, keeper: Any) -> None:
    """After a reset the driver keeps the speed again: no tire is blown any more."""
    throttle = client.listen(Float64, "/truck/throttle")
    client.until(lambda: throttle and throttle[-1].data == 0.0, what="the foot off the throttle")
    client.call(Trigger, "/truck/reset")
    keeper.wait_for("beginning again", 20.0)
    client.until(lambda: throttle[-1].data > 0.0, 20.0, "the foot on the throttle")
