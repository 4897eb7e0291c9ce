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


def paused_s(client: Any, odometry: list[Any]) -> float:
    """Pause, and hear everything up to then; returns the simulated time."""
    now_s = said_s(client.call(Trigger, "/truck/pause").message)
    client.until(lambda: odometry and abs(stamp_s(odometry[-1]) - now_s) < 1e-6, what="the last")
    return now_s


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
    first = running.call(Trigger, "/truck/blowout/trailer_1_right_inner")
    second = running.call(Trigger, "/truck/blowout/trailer_1_right_inner")
    # a last one, so that it is known when all have been heard
    running.call(Trigger, "/truck/blowout/trailer_1_left_inner")
    running.until(lambda: any(e.data == "trailer_1_left_inner" for e in events), what="events")
    names = [event.data for event in events]
    assert first.success
    assert second.success
    assert first.message.startswith("trailer_1_right_inner blown at")
    assert "already blown" in second.message
    assert said_s(second.message) == said_s(first.message)
    assert names.count("trailer_1_right_inner") == 1


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
    assert blown_s >= before_s - 1e-6
    assert dropped_s - blown_s <= 2 * PERIOD_S + 1e-6


def test_pause_stops_time_and_resume_continues_it(running: Any) -> None:
    heard = running.listen(Odometry, "/truck/tractor/odometry")
    running.until(lambda: heard, what="odometry")
    at_pause = paused_s(running, heard)
    running.spin(0.5)
    assert stamp_s(heard[-1]) == at_pause
    running.call(Trigger, "/truck/resume")
    running.until(lambda: stamp_s(heard[-1]) > at_pause + 0.1, what="time")
    later = [stamp_s(m) for m in heard if stamp_s(m) > at_pause]
    assert later[0] == pytest.approx(at_pause + PERIOD_S, abs=1e-9)


def test_step_advances_exactly_one_period_and_only_while_paused(running: Any) -> None:
    refused = running.call(Trigger, "/truck/step")
    assert not refused.success
    heard = running.listen(Odometry, "/truck/tractor/odometry")
    running.until(lambda: heard, what="odometry")
    paused_s(running, heard)
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
    odometry = running.listen(Odometry, "/truck/tractor/odometry")
    pressure = running.listen(FluidPressure, "/truck/tires/steer_left/pressure")
    running.call(Trigger, "/truck/blowout/steer_left")
    running.until(lambda: pressure and pressure[-1].fluid_pressure < 300e3, what="a flat tire")
    running.until(lambda: odometry and odometry[-1].pose.pose.position.x > 10.0, what="10 m")
    before = odometry[-1]
    paused_s(running, odometry)
    reply = running.call(Trigger, "/truck/reset")
    assert "time goes on" in reply.message
    reset_s = said_s(reply.message)
    running.call(Trigger, "/truck/step")
    running.until(lambda: stamp_s(odometry[-1]) > reset_s + 0.005, what="a step")
    running.until(lambda: stamp_s(pressure[-1]) > reset_s + 0.005, what="a step")
    assert abs(odometry[-1].pose.pose.position.x) < 0.5
    assert odometry[-1].twist.twist.linear.x == pytest.approx(22.0, abs=0.05)
    assert stamp_s(odometry[-1]) > stamp_s(before)
    assert pressure[-1].fluid_pressure > 800e3
    again = running.call(Trigger, "/truck/blowout/steer_left")
    assert "already" not in again.message


def test_steering_left_turns_left(running: Any) -> None:
    wheel = running.talk(Float64, "/truck/steering_wheel_angle")
    heard = running.listen(Odometry, "/truck/tractor/odometry")

    def turned() -> bool:
        wheel.publish(Float64(data=1.0))
        return bool(heard) and abs(heard[-1].pose.pose.orientation.z) > 0.1

    running.until(turned, what="a turn")
    assert heard[-1].pose.pose.orientation.z > 0.0
    assert heard[-1].pose.pose.position.y > 1.0
    assert heard[-1].twist.twist.angular.z > 0.02


def test_braking_slows_down(running: Any) -> None:
    speed = running.listen(Odometry, "/truck/tractor/odometry")
    pedals = [
        running.talk(Float64, f"/truck/brake_pressure/{circuit}")
        for circuit in ("steer", "drive", "trailer")
    ]
    running.until(lambda: speed, what="odometry")
    start = speed[-1]

    def lost_mps() -> float:
        return start.twist.twist.linear.x - speed[-1].twist.twist.linear.x

    def braked() -> bool:
        for pedal in pedals:
            pedal.publish(Float64(data=400e3))
        return lost_mps() > 3.0 or stamp_s(speed[-1]) > stamp_s(start) + 5.0

    running.until(braked, what="3 m/s less, or five seconds")
    assert lost_mps() > 3.0  # coasting it loses a third of that
