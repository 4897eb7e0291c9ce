"""The bag inside the simulator: complete, in simulation time, safe against kills and full disks."""

# ruff: noqa: ANN401 (fixtures and messages come from rclpy, which has no types for them)
from __future__ import annotations

import resource
import signal
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from diagnostic_msgs.msg import DiagnosticArray
from mcap.reader import make_reader
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import FluidPressure
from std_msgs.msg import Float64
from std_srvs.srv import SetBool, Trigger

from truck_blowout_sim import read_recording
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.nodes.recorder import Recorder, check_inside


def running(start: Any, path: Path, *words: object, **options: Any) -> Any:
    node = start("simulator", "--record-path", path, "--initial-speed-mps", 20, *words, **options)
    node.wait_for("ready")
    return node


def applied(reports: list[Any]) -> float:
    """The hand-wheel angle that the last report of the diagnostics says is applied."""
    if not reports:
        return -1.0
    inputs = next(status for status in reports[-1].status if status.name.endswith("inputs"))
    values = {pair.key: pair.value for pair in inputs.values}
    return float(values["steering_wheel_angle applied"])


def moved(report: Any) -> bool:
    """Whether the report of the diagnostics is of a time after step 0."""
    return bool(report.header.stamp.sec or report.header.stamp.nanosec)


def simulated_s(node: Any) -> float:
    ended = node.wait_for("of simulation time").rsplit("ended at ", 1)[1]
    return float(ended.split()[0])


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_ends_the_node_cleanly_with_a_readable_bag(
    start: Any, tmp_path: Path, number: int
) -> None:
    node = running(start, tmp_path / "bag")
    time.sleep(1.0)  # some of it is recorded
    node.process.send_signal(number)
    node.process.send_signal(number)  # under a launcher Ctrl-C arrives twice
    assert node.wait() == 0
    assert "Traceback" not in node.output
    bag = read_recording(tmp_path / "bag")
    assert bag.end_s == pytest.approx(simulated_s(node), abs=0.011)


def test_the_bag_is_in_simulation_time_from_step_0_and_complete(
    start: Any, client: Any, tmp_path: Path
) -> None:
    node = running(start, tmp_path / "bag", "--input-timeout-s", 0, "--diagnostics-rate-hz", 10)
    wheel = client.talk(Float64, "/truck/steering_wheel_angle")
    reports = client.listen(DiagnosticArray, "/diagnostics")
    # a command that arrives before step 0 would hold from step 0, as it should
    client.until(lambda: reports and moved(reports[-1]), what="a first step")
    sent = [0.1, 0.2, 0.3, 0.25]
    for value in sent:
        wheel.publish(Float64(data=value))
        client.until(lambda value=value: applied(reports) == value, what=f"{value} rad")
    client.call(Trigger, "/truck/blowout/trailer_1_left_outer")
    pressure = client.listen(FluidPressure, "/truck/tires/trailer_1_left_outer/pressure")
    client.until(lambda: pressure and pressure[-1].fluid_pressure < 300e3, what="a flat tire")
    assert node.stop() == 0
    bag = read_recording(tmp_path / "bag")
    times = bag["tractor_vx_mps"].time_s
    assert times[0] == 0.0
    assert np.allclose(np.diff(times), 0.01, atol=1e-9)
    steering = bag["steering_wheel_angle_rad"]
    assert steering.value[0] == 0.0
    assert list(steering.value) == [0.0, *sent]
    assert [blowout.tires for blowout in bag.blowouts] == [("trailer_1_left_outer",)]
    flat = bag["tire_pressure_trailer_1_left_outer_pa"]
    assert flat.value[-1] < 0.5 * flat.value[0]


def test_topics_are_absolute_and_metadata_carry_qos(start: Any, tmp_path: Path) -> None:
    node = running(start, tmp_path / "bag", "--ros-args", "-r", "throttle:=pedal")
    assert node.stop() == 0
    metadata = yaml.safe_load((tmp_path / "bag" / "metadata.yaml").read_text())
    topics = metadata["rosbag2_bagfile_information"]["topics_with_message_count"]
    names = {topic["topic_metadata"]["name"] for topic in topics}
    assert {"/truck/tractor/odometry", "/truck/joint_states", "/truck/pedal"} <= names
    assert all(topic["topic_metadata"]["offered_qos_profiles"] for topic in topics)
    (data,) = (tmp_path / "bag").glob("*.mcap")
    with data.open("rb") as stream:
        summary = make_reader(stream).get_summary()
    assert summary is not None
    assert {chunk.compression for chunk in summary.chunk_indexes} == {"zstd"}


def test_a_kill_loses_at_most_the_last_second(start: Any, client: Any, tmp_path: Path) -> None:
    node = running(start, tmp_path / "bag")
    clock = client.listen(Clock, "/clock")
    client.until(lambda: len(clock) > 250, what="2.5 s")
    node.kill()
    client.spin(0.1)
    killed_s = clock[-1].clock.sec + clock[-1].clock.nanosec * 1e-9
    bag = read_recording(tmp_path / "bag")
    assert bag["tractor_vx_mps"].time_s[0] == 0.0
    assert bag.end_s > killed_s - 1.0


def test_a_full_disk_ends_the_bag_and_not_the_simulation(
    start: Any, client: Any, tmp_path: Path
) -> None:
    def small_files() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (150_000, 150_000))

    node = running(start, tmp_path / "bag", "--diagnostics-rate-hz", 5, preexec_fn=small_files)
    node.wait_for("cannot write")
    clock = client.listen(Clock, "/clock")
    client.until(lambda: len(clock) > 50, what="time going on")
    report = client.first(DiagnosticArray, "/diagnostics")
    recorder = next(status for status in report.status if status.name.endswith("recorder"))
    assert "cannot write" in recorder.message
    assert node.stop() == 0
    bag = read_recording(tmp_path / "bag")
    assert len(bag["tractor_vx_mps"]) > 10


def test_a_path_that_cannot_be_written_is_said_and_the_truck_drives_on(
    start: Any, client: Any, tmp_path: Path
) -> None:
    (tmp_path / "file").write_text("")
    node = start("simulator", "--record-path", tmp_path / "file" / "bag")
    node.wait_for("ready")
    assert "cannot record" in node.output
    assert node.stop() == 0


def test_a_second_bag_gets_a_number(start: Any, client: Any, tmp_path: Path) -> None:
    node = running(start, tmp_path / "bag")
    clock = client.listen(Clock, "/clock")
    client.until(lambda: len(clock) > 10, what="0.1 s")
    assert client.call(SetBool, "/truck/record", SetBool.Request(data=False)).success
    again = client.call(SetBool, "/truck/record", SetBool.Request(data=True))
    assert again.message.endswith("bag_2")
    twice = client.call(SetBool, "/truck/record", SetBool.Request(data=True))
    assert twice.success
    assert "already recording" in twice.message
    # whoever asks for a bag of his own is not told that he has it
    other = ParameterValue(type=ParameterType.PARAMETER_STRING, string_value="other")
    asked = SetParameters.Request(parameters=[Parameter(name="record_path", value=other)])
    client.call(SetParameters, "/truck/simulator/set_parameters", asked)
    refused = client.call(SetBool, "/truck/record", SetBool.Request(data=True))
    assert not refused.success
    assert "stop it first" in refused.message
    assert node.stop() == 0
    assert read_recording(tmp_path / "bag_2").start_s > 0.0


def test_the_path_can_be_set_while_running(start: Any, client: Any, tmp_path: Path) -> None:
    node = start("simulator", "--record-folder", tmp_path)
    node.wait_for("ready")
    clock = client.listen(Clock, "/clock")
    client.until(lambda: clock, what="/clock")
    value = ParameterValue(
        type=ParameterType.PARAMETER_STRING, string_value=str(tmp_path / "one.mcap")
    )
    request = SetParameters.Request(parameters=[Parameter(name="record_path", value=value)])
    client.call(SetParameters, "/truck/simulator/set_parameters", request)
    client.call(SetBool, "/truck/record", SetBool.Request(data=True))
    heard = len(clock)
    client.until(lambda: len(clock) > heard + 30, what="0.3 s")
    stopped = client.call(SetBool, "/truck/record", SetBool.Request(data=False))
    assert "recorded" in stopped.message
    assert len(read_recording(tmp_path / "one.mcap")["tractor_vx_mps"]) > 10
    assert node.stop() == 0


@pytest.mark.parametrize("wanted", [".", "..", "z" * 300, "loop/bag"])
def test_a_path_that_leads_out_or_nowhere_is_refused(wanted: str, tmp_path: Path) -> None:
    """The folder itself would get a neighbor, `folder_2`; some paths are errors of the disk."""
    folder = tmp_path / "folder"
    folder.mkdir()
    (folder / "taken").touch()
    (folder / "loop").symlink_to(folder / "loop")
    with pytest.raises(InputError, match="a path under record_folder"):
        check_inside(folder, wanted)
    said: list[str] = []
    recorder = Recorder(lambda level, words: said.append(words), {}, folder)
    if wanted.startswith("z"):
        assert not recorder.start(wanted)[0]
        assert said[-1].startswith("cannot record")
