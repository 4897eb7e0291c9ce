"""Adapters with stand-in messages; test_real_messages.py takes the real ones, where built."""

# ruff: noqa: ANN401 (stand-ins have whatever fields the adapter asks for)
from __future__ import annotations

import logging
import math
from collections.abc import Callable
from importlib.util import find_spec
from types import SimpleNamespace
from typing import Any, ClassVar

import numpy as np
import pytest

from truck_blowout_sim import InitialState, load_vehicle
from truck_blowout_sim.nodes import publishing
from truck_blowout_sim.nodes.adapters import ackermann, attach_all, autoware
from truck_blowout_sim.nodes.adapters.commands import ForeignCommands
from truck_blowout_sim.nodes.inputs import InputBank
from truck_blowout_sim.nodes.plant import Plant
from truck_blowout_sim.nodes.simulator_parameters import SPECS, inputs_of

RATIO = 22.0
DEFAULTS: dict[str, Any] = {spec.name: spec.default for spec in SPECS} | {"input_timeout_s": 0.0}


class Topic:
    """Takes commands as `CommandTopic` does, without a subscription."""

    def __init__(self, guarded: Any) -> None:
        self.guarded = guarded

    def take(self, value: float) -> None:
        assert self.guarded.offer(value, 0) == ""


class Simulator:
    """The parts of the node that adapters use."""

    def __init__(self, name: str = "international_9400i_trailmobile") -> None:
        vehicle = load_vehicle(name)
        bank = InputBank(inputs_of(DEFAULTS, vehicle.spec.brakes))
        self.plant = Plant(vehicle, 0.001, InitialState(speed_mps=20.0), bank)
        self.plant.build()
        self.commands = [Topic(one) for one in bank.inputs]
        self.reports: list[Callable[[int], None]] = []
        self.outputs = SimpleNamespace(also=self.reports.append)

    @property
    def applied(self) -> dict[str, float]:
        bank = self.plant.bank
        return {i.name: v for i, v in zip(bank.inputs, bank.applied(0), strict=True)}


class Node:
    """Keeps what is created, so that the test can play the other side."""

    _parameter_overrides: ClassVar[dict[str, object]] = {}

    def __init__(self) -> None:
        self.taken: dict[str, Callable[[Any], None]] = {}
        self.sent: dict[str, list[Any]] = {}
        self.served: dict[str, Callable[[Any, Any], Any]] = {}
        self.readers = 1

    def resolve_topic_name(self, topic: str) -> str:
        return topic

    def get_logger(self) -> Any:
        return logging.getLogger("stand-in")

    def create_subscription(self, _: type, topic: str, callback: Any, *__: Any, **___: Any) -> None:
        self.taken[topic] = callback

    def create_publisher(self, _: type, topic: str, *__: Any, **___: Any) -> SimpleNamespace:
        return SimpleNamespace(
            publish=self.sent.setdefault(topic, []).append,
            get_subscription_count=lambda: self.readers,
        )

    def create_service(self, _: type, name: str, callback: Any) -> None:
        self.served[name] = callback


simulator = pytest.fixture(name="simulator")(lambda: Simulator())
node = pytest.fixture(name="node")(lambda: Node())


@pytest.mark.skipif(
    any(find_spec(name) for name in ("ackermann_msgs", "autoware_vehicle_msgs",
                                     "simulation_interfaces")),
    reason="the messages are installed",
)  # fmt: skip
def test_nothing_is_active_without_the_packages(node: Any, simulator: Any) -> None:
    assert attach_all(node, simulator) == ()
    assert not node.taken
    assert not node.served


def test_ackermann_steers_by_the_ratio_and_accelerates(
    install: Any, node: Any, simulator: Any
) -> None:
    install("ackermann_msgs", msg={"AckermannDriveStamped": object})
    assert ackermann.attach(node, simulator)
    drive = SimpleNamespace(steering_angle=0.05, speed=22.0, acceleration=0.0)
    node.taken["ackermann_cmd"](SimpleNamespace(drive=drive))
    applied = simulator.applied
    assert applied["steering_wheel_angle_rad"] == pytest.approx(0.05 * RATIO)
    assert 0.5 < applied["throttle"] <= 1.0
    assert applied["brake_pressure_trailer_pa"] == 0.0


def test_ackermann_brakes_all_circuits_to_slow_down(
    install: Any, node: Any, simulator: Any
) -> None:
    install("ackermann_msgs", msg={"AckermannDriveStamped": object})
    ackermann.attach(node, simulator)
    drive = SimpleNamespace(steering_angle=0.0, speed=15.0, acceleration=-1.0)
    node.taken["ackermann_cmd"](SimpleNamespace(drive=drive))
    applied = simulator.applied
    assert applied["throttle"] == 0.0
    pressures = {v for name, v in applied.items() if name.startswith("brake")}
    assert len(pressures) == 1
    assert 1e5 < pressures.pop() < 1e6


@pytest.mark.parametrize(
    "vehicle", ["international_9400i_trailmobile", "rigid_truck", "bmw_320i", "ferrari_250lm"]
)
def test_every_vehicle_brakes_and_turns_its_wheels_as_told(vehicle: str) -> None:
    simulator = Simulator(vehicle)
    commands = ForeignCommands(simulator)  # type: ignore[arg-type]
    speeds_mps = []
    for _ in range(20):
        speed_mps = commands.speed_mps
        commands.take(0.01, speed_mps, -2.0)  # no error of speed: the feed-forward alone
        simulator.plant.advance(100)
        speeds_mps.append(speed_mps)
    # air brakes build up over half a second; air and tires brake, too
    assert speeds_mps[10] - speeds_mps[-1] == pytest.approx(0.9 * 2.0, rel=0.2)
    assert 0.005 < commands.steer_rad < 0.011  # a steering gear gives way under load


class Report(SimpleNamespace):
    """A message whose header and stamp can be set."""

    def __init__(self) -> None:
        super().__init__(
            header=SimpleNamespace(frame_id="", stamp=SimpleNamespace(sec=0, nanosec=0)),
            stamp=SimpleNamespace(sec=0, nanosec=0),
        )


GEARS = {"NONE": 0, "NEUTRAL": 1, "DRIVE": 2, "REVERSE": 20, "PARK": 22, "LOW": 23, "LOW_2": 24,
         **{f"DRIVE_{n}": n + 1 for n in range(2, 19)}}  # fmt: skip
AUTOWARE = {
    "SteeringReport": Report,
    "VelocityReport": Report,
    "GearReport": type("GearReport", (Report,), GEARS),
    "GearCommand": type("GearCommand", (Report,), GEARS),
    "ControlModeReport": type("ControlModeReport", (Report,), {"AUTONOMOUS": 1, "MANUAL": 4}),
}


@pytest.fixture
def autoware_messages(install: Any) -> None:
    install("autoware_control_msgs", msg={"Control": object})
    install("autoware_vehicle_msgs", msg=AUTOWARE, srv={"ControlModeCommand": object})


@pytest.mark.usefixtures("autoware_messages")
def test_autoware_takes_control_and_gives_reports(node: Any, simulator: Any) -> None:
    assert autoware.attach(node, simulator)
    along = SimpleNamespace(velocity=20.0, acceleration=5.0, is_defined_acceleration=False)
    node.taken["/control/command/control_cmd"](
        SimpleNamespace(lateral=SimpleNamespace(steering_tire_angle=-0.02), longitudinal=along)
    )
    applied = simulator.applied
    assert applied["steering_wheel_angle_rad"] == pytest.approx(-0.02 * RATIO)
    # an acceleration that is not defined is none
    assert applied["throttle"] < 0.6
    simulator.reports[0](1_500_000_000)
    (speed,) = node.sent["/vehicle/status/velocity_status"]
    assert speed.longitudinal_velocity == pytest.approx(20.0, abs=0.01)
    assert (speed.header.stamp.sec, speed.header.stamp.nanosec) == (1, 500_000_000)
    (steer,) = node.sent["/vehicle/status/steering_status"]
    assert abs(steer.steering_tire_angle) < 0.01
    assert np.isfinite(speed.heading_rate)
    (gear,), (mode,) = node.sent["/vehicle/status/gear_status"], node.sent[
        "/vehicle/status/control_mode"
    ]
    assert (gear.report, mode.mode) == (2, 1)
    (where,) = node.sent["/localization/kinematic_state"]
    # the standing truck's base_link: between the drive axles, on the ground
    assert (where.header.frame_id, where.child_frame_id) == ("map", "base_link")
    assert where.pose.pose.position.z == pytest.approx(0.0, abs=0.06)
    assert where.pose.pose.position.x < -2.0
    (acceleration,) = node.sent["/localization/acceleration"]
    assert acceleration.accel.accel.linear.z == pytest.approx(0.0, abs=0.2)


@pytest.mark.usefixtures("autoware_messages")
def test_autoware_reports_are_made_for_readers_only(
    node: Any, simulator: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(publishing, "_LOOK_EVERY_S", 0.0)
    node.readers = 0
    autoware.attach(node, simulator)
    simulator.reports[0](1_500_000_000)
    assert {len(sent) for sent in node.sent.values()} == {0}
    node.readers = 1
    simulator.reports[0](1_510_000_000)
    assert {len(sent) for sent in node.sent.values()} == {1}


@pytest.mark.usefixtures("autoware_messages")
def test_autoware_changes_mode_and_gear(node: Any, simulator: Any) -> None:
    assert autoware.attach(node, simulator)
    take = node.taken["/control/command/control_cmd"]
    along = SimpleNamespace(velocity=25.0, acceleration=0.0, is_defined_acceleration=False)
    command = SimpleNamespace(
        lateral=SimpleNamespace(steering_tire_angle=0.01), longitudinal=along
    )
    request = SimpleNamespace(AUTONOMOUS=1, MANUAL=4, mode=4)
    answer = node.served["/control/control_mode_request"](request, SimpleNamespace(success=None))
    assert answer.success
    take(command)
    assert simulator.applied["throttle"] == 0.0  # a person drives
    request.mode = 2
    assert not node.served["/control/control_mode_request"](request, answer).success
    request.mode = 1
    node.served["/control/control_mode_request"](request, answer)
    take(command)
    assert simulator.applied["throttle"] > 0.2
    node.taken["/control/command/gear_cmd"](SimpleNamespace(command=20))  # reverse
    simulator.reports[0](10_000_000)
    assert node.sent["/vehicle/status/gear_status"][-1].report == 2
    node.taken["/control/command/gear_cmd"](SimpleNamespace(command=22))  # park
    take(command)
    assert simulator.applied["throttle"] == 0.0
    assert simulator.applied["brake_pressure_drive_pa"] > 0.0


def test_a_command_that_is_no_number_moves_no_pedal() -> None:
    simulator = Simulator()
    taken: list[float] = []
    commands = ForeignCommands(simulator)  # type: ignore[arg-type]
    commands.take(0.0, 25.0)
    before = simulator.applied
    for topic in simulator.commands:
        topic.take = taken.append  # type: ignore[method-assign]
    commands.take(0.0, math.nan)
    commands.take(0.0, 20.0, math.inf)
    assert [math.isnan(value) for value in taken] == [True, True]
    assert simulator.applied == before
