"""Blowouts on call, pause, resume, step, reset."""

# ruff: noqa: ANN401 (fixtures and messages come from rclpy, which has no types for them)
from __future__ import annotations

import re
from typing import Any

import pytest
from nav_msgs.msg import Odometry
from sensor_msgs.msg import FluidPressure
from std_msgs.msg import Float64, String
from std_srvs.srv import Trigger

from truck_blowout_sim import load_vehicle

VEHICLE = load_vehicle("international_9400i_trailmobile")
PERIOD_S = 0.01


@pytest.fixture(scope="module")
def simulator(start: Any) -> Any:
    node = start("simulator", "--initial-speed-mps", 22)
    node.wait_for("ready")
    return node


@pytest.fixture
def running(simulator: Any, client: Any) -> Any:
    """The client, with the simulator as at its start."""
    client.call(Trigger, "/truck/reset")
    client.call(Trigger, "/truck/resume")
    return client


def stamp_s(message: Any) -> float:
    return message.header.stamp.sec + message.header.stamp.nanosec * 1e-9


def said_s(message: str) -> float:
    found = re.search(r"at ([0-9.]+) s", message)
    assert found, message
    return float(found[1])


def test_every_tire_and_every_dual_hub_has_a_service(simulator: Any, client: Any) -> None:
    wanted = {f"/truck/blowout/{part}" for part in (*VEHICLE.tires, *VEHICLE.hubs)}
    wanted |= {f"/truck/{name}" for name in ("pause", "resume", "step", "reset")}

    def served() -> dict[str, list[str]]:
        return dict(client.node.get_service_names_and_types())

    client.until(lambda: wanted <= served().keys(), what="all services")
    assert {tuple(served()[name]) for name in wanted} == {("std_srvs/srv/Trigger",)}
    assert served()["/truck/record"] == ["std_srvs/srv/SetBool"]


def test_blowing_a_tire_twice_succeeds_and_says_so(running: Any) -> None:
    events = running.listen(String, "/truck/blowout", running.latched)
    running.spin(0.3)
    events.clear()
    first = running.call(Trigger, "/truck/blowout/steer_left")
    second = running.call(Trigger, "/truck/blowout/steer_left")
    running.spin(0.2)
    assert first.success
    assert second.success
    assert first.message.startswith("steer_left blown at")
    assert "already blown" in second.message
    assert said_s(second.message) == said_s(first.message)
    assert [event.data for event in events] == ["steer_left"]


def test_blowing_a_hub_blows_both_duals_and_names_the_one_already_flat(running: Any) -> None:
    running.call(Trigger, "/truck/blowout/drive_2_right_inner")
    reply = running.call(Trigger, "/truck/blowout/drive_2_right")
    assert reply.success
    assert "drive_2_right_outer blown at" in reply.message
    assert "drive_2_right_inner was already blown" in reply.message


def test_pressure_drops_within_two_periods_of_the_call(running: Any) -> None:
    heard = running.listen(FluidPressure, "/truck/tires/steer_left/pressure")
    running.until(lambda: len(heard) > 5, what="pressure")
    full_pa = heard[-1].fluid_pressure
    before_s = stamp_s(heard[-1])
    blown_s = said_s(running.call(Trigger, "/truck/blowout/steer_left").message)
    running.until(lambda: heard[-1].fluid_pressure < 0.9 * full_pa, what="a drop")
    dropped_s = next(stamp_s(m) for m in heard if m.fluid_pressure < full_pa - 1000.0)
    assert blown_s >= before_s
    assert dropped_s - blown_s <= 2 * PERIOD_S


def test_pause_stops_time_and_resume_continues_it(running: Any) -> None:
    heard = running.listen(Odometry, "/truck/tractor/odometry")
    running.until(lambda: heard, what="odometry")
    running.call(Trigger, "/truck/pause")
    running.spin(0.2)
    at_pause = stamp_s(heard[-1])
    running.spin(0.5)
    assert stamp_s(heard[-1]) == at_pause
    running.call(Trigger, "/truck/resume")
    running.until(lambda: stamp_s(heard[-1]) > at_pause + 0.1, what="time")
    later = [stamp_s(m) for m in heard if stamp_s(m) > at_pause]
    assert later[0] == pytest.approx(at_pause + PERIOD_S, abs=1e-9)


def test_step_advances_exactly_one_period_and_only_while_paused(running: Any) -> None:
    refused = running.call(Trigger, "/truck/step")
    assert not refused.success
    running.call(Trigger, "/truck/pause")
    heard = running.listen(Odometry, "/truck/tractor/odometry")
    running.until(lambda: running.node.count_publishers("/truck/tractor/odometry"), what="match")
    running.spin(0.3)
    heard.clear()
    times = []
    for _ in range(3):
        reply = running.call(Trigger, "/truck/step")
        assert reply.success
        times.append(float(reply.message.split()[2]))
    running.until(lambda: len(heard) == 3, what="three messages")
    running.spin(0.2)
    assert [stamp_s(message) for message in heard] == pytest.approx(times, abs=1e-9)
    assert times[2] - times[0] == pytest.approx(2 * PERIOD_S, abs=1e-9)


def test_reset_restores_speed_place_and_every_tire_but_not_time(running: Any) -> None:
    running.call(Trigger, "/truck/blowout/steer_left")
    running.spin(1.0)
    before = running.first(Odometry, "/truck/tractor/odometry")
    running.call(Trigger, "/truck/pause")
    reply = running.call(Trigger, "/truck/reset")
    assert "time goes on" in reply.message
    odometry = running.listen(Odometry, "/truck/tractor/odometry")
    pressure = running.listen(FluidPressure, "/truck/tires/steer_left/pressure")
    running.spin(0.3)
    running.call(Trigger, "/truck/step")
    running.until(lambda: odometry and pressure, what="outputs")
    assert abs(odometry[-1].pose.pose.position.x) < 0.5
    assert odometry[-1].twist.twist.linear.x == pytest.approx(22.0, abs=0.05)
    assert stamp_s(odometry[-1]) > stamp_s(before)
    assert pressure[-1].fluid_pressure > 800e3
    again = running.call(Trigger, "/truck/blowout/steer_left")
    assert "already" not in again.message


def test_steering_left_turns_left(running: Any) -> None:
    wheel = running.talk(Float64, "/truck/steering_wheel_angle")
    rate = running.listen(Float64, "/truck/tractor/yaw_rate")
    for _ in range(40):
        wheel.publish(Float64(data=1.0))
        running.spin(0.05)
    assert rate[-1].data > 0.02


def test_braking_slows_down(running: Any) -> None:
    speed = running.listen(Odometry, "/truck/tractor/odometry")
    pedals = [
        running.talk(Float64, f"/truck/brake_pressure/{circuit}")
        for circuit in ("steer", "drive", "trailer")
    ]
    running.until(lambda: speed, what="odometry")
    start_mps = speed[-1].twist.twist.linear.x
    for _ in range(40):
        for pedal in pedals:
            pedal.publish(Float64(data=400e3))
        running.spin(0.05)
    assert speed[-1].twist.twist.linear.x < start_mps - 3.0
