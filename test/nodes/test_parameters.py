"""Parameters from YAML and the command line, remapping, bad values, help."""

# ruff: noqa: ANN401 (fixtures and messages come from rclpy, which has no types for them)
from __future__ import annotations

import re
import signal
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from nav_msgs.msg import Odometry
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import DescribeParameters, GetParameters, SetParameters
from sensor_msgs.msg import FluidPressure
from std_msgs.msg import Float64
from std_srvs.srv import Trigger

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.nodes import player_parameters, urdf
from truck_blowout_sim.nodes.lane_keeper_node import SPECS as LANE_KEEPER_SPECS
from truck_blowout_sim.nodes.parameters import Spec, markdown
from truck_blowout_sim.nodes.simulator_parameters import PLAIN_SPECS, SPECS, inputs_markdown

ROOT = Path(__file__).resolve().parents[2]


def double(value: float) -> ParameterValue:
    return ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=value)


def stamp_s(message: Any) -> float:
    return message.header.stamp.sec + message.header.stamp.nanosec * 1e-9


def test_yaml_gives_parameters_whole_numbers_too(start: Any, client: Any, tmp_path: Path) -> None:
    path = tmp_path / "parameters.yaml"
    path.write_text(
        "/**:\n  ros__parameters:\n    initial_speed_mps: 15\n    publish_rate_hz: 50\n"
        "    rates:\n      tire_pressure_hz: 10.0\n"
    )
    node = start("simulator", "--ros-args", "--params-file", path)
    node.wait_for("ready")
    odometry = client.listen(Odometry, "/truck/tractor/odometry")
    pressure = client.listen(FluidPressure, "/truck/tires/steer_left/pressure")
    client.until(lambda: len(pressure) > 10 and len(odometry) > 10, what="messages")
    assert np.diff([stamp_s(one) for one in odometry]).max() == pytest.approx(0.02, abs=1e-9)
    assert np.diff([stamp_s(one) for one in pressure]).max() == pytest.approx(0.1, abs=1e-9)
    assert odometry[0].twist.twist.linear.x == pytest.approx(15.0, abs=1.0)
    assert node.stop() == 0


def test_a_vehicle_file_of_ones_own(start: Any, client: Any, tmp_path: Path) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text(
        "extends: international_9400i_trailmobile\n"
        'steering:\n  ratio: {value: 20, source: "counted turns"}\n'
    )
    node = start("simulator", "--vehicle", path)
    node.wait_for("mine: 10 hubs, 18 tires")
    assert node.stop() == 0


def test_a_car_has_no_trailer_topics(start: Any, client: Any) -> None:
    node = start("simulator", "--vehicle", "ferrari_250lm", "--initial-speed-mps", 20)
    node.wait_for("4 hubs, 4 tires")
    client.first(Odometry, "/truck/tractor/odometry")
    names = {name for name, _ in client.node.get_topic_names_and_types()}
    assert not [name for name in names if "trailer/" in name and "brake" not in name]
    assert node.stop() == 0


def test_reset_names_the_tires_that_begin_flat(start: Any, client: Any) -> None:
    node = start("simulator", "--initial-flat", "steer_left@2.0")
    node.wait_for("; ready")
    reply = client.call(Trigger, "/truck/reset")
    assert reply.message.startswith("initial state, steer_left flat; simulation time goes on")
    assert node.stop() == 0


@pytest.mark.parametrize("name", ["simulator.yaml", "slow_network.yaml"])
def test_shipped_yaml_is_accepted(start: Any, name: str) -> None:
    node = start("simulator", "--ros-args", "--params-file", ROOT / "config" / "nodes" / name)
    node.wait_for("ready")
    assert node.stop() == 0


def test_names_can_be_remapped(start: Any, client: Any) -> None:
    node = start(
        "simulator", "--ros-args", "-r", "__ns:=/other", "-r", "__node:=sim",
        "-r", "steering_wheel_angle:=/hand_wheel", "-r", "/clock:=/other/clock",
        "-r", "blowout/steer_left:=bang",
    )  # fmt: skip
    node.wait_for("ready")
    client.first(Odometry, "/other/tractor/odometry")
    client.talk(Float64, "/hand_wheel", node="/other/sim")
    assert client.call(Trigger, "/other/bang").success
    assert client.call(GetParameters, "/other/sim/get_parameters") is not None
    assert client.node.count_publishers("/clock") == 0
    assert node.stop() == 0


def test_parameters_describe_themselves_and_keep_their_ranges(start: Any, client: Any) -> None:
    node = start("simulator")
    node.wait_for("ready")
    names = [spec.name for spec in SPECS]
    described = client.call(
        DescribeParameters, "/truck/simulator/describe_parameters",
        DescribeParameters.Request(names=names),
    )  # fmt: skip
    for spec, descriptor in zip(SPECS, described.descriptors, strict=True):
        assert spec.text in descriptor.description
        assert spec.unit in descriptor.description
        assert descriptor.read_only is not spec.live
        for bounds in descriptor.floating_point_range:
            assert max(spec.low, -1e300) == max(bounds.from_value, -1e300)
            assert min(spec.high, 1e300) == min(bounds.to_value, 1e300)
    refused = client.call(
        SetParameters, "/truck/simulator/set_parameters",
        SetParameters.Request(parameters=[
            Parameter(name="real_time_factor", value=double(-1.0)),
            Parameter(name="step_s", value=double(0.002)),
            Parameter(name="inputs.brake_pressure_drive_pa.safe_value", value=double(2.0e6)),
        ]),
    )  # fmt: skip
    assert [result.successful for result in refused.results] == [False, False, False]
    assert node.stop() == 0


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--vehicle", "no_such_truck"), "no_such_truck"),
        (("--step-s", "0.1"), "step_s"),
        (("--ros-args", "-p", "publish_rate_hz:=fast"), "publish_rate_hz: 'fast' is no number"),
        (("--ros-args", "-p", "real_time_factor:=-2.0"), "real_time_factor"),
        (("--ros-args", "--no-such-argument"), "no-such-argument"),
        (("--inputs.throttle.min", "0.9", "--inputs.throttle.max", "0.1"), "lies above max, 0.1"),
        (("--initial-sped-mps", "20"), "--initial-speed-mps (the nearest)"),
    ],
)
def test_bad_usage_is_one_line_and_status_2(start: Any, words: tuple[str, ...], said: str) -> None:
    node = start("simulator", *words)
    assert node.wait() == 2
    assert said in node.output
    assert "Traceback" not in node.output
    assert "usage:" not in node.output


def test_help_names_every_parameter(start: Any) -> None:
    node = start("simulator", "--help")
    assert node.wait() == 0
    flags = set(re.findall(r"--[a-z][\w.-]*", node.output))
    assert {"--" + spec.name.replace("_", "-") for spec in SPECS} <= flags


def test_a_signal_while_starting_ends_at_once(start: Any) -> None:
    node = start("simulator")
    node.wait_for("loading")
    node.process.send_signal(signal.SIGINT)
    time.sleep(0.2)
    node.process.send_signal(signal.SIGINT)
    assert node.wait() == 0
    assert "Traceback" not in node.output


def test_rounded_rates_are_said(start: Any) -> None:
    node = start("simulator", "--publish-rate-hz", "60", "--clock-rate-hz", "60")
    node.wait_for("publish_rate_hz: 60 Hz does not fit the step, 58.82 Hz it is")
    node.wait_for("ready")
    assert node.stop() == 0


@pytest.mark.parametrize(
    "specs",
    [PLAIN_SPECS, player_parameters.SPECS, LANE_KEEPER_SPECS],
    ids=["simulator", "player", "lane"],
)
def test_the_documentation_lists_the_parameters_as_they_are(specs: tuple[Spec, ...]) -> None:
    page = (ROOT / "docs" / "ros.md").read_text()
    assert markdown(specs) in page
    assert inputs_markdown() in page


def test_a_lone_text_is_a_list_of_one() -> None:
    row = next(spec for spec in player_parameters.SPECS if spec.name == "also")
    assert row.checked("other.csv") == ["other.csv"]
    assert row.checked(("a.csv", "b.csv")) == ["a.csv", "b.csv"]
    for bad in (5, [1, 2], None, True):
        with pytest.raises(InputError, match=r"also: .* is no list of texts"):
            row.checked(bad)


def test_a_robot_description_is_written_where_nothing_is(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    target = tmp_path / "new" / "truck.urdf"
    assert urdf.main(["rigid_truck", "-o", str(target)]) == 0
    assert target.read_text().startswith("<?xml")
    target.write_text("mine")
    assert urdf.main(["rigid_truck", "-o", str(target)]) == 2
    assert "exists already" in capsys.readouterr().err
    assert target.read_text() == "mine"
    assert urdf.main(["rigid_truck", "-o", str(target), "--force"]) == 0
    assert target.read_text() != "mine"
    assert urdf.main(["rigid_truck", "-o", str(target / "below.urdf")]) == 2
    assert urdf.main(["rigid_truck", "-o", str(tmp_path), "--force"]) == 2
    assert urdf.main(["rigid_truck", "--no-such-option"]) == 2
    assert urdf.main(["no_such_truck"]) == 2
    assert [line[:5] for line in capsys.readouterr().err.splitlines()] == ["urdf:"] * 4


def test_specs_have_defaults_of_their_own_type() -> None:
    assert all(spec.checked(spec.default) == spec.default for spec in SPECS)
