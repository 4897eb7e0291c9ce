"""The player with a simulator: how it leaves it, logs of others, what it says while it waits."""

# ruff: noqa: ANN401 (fixtures and messages come from rclpy, which has no types for them)
from __future__ import annotations

import signal
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from nav_msgs.msg import Odometry
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
from std_msgs.msg import String
from std_srvs.srv import SetBool, Trigger

from truck_blowout_sim import Blowout, Recording, Series, read_recording, write_recording

TIMES_S = np.arange(0.0, 6.0, 0.01)
NORTHING_M, EASTING_M = 4_430_000.0, 327_000.0


@pytest.fixture(scope="module")
def bags(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("bags")


@pytest.fixture(scope="module")
def simulator(start: Any, bags: Path) -> Any:
    node = start("simulator", "--record-folder", bags, "--blowout-input")
    node.wait_for("ready")
    return node


def channels(**more: float) -> dict[str, Series]:
    values = {"steering_wheel_angle_rad": 0.0, "tractor_vx_mps": 15.0, **more}
    return {name: Series(TIMES_S, np.full(TIMES_S.size, value)) for name, value in values.items()}


def log(path: Path, **more: float) -> Path:
    write_recording(Recording("log", channels(**more), (Blowout(0.5, ("steer_left",)),)), path)
    return path


def runs(client: Any) -> bool:
    """Whether the simulator's time goes on."""
    return not client.call(Trigger, "/truck/step").success


def test_a_log_in_utm_coordinates_plays(
    simulator: Any, start: Any, client: Any, bags: Path
) -> None:
    path = log(bags / "utm.csv", tractor_x_m=EASTING_M, tractor_y_m=NORTHING_M)
    odometry = client.listen(Odometry, "/truck/tractor/odometry")
    player = start("player", path, "--playback-duration", 0.5)
    assert player.wait() == 0, player.output
    assert "refused" not in player.output
    client.until(lambda: odometry, what="odometry")
    assert abs(odometry[-1].pose.pose.position.y) < 1000.0
    assert runs(client)


def test_ctrl_c_ends_the_bag_that_the_player_began(
    simulator: Any, start: Any, client: Any, bags: Path
) -> None:
    path = log(bags / "long.csv")
    player = start("player", path, "--record-path", bags / "stopped")
    player.wait_for("steer_left blown")
    assert player.stop() == 0
    assert f"messages to {bags / 'stopped'}" in simulator.output
    assert read_recording(bags / "stopped").blowouts[0].tires == ("steer_left",)
    assert runs(client)


@pytest.mark.parametrize("first", ["resume", "play_next"])
def test_a_player_that_starts_paused_keeps_the_simulator_waiting(
    simulator: Any, start: Any, client: Any, bags: Path, first: str
) -> None:
    odometry = client.listen(Odometry, "/truck/tractor/odometry")
    player = start("player", log(bags / "waiting.csv"), "--start-paused")
    player.wait_for("simulator at 15.00 m/s")
    client.meet("/truck/player")
    client.spin(1.0)
    odometry.clear()
    client.spin(0.5)
    assert not odometry, "the truck drove on without the recording"
    assert client.call(Trigger, f"/truck/player/{first}").success
    client.until(lambda: len(odometry) > 10, what="the truck to drive")
    speed_mps = odometry[0].twist.twist.linear.x
    assert speed_mps == pytest.approx(15.0, abs=0.1), "it had not waited where it was put"
    assert player.stop() == 0
    assert runs(client)


def test_a_replay_from_behind_the_blowout_has_the_flat_tire_and_the_held_pedal(
    simulator: Any, start: Any, client: Any, bags: Path
) -> None:
    early_s = np.array([0.0, 0.4])
    pedal = {"throttle": Series(early_s, np.array([0.0, 0.6]))}
    path = bags / "behind.csv"
    blowout = (Blowout(0.5, ("steer_left",)),)
    write_recording(Recording("behind", {**channels(), **pedal}, blowout), path)
    player = start("player", path, "--start-offset", 2.0, "--playback-duration", 1.0,
                   "--record-path", bags / "replayed_behind")  # fmt: skip
    assert player.wait() == 0, player.output
    replayed = read_recording(bags / "replayed_behind")
    (blown,) = replayed.blowouts
    assert blown.tires == ("steer_left",)
    assert blown.time_s == pytest.approx(replayed["tractor_vx_mps"].time_s[0] - 1.5, abs=1e-6)
    assert not replayed["tire_pressure_steer_left_pa"].value.any()  # flat from the first sample on
    assert "steer_left burst 1.500 s before the start" in player.output
    assert replayed["throttle"].value.max() == pytest.approx(0.6)  # until its timeout
    assert runs(client)


def test_ctrl_c_while_the_player_prepares_is_a_quiet_end(
    start: Any, client: Any, bags: Path
) -> None:
    """A simulator that is ready, pauses, and then takes no parameters."""
    asked: list[str] = []

    def serve(name: str) -> None:
        def answer(_: Any, response: Any) -> Any:
            asked.append(name)
            response.success = True
            return response

        client.node.create_service(Trigger, f"/stand_in/{name}", answer)

    for name in ("ready", "pause", "resume"):
        serve(name)
    player = start("player", log(bags / "asked.csv"), "--ros-args", "-r", "__ns:=/stand_in")
    client.until(lambda: "pause" in asked, what="the player to prepare")
    client.spin(0.5)
    player.process.send_signal(signal.SIGINT)
    client.until(lambda: player.process.poll() is not None, what="its end")
    assert player.wait() == 0, player.output
    assert "stopped by SIGINT" in player.output
    assert "did not answer" not in player.output
    assert asked[-1] == "resume"


def test_a_simulator_at_another_speed_than_the_recording_is_told(
    simulator: Any, start: Any, client: Any, bags: Path
) -> None:
    def run_at(factor: float) -> None:
        value = ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=factor)
        request = SetParameters.Request(
            parameters=[Parameter(name="real_time_factor", value=value)]
        )
        client.call(SetParameters, "/truck/simulator/set_parameters", request)

    path = log(bags / "slow.csv")
    run_at(0.2)
    by_wall = start("player", path, "--playback-duration", 2.5)
    assert by_wall.wait() == 0, by_wall.output
    assert "commands came at the wrong instants" in by_wall.output
    by_clock = start("player", path, "--playback-duration", 0.5,
                     "--ros-args", "-p", "use_sim_time:=true")  # fmt: skip
    assert by_clock.wait() == 0, by_clock.output
    assert "wrong instants" not in by_clock.output
    run_at(1.0)


def test_a_player_that_cannot_record_does_not_reset_the_simulator(
    simulator: Any, start: Any, client: Any, bags: Path
) -> None:
    client.call(SetBool, "/truck/record", SetBool.Request(data=True))
    try:
        player = start("player", log(bags / "busy.csv"), "--record-path", bags / "second")
        assert player.wait() == 2
        assert "the simulator is already recording" in player.output
        assert "simulator at" not in player.output
    finally:
        client.call(SetBool, "/truck/record", SetBool.Request(data=False))


def test_a_bag_elsewhere_is_refused_and_the_simulator_left_running(
    simulator: Any, start: Any, client: Any, bags: Path, tmp_path: Path
) -> None:
    player = start("player", log(bags / "other.csv"), "--record-path", tmp_path / "outside")
    assert player.wait() == 2
    assert "record_folder" in player.output
    assert runs(client)


def test_a_mapping_file_says_what_is_what(
    simulator: Any, start: Any, client: Any, bags: Path
) -> None:
    rows = "\n".join(f"{t:.2f},{10.0 * t:.3f},54.0" for t in TIMES_S[:100])
    (bags / "theirs.csv").write_text(f"Time,SteerAngle,Speed\n{rows}\n")
    (bags / "map.yaml").write_text(
        "time: {from: Time, unit: s}\nchannels:\n"
        "  steering_wheel_angle_rad: {from: SteerAngle, unit: deg, sign: -1}\n"
        "  tractor_vx_mps: {from: Speed, unit: km/h}\n"
    )
    player = start("player", bags / "theirs.csv", "--map", bags / "map.yaml",
                   "--blow", "steer_left@0.4")  # fmt: skip
    assert player.wait() == 0, player.output
    assert "simulator at 15.00 m/s" in player.output
    assert "steer_left" in player.output
    refused = start("player", bags / "theirs.csv", "--map", bags / "map.yaml", "--remap", "/a:=b")
    assert refused.wait() == 2
    assert "remap and map are both given" in refused.output


def test_a_tire_named_on_blowout_is_blown_once(simulator: Any, client: Any) -> None:
    client.call(Trigger, "/truck/reset")
    bag = client.node.create_publisher(String, "/truck/blowout", client.latched)
    client.until(lambda: bag.get_subscription_count() > 0, what="the simulator's ear")
    bag.publish(String(data="trailer_1_left_outer"))
    simulator.wait_for("trailer_1_left_outer blown at")
    client.call(Trigger, "/truck/reset")
    client.spin(0.5)
    assert client.first(String, "/truck/blown_tires", client.latched).data == ""
    assert simulator.output.count("trailer_1_left_outer blown at") == 1


def test_without_a_clock_the_player_says_what_it_waits_for(start: Any, bags: Path) -> None:
    words = ("--wait-for-simulator-s", 0, "--ros-args", "-p", "use_sim_time:=true",
             "-r", "/clock:=/nobodys_clock")  # fmt: skip
    player = start("player", log(bags / "waits.csv"), *words)
    player.wait_for("nobody publishes /clock", 20.0)
    assert player.stop() == 0
